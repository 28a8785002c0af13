// Reads pictures and writes previews through OpenImageIO. Built as a module; see renderer/film/image.h.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/images/entry_points.h"

namespace {

float linear_of_srgb(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }

// The library puts what its own libraries said on lines of its own.
bool fail(const rondure::ImageReport* report, std::string message) {
  while (message.ends_with('\n')) message.pop_back();
  for (std::size_t at; (at = message.find('\n')) != std::string::npos;) message.replace(at, 1, "; ");
  report->fail(report->context, message.empty() ? "unknown error" : message.c_str());
  return false;
}

std::size_t index(std::int64_t x, std::int64_t y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

// Some of the formats' libraries print what the caller is told anyway.
class QuietErrors {
 public:
  QuietErrors() : saved_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~QuietErrors() {
    if (saved_ < 0) return;
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  int saved_;
};

// A header may claim any size; memory is asked for only up to this one: 16384 x 8192, 1.6 GB in float RGB.
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 27;
constexpr int most_channels = 64;

bool too_large(int width, int height, int channels) {
  if (channels > most_channels) return true;
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return pixels > most_pixels / static_cast<std::uint64_t>(std::max(1, channels / 4));
}

// The formats of environment maps and plain pictures, whose readers bear damaged files. Others, of films and
// of layers, do not all.
constexpr std::array known_formats = {"openexr", "hdr", "png", "jpeg", "tiff", "pnm", "targa", "bmp"};

bool read(const char* path, rondure::Image& image, const rondure::ImageReport* report) {
  const QuietErrors quiet;
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return fail(report, OIIO::geterror());
  if (std::find(known_formats.begin(), known_formats.end(), std::string_view(input->format_name())) ==
      known_formats.end())
    return fail(report, std::string("its format is ") + input->format_name() +
                            "; known: OpenEXR, Radiance HDR, PNG, JPEG, TIFF, PNM, TGA, BMP");
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = spec.nchannels;
  if (spec.deep || spec.depth > 1) return fail(report, "it is no flat picture");
  for (const auto& [width, height] :
       {std::pair(spec.width, spec.height), std::pair(spec.full_width, spec.full_height)}) {
    if (width <= 0 || height <= 0 || channels <= 0) return fail(report, "it claims to have no pixels");
    if (too_large(width, height, channels)) {
      return fail(report, "it claims " + std::to_string(width) + " x " + std::to_string(height) +
                              " pixels of " + std::to_string(channels) + " channels; up to " +
                              std::to_string(most_pixels) + " pixels are read");
    }
  }
  const bool encoded =
      spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16;
  const auto stride = static_cast<std::size_t>(channels);
  std::vector<float> all(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                         stride);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, all.data())) {
    const std::string why = input->geterror();
    return fail(report, why.empty() ? "it is damaged or cut short" : why);
  }
  // The file's pixels lie anywhere in the picture, or beyond it; where there are none it is black.
  image.width = spec.full_width;
  image.height = spec.full_height;
  // Some formats place them with any integers.
  const std::int64_t left = std::int64_t{spec.x} - spec.full_x, top = std::int64_t{spec.y} - spec.full_y;
  image.rgb.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3, 0.0f);
  const int colours = channels >= 3 ? 3 : 1;  // grey, or grey and alpha, otherwise
  for (std::int64_t y = std::max<std::int64_t>(0, -top); y < spec.height && y + top < image.height; ++y) {
    for (std::int64_t x = std::max<std::int64_t>(0, -left); x < spec.width && x + left < image.width; ++x) {
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

// To memory: the library's own way to a file tells nothing of a full disk.
bool encode(int width, int height, const unsigned char* rgb, std::vector<unsigned char>& bytes,
            const rondure::ImageReport* report) {
  OIIO::Filesystem::IOVecOutput target(bytes);
  const auto output = OIIO::ImageOutput::create("preview.png", &target);
  if (!output) return fail(report, OIIO::geterror());
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!output->open("preview.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb) ||
      !output->close()) {
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
  } catch (const std::bad_alloc&) {
    return fail(report, "there is not enough memory for it");
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

extern "C" bool rondure_encode_png(int width, int height, const unsigned char* rgb, void* context,
                                   void (*take)(void*, const void*, std::size_t),
                                   const rondure::ImageReport* report) {
  try {
    std::vector<unsigned char> bytes;
    if (!encode(width, height, rgb, bytes, report)) return false;
    take(context, bytes.data(), bytes.size());
    return true;
  } catch (const std::exception& e) {
    return fail(report, e.what());
  }
}
