// The film as an OpenEXR file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/camera/camera.h"
#include "renderer/film/film.h"

namespace rondure {

// What the header tells besides the picture. No date, no host, no path: equal renders are equal files.
struct ExrHeader {
  std::uint64_t scene_hash = 0;
  std::uint64_t seed = 0;
  std::string integrator;
  std::string solver;  // what finds the hits, or a list
  Camera camera;
};

// One part, 32-bit floats, ZIP; the film's window is the data window. Channels: R G B A; Albedo.R .G .B;
// Depth.Z; N.X .Y .Z; P.X .Y .Z; Patch.id, Patch.surface (-1 where nothing is hit); UV.U .V; Variance.R .G .B
// (of the mean); and those of the film's extra layers. The screen window is the whole picture's, whatever the
// film's window. Atomic. Throws std::runtime_error naming the file.
std::vector<std::string> standard_channels();
void write_exr(const std::string& path, const Film& film, const ExrHeader& header);

}  // namespace rondure
