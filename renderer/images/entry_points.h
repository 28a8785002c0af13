// The module's C functions. Each returns true, or false after calling `fail` once with a message.
#pragma once

#include <cstddef>

#include "renderer/film/image.h"

namespace rondure {

struct ImageReport {
  void* context;
  void (*fail)(void* context, const char* message);
};

extern "C" {
// Fills `image` with linear RGB.
using ReadImageFunction = bool (*)(const char* path, Image* image, const ImageReport* report);
// 8-bit sRGB, top row first, three bytes a pixel. The file's bytes go to `take`, all at once.
using EncodePngFunction = bool (*)(int width, int height, const unsigned char* rgb, void* context,
                                   void (*take)(void* context, const void* bytes, std::size_t count),
                                   const ImageReport* report);
// Draws white text on 8-bit sRGB; (x, y) is the left end of its baseline, or with `centred` its middle.
using DrawTextFunction = bool (*)(unsigned char* rgb, int width, int height, int x, int y, int size,
                                  bool centred, const char* text, const ImageReport* report);
}

constexpr const char* read_image_name = "rondure_read_image";
constexpr const char* draw_text_name = "rondure_draw_text";
constexpr const char* encode_png_name = "rondure_encode_png";

}  // namespace rondure
