// Reads pictures and writes previews through OpenImageIO. Built as a module; see renderer/film/image.h.

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

bool read(const char* path, rondure::Image& image, const rondure::ImageReport* report) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return fail(report, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = spec.nchannels;
  const bool encoded =
      spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16;
  image.width = spec.width;
  image.height = spec.height;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<float> all(pixels * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, all.data())) {
    return fail(report, input->geterror());
  }
  image.rgb.resize(pixels * 3);
  const int colours = channels >= 3 ? 3 : 1;  // grey, or grey and alpha, otherwise
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = all[i * static_cast<std::size_t>(channels) + (colours == 3 ? c : 0)];
      image.rgb[3 * i + c] = encoded ? linear_of_srgb(value) : value;
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

extern "C" bool rondure_write_png(const char* path, int width, int height, const unsigned char* rgb,
                                  const rondure::ImageReport* report) {
  try {
    return write(path, width, height, rgb, report);
  } catch (const std::exception& e) {
    return fail(report, e.what());
  }
}
