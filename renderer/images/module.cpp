// Reads pictures and writes previews through OpenImageIO. Built as a module; see renderer/film/image.h.

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "renderer/images/entry_points.h"

namespace {

float linear_of_srgb(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }

bool fail(const rondure::ImageReport* report, const std::string& message) {
  report->fail(report->context, message.empty() ? "unknown error" : message.c_str());
  return false;
}

std::size_t index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

bool read(const char* path, rondure::Image& image, const rondure::ImageReport* report) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return fail(report, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = spec.nchannels;
  const bool encoded =
      spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16;
  const auto stride = static_cast<std::size_t>(channels);
  std::vector<float> all(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                         stride);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, all.data())) {
    return fail(report, input->geterror());
  }
  // The file's pixels lie anywhere in the picture, or beyond it; where there are none it is black.
  image.width = spec.full_width > 0 ? spec.full_width : spec.width;
  image.height = spec.full_height > 0 ? spec.full_height : spec.height;
  const int left = spec.x - spec.full_x, top = spec.y - spec.full_y;
  image.rgb.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3, 0.0f);
  const int colours = channels >= 3 ? 3 : 1;  // grey, or grey and alpha, otherwise
  for (int y = std::max(0, -top); y < spec.height && y + top < image.height; ++y) {
    for (int x = std::max(0, -left); x < spec.width && x + left < image.width; ++x) {
      const float* from = &all[index(x, y, spec.width) * stride];
      float* to = &image.rgb[index(x + left, y + top, image.width) * 3];
      for (int c = 0; c < 3; ++c) {
        const float value = from[colours == 3 ? c : 0];
        to[c] = encoded ? linear_of_srgb(value) : value;
      }
    }
  }
  return true;
}

bool write(const char* path, int width, int height, const unsigned char* rgb,
           const rondure::ImageReport* report) {
  const auto output = OIIO::ImageOutput::create(path);
  if (!output) return fail(report, OIIO::geterror());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb) || !output->close()) {
    return fail(report, output->geterror());
  }
  return true;
}

constexpr const char* font = "DejaVuSans";

bool draw(unsigned char* rgb, int width, int height, int x, int y, int size, bool centred, const char* text,
          const rondure::ImageReport* report) {
  // The buffer wraps the pixels.
  OIIO::ImageBuf picture(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8), rgb);
  const float white[] = {1.0f, 1.0f, 1.0f};
  if (OIIO::ImageBufAlgo::render_text(
          picture, x, y, text, size, font, white,
          centred ? OIIO::ImageBufAlgo::TextAlignX::Center : OIIO::ImageBufAlgo::TextAlignX::Left,
          OIIO::ImageBufAlgo::TextAlignY::Baseline))
    return true;
  return fail(report, picture.geterror());
}

}  // namespace

// No exception leaves a C function.
extern "C" bool rondure_read_image(const char* path, rondure::Image* image,
                                   const rondure::ImageReport* report) {
  try {
    return read(path, *image, report);
  } catch (const std::exception& e) {
    return fail(report, e.what());
  }
}

extern "C" bool rondure_draw_text(unsigned char* rgb, int width, int height, int x, int y, int size,
                                  bool centred, const char* text, const rondure::ImageReport* report) {
  try {
    return draw(rgb, width, height, x, y, size, centred, text, report);
  } catch (const std::exception& e) {
    return fail(report, e.what());
  }
}

extern "C" bool rondure_write_png(const char* path, int width, int height, const unsigned char* rgb,
                                  const rondure::ImageReport* report) {
  try {
    return write(path, width, height, rgb, report);
  } catch (const std::exception& e) {
    return fail(report, e.what());
  }
}
