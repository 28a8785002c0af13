#include "renderer/intersect/twins.h"

#include <cstring>
#include <string_view>
#include <unordered_map>

#include "renderer/parallel/parallel_for.h"

namespace rondure {
namespace {

std::string_view bytes_of(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}

std::string_view bytes_of(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  return bytes_of(points.data(), points.size() * sizeof(dvec4));
}

bool same(const TracedSurface& a, const TracedSurface& b) {
  const Surface &s = a.surface, &t = b.surface;
  if (a.solver != b.solver || s.closed != t.closed || s.patches.size() != t.patches.size() ||
      s.ellipsoid != t.ellipsoid)
    return false;
  for (std::size_t k = 0; k < s.patches.size(); ++k)
    if (!same_degrees(s.patches[k], t.patches[k]) || bytes_of(s.patches[k]) != bytes_of(t.patches[k]))
      return false;
  return true;
}

std::size_t hash_of(const TracedSurface& traced) {
  constexpr std::hash<std::string_view> hash;
  constexpr std::size_t spread = 0x9e3779b97f4a7c15;
  std::size_t h = static_cast<std::size_t>(traced.solver);
  if (traced.surface.ellipsoid) h = h * spread + hash(bytes_of(&*traced.surface.ellipsoid, sizeof(dmat3)));
  for (const Net& net : traced.surface.patches) h = h * spread + hash(bytes_of(net));
  return h;
}

}  // namespace

std::vector<unsigned> find_twins(const std::vector<TracedSurface>& surfaces) {
  std::vector<std::size_t> hashes(surfaces.size());
  parallel_for(surfaces.size(), [&](std::size_t k) { hashes[k] = hash_of(surfaces[k]); });
  std::vector<unsigned> twins(surfaces.size());
  std::unordered_multimap<std::size_t, unsigned> firsts;
  for (unsigned k = 0; k < surfaces.size(); ++k) {
    twins[k] = k;
    const auto [begin, end] = firsts.equal_range(hashes[k]);
    for (auto f = begin; f != end && twins[k] == k; ++f)
      if (same(surfaces[f->second], surfaces[k])) twins[k] = f->second;
    if (twins[k] == k) firsts.emplace(hashes[k], k);
  }
  return twins;
}

}  // namespace rondure
