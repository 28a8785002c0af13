#include "renderer/film/legend_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/api/utf8.h"
#include "renderer/film/image.h"
#include "renderer/film/preview.h"

namespace rondure {

void check_legend(const Legend& legend, const std::string& who) {
  constexpr std::size_t longest = 256;
  const auto refuse = [&](const char* fault) {
    throw std::runtime_error(fmt::format("{} made a legend that has {}", who, fault));
  };
  const auto finite = [](const dvec3& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
  };
  if (legend.colors.empty()) refuse("no colours");
  if (!std::all_of(legend.colors.begin(), legend.colors.end(), finite)) refuse("a colour that is not finite");
  if (!is_scale(legend.low, legend.high, legend.logarithmic))
    refuse("no range of numbers from low to high, positive where logarithmic");
  if (legend.title.size() > longest || printable(legend.title, longest) != legend.title)
    refuse("a title that is no short line of text");
}

std::vector<double> legend_ticks(const Legend& legend, int most) {
  std::vector<double> ticks;
  if (legend.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(legend.low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(legend.high) + 1e-9));
    const int step = std::max(1, (last - first + most) / most);
    for (int e = first; e <= last; e += step) ticks.push_back(std::pow(10.0, e));
    if (ticks.size() >= 2) return ticks;
    return {legend.low, legend.high};
  }
  const int count = std::max(2, most);
  for (int k = 0; k < count; ++k) ticks.push_back(legend.low + (legend.high - legend.low) * k / (count - 1));
  return ticks;
}

int append_legend(std::vector<unsigned char>& rgb, int width, int height, const Legend& legend) {
  const int size = std::clamp(width / 40, 10, 24);  // of the text, in pixels
  const int margin = 2 * size, bar = size, tall = 4 * size + bar;
  const int total = height + tall;
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(total), 0);
  const auto put = [&](int x, int y, const dvec3& color) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    for (int c = 0; c < 3; ++c) rgb[at + static_cast<std::size_t>(c)] = srgb_byte(color[c]);
  };
  const int left = std::min(margin, width / 4), right = width - left, top = height + 2 * size;
  for (int y = top; y < top + bar; ++y) {
    for (int x = left; x < right; ++x) {
      const auto steps = legend.colors.size() - 1;
      const auto k =
          static_cast<std::size_t>((x - left) * static_cast<double>(steps) / std::max(1, right - left - 1));
      put(x, y, legend.colors[std::min(k, steps)]);
    }
  }
  draw_text(rgb, width, total, dvec2(left, height + size + size / 2), size, false, legend.title);
  const int most = std::clamp((right - left) / (5 * size), 2, 9);
  for (const double tick : legend_ticks(legend, most)) {
    const double place = legend.logarithmic ? std::log(tick / legend.low) / std::log(legend.high / legend.low)
                                            : (tick - legend.low) / (legend.high - legend.low);
    const int x = left + static_cast<int>(std::lround(place * (right - left - 1)));
    for (int y = top + bar; y < top + bar + size / 3; ++y) put(x, y, dvec3(1.0));
    draw_text(rgb, width, total, dvec2(x, top + bar + size + size / 2), size, true,
              fmt::format("{:.3g}", tick));
  }
  return total;
}

}  // namespace rondure
