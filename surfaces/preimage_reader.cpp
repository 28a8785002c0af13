#include "surfaces/preimage_reader.h"

#include <fmt/format.h>

#include "surfaces/net_reader.h"

namespace rondure {
namespace {

Preimage extended(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  std::vector<lvec4> values(points.begin(), points.end());
  const long double factor = squaring_factor(values);
  for (lvec4& p : values) p *= factor;
  if (const auto* t = std::get_if<TensorNet>(&net)) return TensorPreimage(t->m, t->n, values);
  return TrianglePreimage(std::get<TriangleNet>(net).n, values);
}

}  // namespace

std::vector<Preimage> read_preimages(Params& params, std::string_view key, bool ruled) {
  std::vector<Preimage> preimages;
  for (Params& patch : params.objects(key)) {
    preimages.push_back(extended(read_net(patch, {"[p0, p1, p2, p3]", max_degree / 2, false})));
    constexpr std::size_t limit = 4;
    const std::vector<dvec2> found = base_points(preimages.back(), ruled, limit);
    if (found.empty()) continue;
    std::string list;
    for (const dvec2& at : found)
      list += fmt::format("{}({:.9g}, {:.9g})", list.empty() ? "" : ", ", at.x, at.y);
    patch.fail("net", fmt::format("the image is no point where this net has a base point{}: (u, v) = {}{}",
                                  ruled ? ", p0 = p1 = 0 or p2 = p3 = 0" : ", p0 = p1 = p2 = p3 = 0", list,
                                  found.size() == limit ? " and perhaps others" : ""));
  }
  if (preimages.empty()) params.fail(key, "there is no patch");
  return preimages;
}

ParameterDoc preimages_doc(const char* key, const char* fallback) {
  return {key, "array of {\"kind\": \"tensor\" or \"triangle\", \"degree\", \"net\"}", fallback,
          "control points are [p0, p1, p2, p3], p0 first; nets and degrees (at most 12) are written as in "
          "\"bezier\". The four coordinates must not vanish together"};
}

}  // namespace rondure
