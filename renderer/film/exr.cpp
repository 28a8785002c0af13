#include "renderer/film/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "renderer/api/version.h"
#include "renderer/film/atomic_file.h"
#include "renderer/film/stored.h"

namespace rondure {
namespace {

constexpr std::array names = {
    "R",    "G",    "B",          "A",          "Albedo.R",  "Albedo.G", "Albedo.B", "Depth.Z",
    "N.X",  "N.Y",  "N.Z",        "P.X",        "P.Y",       "P.Z",      "Patch.id", "Patch.surface",
    "UV.U", "UV.V", "Variance.R", "Variance.G", "Variance.B"};

std::array<double, names.size()> values_at(const Film& film, int x, int y) {
  const FilmSample m = film.mean(x, y);
  const dvec3 v = film.variance(x, y);
  const PixelGeometry& g = film.geometry[film.index(x, y)];
  return {m.color.x,       m.color.y,         m.color.z,  m.alpha,    m.albedo.x, m.albedo.y, m.albedo.z,
          g.depth,         m.normal.x,        m.normal.y, m.normal.z, g.point.x,  g.point.y,  g.point.z,
          double(g.patch), double(g.surface), g.uv.x,     g.uv.y,     v.x,        v.y,        v.z};
}

std::vector<std::string> channels_of(const Film& film) {
  std::vector<std::string> all(names.begin(), names.end());
  for (const LayerPlane& plane : film.layers) all.push_back(plane.channel);
  return all;
}

// OpenEXR's vectors are rows and glm's are columns, which makes the two indices mean the same.
Imath::M44f matrix(const dmat4& m) {
  Imath::M44f result;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) result[i][j] = stored(m[i][j]);
  }
  return result;
}

Imf::Header make_header(const Film& film, const ExrHeader& info) {
  const Window& w = film.window();
  const Imath::Box2i display({0, 0}, {film.width() - 1, film.height() - 1});
  const Imath::Box2i data({w.x0, w.y0}, {w.x1 - 1, w.y1 - 1});
  const double aspect = static_cast<double>(film.width()) / film.height();
  // At distance 1, or of the orthographic window.
  const float screen = stored(info.camera.extent * aspect);
  Imf::Header header(display, data, 1.0f, {0.0f, 0.0f}, screen, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (const std::string& name : channels_of(film)) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  Imf::addChromaticities(header, Imf::Chromaticities{});  // Rec. 709, D65
  Imf::addWorldToCamera(header, matrix(world_to_camera(info.camera)));
  Imf::addWorldToNDC(header, matrix(world_to_ndc(info.camera, aspect)));
  const auto text = [&](const char* name, const std::string& value) {
    header.insert(name, Imf::StringAttribute(value));
  };
  text("software", fmt::format("rondure {}", version));
  text("rondure:scene_hash", fmt::format("{:016x}", info.scene_hash));
  text("rondure:seed", fmt::format("{}", info.seed));
  text("rondure:integrator", info.integrator);
  text("rondure:solver", info.solver);
  header.insert("rondure:samples_per_pixel", Imf::IntAttribute(static_cast<int>(film.samples)));
  return header;
}

}  // namespace

std::vector<std::string> standard_channels() { return {names.begin(), names.end()}; }

void write_exr(const std::string& path, const Film& film, const ExrHeader& info) {
  const Window& w = film.window();
  const auto width = static_cast<std::size_t>(w.width());
  AtomicFile target(path);
  try {
    // Through a stream of our own: the library's destructors keep a full disk to themselves.
    std::ofstream stream(target.temporary(), std::ios::binary);
    {
      Imf::StdOFStream output(stream, path.c_str());
      Imf::OutputFile file(output, make_header(film, info), 0);
      // A line at a time, channels in turn.
      const std::vector<std::string> channels = channels_of(film);
      std::vector<float> line(channels.size() * width);
      Imf::FrameBuffer buffer;
      for (std::size_t c = 0; c < channels.size(); ++c) {
        // The library wants the address of pixel (0, 0), here left of the window. All lines share the memory.
        char* base =
            reinterpret_cast<char*>(&line[c * width]) - sizeof(float) * static_cast<std::size_t>(w.x0);
        buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, base, sizeof(float), 0));
      }
      file.setFrameBuffer(buffer);
      for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x) {
          const auto values = values_at(film, x, y);
          const auto column = static_cast<std::size_t>(x - w.x0);
          for (std::size_t c = 0; c < channels.size(); ++c) {
            line[c * width + column] = c < values.size()
                                           ? stored(values[c])
                                           : film.layers[c - values.size()].values[film.index(x, y)];
          }
        }
        file.writePixels(1);
      }
    }
    stream.close();
    if (!stream) throw std::runtime_error("the disk is full or failed");
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{}: cannot write: {}", path, e.what()));
  }
  target.commit();
}

}  // namespace rondure
