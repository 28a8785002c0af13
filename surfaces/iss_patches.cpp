#include "surfaces/iss_patches.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/bernstein.h"
#include "renderer/inverse_spherical/join.h"
#include "renderer/inverse_spherical/octant_model.h"
#include "renderer/inverse_spherical/partition.h"
#include "renderer/inverse_spherical/sphere_triangle.h"
#include "renderer/inverse_spherical/spherical_triangle.h"
#include "renderer/inverse_spherical/vertex_fan.h"
#include "surfaces/iss_coefficients.h"

namespace rondure {
namespace {

// Only ratios of moduli count; beyond 10^8 the coordinates of a domain's corners cancel too many digits.
constexpr double least_modulus = 1e-4;

using Kind = Value::Kind;

std::vector<dvec3> read_directions(Params& params) {
  if (!params.has("vertices")) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Value& list = *params.raw("vertices");
  if (list.kind != Kind::array) params.fail(list, "\"vertices\" is an array of vectors [x, y, z]");
  std::vector<dvec3> vertices;
  for (const Value& item : list.items) {
    dvec3 p(0.0);
    bool good = item.kind == Kind::array && item.items.size() == 3;
    for (std::size_t k = 0; good && k < 3; ++k) {
      good = item.items[k].kind == Kind::number;
      if (good) p[static_cast<int>(k)] = item.items[k].number;
    }
    const double length = glm::length(p);
    if (!good || !std::isfinite(length) || !(length > 0.0)) {
      params.fail(item, "a vertex is three numbers, not all zero: a direction times a modulus");
    }
    vertices.push_back(p);
  }
  return vertices;
}

std::vector<dvec3> read_vertices(Params& params) {
  std::vector<dvec3> vertices = read_directions(params);
  if (!params.has("moduli")) return vertices;
  const std::vector<double> moduli = params.numbers("moduli");
  if (moduli.size() != vertices.size()) {
    params.fail("moduli",
                fmt::format("\"moduli\" has {} numbers for {} vertices", moduli.size(), vertices.size()));
  }
  for (std::size_t k = 0; k < moduli.size(); ++k) {
    if (!(moduli[k] >= least_modulus && moduli[k] <= 1.0 / least_modulus))
      params.fail("moduli",
                  fmt::format("a modulus must be in [{:g}, {:g}]", least_modulus, 1.0 / least_modulus));
    vertices[k] = moduli[k] * glm::normalize(vertices[k]);
  }
  return vertices;
}

class PatchReader {
 public:
  PatchReader(std::vector<dvec3> vertices, int degree) : vertices_(std::move(vertices)), n_(degree) {}

  IssPatch read(Params& patch) {
    const char* found = nullptr;
    for (const char* key : {"triangle", "u", "sphere", "join"}) {
      if (!patch.has(key)) continue;
      if (found) patch.fail(key, fmt::format("give one of \"{}\" and \"{}\", not both", found, key));
      found = key;
    }
    const std::string form = found ? found : "";
    if (form.empty()) patch.fail("a patch needs \"triangle\", \"u\", \"sphere\" or \"join\"");
    IssPatch made = form == "triangle" ? planar(patch)
                    : form == "u"      ? general(patch)
                    : form == "sphere" ? sphere(patch)
                                       : join(patch);
    patch.finish();
    made_.push_back(made);
    return made;
  }

 private:
  std::array<dvec3, 3> corners(Params& patch, const char* key) {
    const auto last = static_cast<std::int64_t>(vertices_.size()) - 1;
    const std::vector<std::int64_t> list = patch.integers(key, 0, last);
    if (list.size() != 3)
      patch.fail(key, fmt::format("\"{}\" names three vertices, not {}", key, list.size()));
    std::array<dvec3, 3> out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = vertices_[static_cast<std::size_t>(list[k])];
    if (const auto fault = partition_fault(1, {out[2], out[1], out[0]})) patch.fail(key, *fault);
    return out;
  }

  IssPatch planar(Params& patch) {
    PlanarIss s{n_, corners(patch, "triangle"), {}};
    s.weights = read_weights(patch, n_, vectors_of(s), all_needed());
    return s;
  }

  IssPatch general(Params& patch) {
    const std::vector<dvec3> u = read_vectors(patch, *patch.raw("u"), n_);
    if (const auto fault = partition_fault(n_, u)) {
      patch.fail("u", "the directions form no spherical partition: " + *fault);
    }
    if (const auto fault = fold_fault(n_, u)) patch.fail("u", "the surface is not single-valued: " + *fault);
    const std::vector<double> w = read_weights(patch, n_, u, all_needed());
    TriangleNet net(n_);
    for (std::size_t k = 0; k < u.size(); ++k) net.points[k] = dvec4(u[k], w[k]);
    return net;
  }

  IssPatch sphere(Params& patch) { return sphere_triangle(corners(patch, "sphere")); }

  IssPatch join(Params& patch) {
    Params with = patch.object("join");
    if (made_.empty()) with.fail("there is no patch before this one to join it to");
    const auto index = with.integer("patch", 0, static_cast<std::int64_t>(made_.size()) - 1);
    const auto* first = std::get_if<PlanarIss>(&made_[static_cast<std::size_t>(index)]);
    if (!first) with.fail("patch", fmt::format("patch {} has no planar projection domain", index));
    const PlanarIss turned = rotated(*first, static_cast<int>(with.integer("across", 0, 2)));
    const auto vertex = with.integer("vertex", 0, static_cast<std::int64_t>(vertices_.size()) - 1);
    dvec3 tip = vertices_[static_cast<std::size_t>(vertex)];
    if (with.boolean("coplanar", true)) {
      const std::optional<dvec3> moved = coplanar_vertex(turned, tip);
      if (!moved) with.fail("vertex", "its direction does not meet the plane of the first patch's domain");
      tip = *moved;
    }
    with.finish();
    PlanarIss s{n_, {tip, turned.corners[1], turned.corners[2]}, {}};
    s.weights = read_weights(patch, n_, vectors_of(s), [](int i, int) { return i >= 2; });
    try {
      return joined(turned, tip, s.weights);
    } catch (const std::invalid_argument& error) {
      patch.fail("join", error.what());
    }
  }

  static std::vector<dvec3> vectors_of(const PlanarIss& s) {
    std::vector<dvec3> u;
    for (int i = 0; i <= s.n; ++i) {
      for (int j = 0; j <= s.n - i; ++j) u.push_back(s.u(i, j));
    }
    return u;
  }

  std::vector<dvec3> vertices_;
  int n_;
  std::vector<IssPatch> made_;
};

// `count` sets of coefficients: one value for all of them, or an array.
std::vector<std::vector<double>> read_sets(Params& params, const char* key, std::size_t count, int n,
                                           const Needed& needed) {
  const Value* value = params.raw(key);
  if (!value) return {count, std::vector<double>(static_cast<std::size_t>(triangle_size(n)), 1.0)};
  if (value->kind != Kind::array) return {count, read_coefficients(params, *value, n, needed)};
  if (value->items.size() != count) {
    params.fail(*value, fmt::format("\"{}\" has {} entries for {} patches", key, value->items.size(), count));
  }
  std::vector<std::vector<double>> sets;
  for (const Value& item : value->items) sets.push_back(read_coefficients(params, item, n, needed));
  return sets;
}

std::vector<IssPatch> read_octants(Params params) {
  const int n = static_cast<int>(params.integer("degree", 3, 3, max_degree));
  const auto sets =
      read_sets(params, "interior", 8, n, [n](int i, int j) { return i > 0 && j > 0 && i + j < n; });
  params.finish();
  std::array<std::vector<double>, 8> interior;
  for (std::size_t k = 0; k < 8; ++k) interior[k] = sets[k];
  std::vector<IssPatch> patches;
  for (PlanarIss& s : octant_model(n, interior)) patches.emplace_back(std::move(s));
  return patches;
}

std::vector<IssPatch> read_fan(Params params) {
  FanDomain domain;
  domain.sides = static_cast<int>(params.integer("sides", 6, 3, 100));
  const int n = static_cast<int>(params.integer("degree", 6, 2, max_degree));
  domain.centre = params.vec3("centre", domain.centre);
  domain.a = params.vec3("a", domain.a);
  domain.b = params.vec3("b", domain.b);
  const auto sets = read_sets(params, "weights", static_cast<std::size_t>(domain.sides), n, all_needed());
  params.finish();
  const double turn = orientation(domain.centre, domain.a, domain.b);
  if (!(std::abs(turn) >
        1e-12 * glm::length(domain.centre) * glm::length(domain.a) * glm::length(domain.b))) {
    params.fail("the plane through \"centre\" along \"a\" and \"b\" must not contain the origin");
  }
  try {
    std::vector<IssPatch> patches;
    for (PlanarIss& s : smooth_fan(domain, n, sets)) patches.emplace_back(std::move(s));
    return patches;
  } catch (const std::invalid_argument& error) {
    params.fail(error.what());
  }
}

}  // namespace

TriangleNet net_of(const IssPatch& patch) {
  const auto* planar = std::get_if<PlanarIss>(&patch);
  return planar ? net_of(*planar) : std::get<TriangleNet>(patch);
}

std::vector<IssPatch> read_iss_patches(Params& params) {
  const bool plain =
      params.has("vertices") | params.has("moduli") | params.has("degree") | params.has("patches");
  const bool octants = params.has("octants"), fan = params.has("fan");
  if (plain + octants + fan > 1) {
    params.fail(
        "give one of \"octants\", \"fan\", or \"vertices\" with \"moduli\", \"degree\" and \"patches\"");
  }
  if (octants) return read_octants(params.object("octants"));
  if (fan) return read_fan(params.object("fan"));
  const std::vector<dvec3> vertices = read_vertices(params);
  const int n = static_cast<int>(params.integer("degree", 3, 1, max_degree));
  PatchReader reader(vertices, n);
  std::vector<IssPatch> patches;
  if (!params.has("patches")) {
    if (vertices.size() != 3) params.fail("\"patches\" is missing: which vertices make a triangle?");
    patches.emplace_back(planar_iss(n, {vertices[0], vertices[1], vertices[2]},
                                    std::vector<double>(static_cast<std::size_t>(triangle_size(n)), 1.0)));
    if (const auto fault = partition_fault(1, {vertices[2], vertices[1], vertices[0]})) {
      params.fail("vertices", *fault);
    }
    return patches;
  }
  for (Params& patch : params.objects("patches")) patches.push_back(reader.read(patch));
  if (patches.empty()) params.fail("patches", "there is no patch");
  return patches;
}

}  // namespace rondure
