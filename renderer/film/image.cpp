#include "renderer/film/image.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "renderer/film/atomic_file.h"
#include "renderer/images/entry_points.h"

namespace rondure {
namespace {

// The folder of the library that holds this function: the module lies beside it, built and installed.
std::filesystem::path library_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&read_image), &info) == 0 || info.dli_fname == nullptr) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

void* module_symbol(const char* name) {
  // Kept to the program's end: what it loads does not bear unloading.
  static void* const module = [] {
    const std::filesystem::path path = library_folder() / "librondure_images.so";
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      const char* reason = dlerror();
      throw std::runtime_error(fmt::format(
          "picture files other than OpenEXR need the module librondure_images.so (with OpenImageIO): {}",
          reason != nullptr ? reason : "it could not be loaded"));
    }
    return handle;
  }();
  void* symbol = dlsym(module, name);
  if (symbol == nullptr)
    throw std::runtime_error(fmt::format("librondure_images.so has no function {}", name));
  return symbol;
}

// Carries a message out of the module; no exception crosses it.
struct Failure {
  std::string message = "unknown error";
  ImageReport report{this, [](void* self, const char* text) { static_cast<Failure*>(self)->message = text; }};
};

}  // namespace

void require_image_module() { module_symbol(encode_png_name); }

Image read_image(const std::string& path) {
  const auto read = reinterpret_cast<ReadImageFunction>(module_symbol(read_image_name));
  Image image;
  Failure failure;
  if (!read(path.c_str(), &image, &failure.report)) {
    throw std::runtime_error(fmt::format("{}: cannot read the image: {}", path, failure.message));
  }
  for (const float value : image.rgb) {
    if (!std::isfinite(value) || value < 0.0f) {
      throw std::runtime_error(
          fmt::format("{}: the image holds a value that is no radiance: {}", path, value));
    }
  }
  return image;
}

void draw_text(std::vector<unsigned char>& rgb, int width, int height, dvec2 at, int size, bool centred,
               const std::string& text) {
  const auto draw = reinterpret_cast<DrawTextFunction>(module_symbol(draw_text_name));
  Failure failure;
  if (!draw(rgb.data(), width, height, static_cast<int>(at.x), static_cast<int>(at.y), size, centred,
            text.c_str(), &failure.report)) {
    throw std::runtime_error(fmt::format(
        "the legend needs the font DejaVu Sans (Debian's fonts-dejavu-core): {}", failure.message));
  }
}

void write_png(const std::string& path, int width, int height, const std::vector<unsigned char>& rgb) {
  const auto encode = reinterpret_cast<EncodePngFunction>(module_symbol(encode_png_name));
  AtomicFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  const auto take = [](void* to, const void* bytes, std::size_t count) {
    static_cast<std::ofstream*>(to)->write(static_cast<const char*>(bytes),
                                           static_cast<std::streamsize>(count));
  };
  Failure failure;
  if (!encode(width, height, rgb.data(), &stream, take, &failure.report)) {
    throw std::runtime_error(fmt::format("{}: cannot write the image: {}", path, failure.message));
  }
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot write: the disk is full or failed", path));
  file.commit();
}

}  // namespace rondure
