// A picture in memory, and the door to the module that reads and writes picture files.
//
// OpenImageIO brings some 250 shared libraries; they stay in a module of their own, loaded by the first call
// here.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Linear RGB, top row first.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;

  dvec3 at(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

// Loads the module, so that its absence is known before hours of work. Throws std::runtime_error.
void require_image_module();

// OpenEXR, Radiance HDR, PNG, JPEG, TIFF, PNM (with PFM), TGA or BMP. 8- and 16-bit files are taken for sRGB;
// grey is spread over three channels. Throws std::runtime_error naming the file; non-finite and negative
// values are errors too.
Image read_image(const std::string& path);

// Draws white text of a size in pixels on a picture as below; `at` is the left end of its baseline, or with
// `centred` its middle. Throws std::runtime_error where there is no font: DejaVu Sans, Debian's
// fonts-dejavu-core.
void draw_text(std::vector<unsigned char>& rgb, int width, int height, dvec2 at, int size, bool centred,
               const std::string& text);

// 8-bit, three bytes a pixel, top row first, sRGB. Atomic. Throws std::runtime_error naming the file.
void write_png(const std::string& path, int width, int height, const std::vector<unsigned char>& rgb);

}  // namespace rondure
