// The arithmetic of leaves: the same bits on every instruction set, and what the general operations on nets
// say.

#include "renderer/intersect/leaf_arithmetic.h"

#include <fmt/core.h>

#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/restriction.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

std::vector<dvec4> random_net(int size, std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0), weight(0.5, 2.0);
  std::vector<dvec4> net;
  for (int k = 0; k < size; ++k) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random), w = weight(random);
    net.push_back({x, y, z, w});
  }
  return net;
}

RectangleCell random_cell(const TensorShape&, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.0, 0.5), size(0.1, 0.5);
  const double u = place(random), v = place(random), wide = size(random), high = size(random);
  return {{u, v}, {u + wide, v + high}};
}

TriangleCell random_cell(const TriangleShape&, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.0, 0.3), size(0.1, 0.4);
  const double u = place(random), v = place(random), side = size(random);
  return {{{u + side, v}, {u, v + side}, {u, v}}};
}

bool same(const SecondOrder<dvec4>& a, const SecondOrder<dvec4>& b) {
  return a.value == b.value && a.du == b.du && a.dv == b.dv && a.duu == b.duu && a.duv == b.duv &&
         a.dvv == b.dvv;
}
bool same(const FrameExtent& a, const FrameExtent& b) {
  return a.off == b.off && a.zeta_low == b.zeta_low && a.zeta_high == b.zeta_high && a.sagging == b.sagging &&
         a.a_low == b.a_low && a.a_high == b.a_high && a.b_low == b.b_low && a.b_high == b.b_high;
}
bool same(const Box& a, const Box& b) { return a.low == b.low && a.high == b.high; }
bool same(const NetScale& a, const NetScale& b) { return a.position == b.position && a.weight == b.weight; }

// By the general operations, one after the other (cell.h, GLM).
template <class Shape>
FrameExtent plain_extent(const Shape& shape, const FramedNets& nets) {
  const LeafFrame& f = nets.frame;
  const auto to_frame = [&](const dvec4& p) {
    const dvec2 across = p.x * f.across[0] + p.y * f.across[1] + p.z * f.across[2] + p.w * f.across[3];
    return nets.inverse_weight * dvec4(across, glm::dot(f.normal, p), p.w);
  };
  FrameExtent out{};
  Box range;
  for (int k = 0; k < shape.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const dvec4 here = to_frame(nets.points[k]);
    range.add(dvec3(here));
    out.off = glm::max(out.off, glm::abs(here - nets.parameters.linear[at]));
    if (!nets.parameters.has_squares) continue;
    double bend = 0.0;
    for (int j = 0; j < 3; ++j) bend += static_cast<double>(f.bend[j]) * nets.parameters.squares[j][at];
    out.sagging = std::max(out.sagging, std::fabs(here.z - bend));
  }
  if (!nets.parameters.has_squares) out.sagging = INFINITY;
  out.zeta_low = range.low.z, out.zeta_high = range.high.z;
  std::vector<dvec4> wide, by_a(static_cast<std::size_t>(shape.derived_a().size())),
      by_b(static_cast<std::size_t>(shape.derived_b().size()));
  for (int k = 0; k < shape.size(); ++k) wide.push_back(to_frame(nets.wide[k]));
  shape.derive_a(wide.data(), by_a.data()), shape.derive_b(wide.data(), by_b.data());
  const auto set = [](const std::vector<dvec4>& derivative, double degree, dvec4& low, dvec4& high) {
    low = high = derivative.front() / degree;
    for (const dvec4& d : derivative) low = glm::min(low, d / degree), high = glm::max(high, d / degree);
  };
  if constexpr (std::is_same_v<Shape, TensorShape>)
    set(by_a, shape.m, out.a_low, out.a_high), set(by_b, shape.n, out.b_low, out.b_high);
  else
    set(by_a, shape.n, out.a_low, out.a_high), set(by_b, shape.n, out.b_low, out.b_high);
  return out;
}

double apart(const dvec4& a, const dvec4& b) {
  const dvec4 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z, d.w});
}
double apart(const FrameExtent& a, const FrameExtent& b) {
  return std::max({apart(a.off, b.off), std::fabs(a.zeta_low - b.zeta_low),
                   std::fabs(a.zeta_high - b.zeta_high),
                   a.sagging == b.sagging ? 0.0 : std::fabs(a.sagging - b.sagging), apart(a.a_low, b.a_low),
                   apart(a.a_high, b.a_high), apart(a.b_low, b.b_low), apart(a.b_high, b.b_high)});
}

struct Tally {
  long compared = 0, different = 0;
  WorstCase worst;

  void add_sets(bool equal) { ++compared, different += !equal; }
};

// All that an arithmetic of both shapes is asked for, of a random net and cell.
template <class Shape>
void compare(const Shape& shape, const std::string& name, std::mt19937_64& random, Tally& tally) {
  const std::vector<dvec4> net = random_net(shape.size(), random);
  const auto cell = random_cell(shape, random);
  Restriction<Shape> restriction;
  restriction.start(shape, net);
  std::vector<dvec4> cut(net.size()), plain(net.size());
  restriction.points(cell, cut.data());
  shape.restrict_to(net.data(), cell, plain.data());
  // Sums of at most 2 (degree + 1) terms whose weights add up to 1, of numbers up to 2, rounded differently.
  const double tolerance = 1e-14;
  for (std::size_t k = 0; k < net.size(); ++k)
    tally.worst.add(apart(cut[k], plain[k]), tolerance, [&] { return fmt::format("{}, point {}", name, k); });
  std::vector<dvec4> magnitudes;
  for (const dvec4& p : net) magnitudes.push_back(glm::abs(p));
  shape.restrict_to(magnitudes.data(), cell, plain.data());
  NetScale scale;
  for (const dvec4& p : plain)
    scale = {std::max(scale.position, largest(dvec3(p))), std::max(scale.weight, p.w)};
  const NetScale found = restriction.scale(cell);
  tally.worst.add(
      std::max(std::fabs(found.position - scale.position), std::fabs(found.weight - scale.weight)), tolerance,
      [&] { return name + ", scale"; });

  LeafFrame frame{};
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int k = 0; k < 4; ++k) {
    frame.across[k].x = number(random), frame.across[k].y = number(random), frame.normal[k] = number(random);
    if (k < 3) frame.bend[k] = static_cast<float>(number(random));
  }
  const LeafParameters parameters = parameters_of(shape);
  const FramedNets nets{frame, 0.75, parameters, cut.data(), net.data()};
  const auto here = leaf_arithmetic(shape, Instructions::baseline);
  const dvec2 at = shape.to_patch(cell, Shape::center());
  const FrameExtent extent = here.extent(shape, nets);
  tally.worst.add(apart(extent, plain_extent(shape, nets)), tolerance, [&] { return name + ", extent"; });
  const SecondOrder<dvec4> jet = here.second(shape, net.data(), at);
  tally.add_sets(same(jet, shape.second(net.data(), at)));
  Box hull;
  for (const dvec4& p : cut) hull.add(dvec3(p) / p.w);
  tally.add_sets(same(here.box(shape.size(), cut.data()), hull));

  if (!has(Instructions::avx2)) return;
  const auto there = leaf_arithmetic(shape, Instructions::avx2);
  tally.add_sets(same(extent, there.extent(shape, nets)));
  tally.add_sets(same(jet, there.second(shape, net.data(), at)));
  tally.add_sets(same(hull, there.box(shape.size(), cut.data())));
  if constexpr (std::is_same_v<Shape, TensorShape>) {
    std::vector<double> weights;
    for (int k = 0; k < std::max((shape.m + 1) * (shape.m + 1), (shape.n + 1) * (shape.n + 1)); ++k)
      weights.push_back(number(random));
    here.along_u(shape, weights.data(), net.data(), cut.data());
    there.along_u(shape, weights.data(), net.data(), plain.data());
    tally.add_sets(cut == plain);
    here.along_v(shape, weights.data(), net.data(), cut.data());
    there.along_v(shape, weights.data(), net.data(), plain.data());
    tally.add_sets(cut == plain);
    tally.add_sets(same(here.scale_along_v(shape, weights.data(), net.data()),
                        there.scale_along_v(shape, weights.data(), net.data())));
  } else {
    here.restrict_to(shape, cell, net.data(), cut.data());
    there.restrict_to(shape, cell, net.data(), plain.data());
    tally.add_sets(cut == plain);
    tally.add_sets(same(here.scale(shape.size(), net.data()), there.scale(shape.size(), net.data())));
  }
}

}  // namespace

TEST_CASE("Leaves are made by the same arithmetic on every instruction set", "[solvers]") {
  if (!has(Instructions::avx2)) WARN("this machine has the baseline only");
  std::mt19937_64 random(9);
  Tally tally;
  for (int round = 0; round < 20; ++round) {
    for (const TensorShape shape :
         {TensorShape{1, 1}, {1, 3}, {2, 2}, {2, 4}, {3, 3}, {4, 2}, {4, 4}, {5, 7}})
      compare(shape, fmt::format("rectangle of degree ({}, {})", shape.m, shape.n), random, tally);
    for (int n = 1; n <= 7; ++n)
      compare(TriangleShape{n}, fmt::format("triangle of degree {}", n), random, tally);
  }
  INFO(tally.worst.text());
  CHECK(tally.different == 0);
  CHECK(tally.worst.failures() == 0);
  CHECK(tally.compared > 20 * 15 * 2);
}
