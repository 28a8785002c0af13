// Every tiling: how its patches meet, where they are regular, that each direction is covered once.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/bezier/oracle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

struct TilingCase {
  const char* parameters;
  int patches;
  int pairs;                    // edges that two patches share from end to end
  int pointwise;                // of these, those along which the two agree point by point
  int identical;                // of these, those whose control points are the same bit by bit
  int whole_sides, half_sides;  // sides with a corner of other patches in the middle, and those at it
  int straight;                 // corners of 180 degrees, where the two tangents are parallel
};

// Neighbours that are mirror images of each other share the weights along the common edge, the others only
// its points.
const TilingCase tiling_cases[] = {
    {R"("topology": "hemispheres")", 2, 4, 4, 4, 0, 0, 8},
    {R"("topology": "cube")", 6, 12, 12, 12, 0, 0, 0},
    // Four edges are quadratic on one side and quartic on the other.
    {R"("topology": "cube_2_4")", 6, 12, 12, 8, 0, 0, 0},
    {R"("topology": "icosahedron_pairs")", 10, 20, 20, 10, 0, 0, 0},
    {R"("topology": "icosahedron_pairs", "corner_weights": "unit")", 10, 20, 10, 10, 0, 0, 0},
    {R"("topology": "octahedron_pairs")", 4, 8, 8, 8, 0, 0, 8},
    {R"("topology": "tetrahedron_quads")", 12, 24, 24, 24, 0, 0, 0},
    {R"("topology": "tetrahedron_quads", "corner_weights": "unit")", 12, 24, 24, 24, 0, 0, 0},
    {R"("topology": "octahedron_quads", "middle_weight": 2)", 24, 48, 48, 48, 0, 0, 0},
    {R"("topology": "icosahedron_quads")", 60, 120, 120, 120, 0, 0, 0},
    {R"("topology": "rhombicuboctahedron")", 54, 108, 108, 36, 0, 0, 0},
    {R"("topology": "rhombicuboctahedron", "reading": 42)", 42, 48, 48, 48, 24, 48, 0}};

Surface tiling(const TilingCase& c) {
  return build_family(fmt::format(R"({{"type": "sphere_tiling", {}}})", c.parameters));
}

struct Edge {
  std::size_t patch;
  std::vector<dvec4> points;
  dvec3 start() const { return dvec3(points.front()) / points.front().w; }
  dvec3 end() const { return dvec3(points.back()) / points.back().w; }
  // In extended precision, of a degree that is even.
  dvec3 at(double t) const {
    long double x[4] = {0, 0, 0, 0};
    const int n = static_cast<int>(points.size()) - 1;
    for (int k = 0; k <= n; ++k) {
      const long double b = static_cast<long double>(binomial(n, k)) *
                            std::pow(static_cast<long double>(t), k) *
                            std::pow(1 - static_cast<long double>(t), n - k);
      for (int c = 0; c < 4; ++c)
        x[c] += b * static_cast<long double>(points[static_cast<std::size_t>(k)][c]);
    }
    return {static_cast<double>(x[0] / x[3]), static_cast<double>(x[1] / x[3]),
            static_cast<double>(x[2] / x[3])};
  }
};

std::vector<Edge> edges_of(const Surface& surface) {
  std::vector<Edge> all;
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const auto& net = std::get<TensorNet>(surface.patches[k]);
    Edge e[4] = {{k, {}}, {k, {}}, {k, {}}, {k, {}}};
    for (int i = 0; i <= net.m; ++i)
      e[0].points.push_back(net.at(i, 0)), e[2].points.push_back(net.at(net.m - i, net.n));
    for (int j = 0; j <= net.n; ++j)
      e[1].points.push_back(net.at(net.m, j)), e[3].points.push_back(net.at(0, net.n - j));
    all.insert(all.end(), e, e + 4);
  }
  return all;
}

bool near(const dvec3& a, const dvec3& b) { return glm::length(a - b) < 1e-12; }

// Both control polygons rounded to half an eps, weights within a factor of two: the curves differ by this.
constexpr double seam = 4 * 0x1p-52;

// How far b's curve is from a's at the same points, and from its circle.
void compare_pair(const Edge& a, const Edge& b, double& pointwise, double& apart) {
  const dvec3 axis = glm::normalize(glm::cross(a.start(), a.end()));
  for (const double t : {0.1, 0.25, 0.5, 0.8}) {
    pointwise = std::max(pointwise, glm::length(a.at(t) - b.at(1.0 - t)));
    apart = std::max({apart, std::abs(glm::dot(axis, a.at(t))), std::abs(glm::dot(axis, b.at(t)))});
  }
}

}  // namespace

TEST_CASE("every edge is shared by two patches", "[surfaces]") {
  for (const TilingCase& c : tiling_cases) {
    INFO(c.parameters);
    const Surface surface = tiling(c);
    CHECK(static_cast<int>(surface.patches.size()) == c.patches);
    const std::vector<Edge> edges = edges_of(surface);
    int pairs = 0, crowded = 0, pointwise = 0, identical = 0;
    WorstCase circles;
    std::vector<Edge> lonely;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      int partners = 0;
      for (std::size_t j = 0; j < edges.size(); ++j) {
        if (!near(edges[i].start(), edges[j].end()) || !near(edges[i].end(), edges[j].start())) continue;
        ++partners;
        if (j < i) continue;
        ++pairs;
        double at_parameters = 0.0, off_circle = 0.0;
        compare_pair(edges[i], edges[j], at_parameters, off_circle);
        circles.add(off_circle, seam, [&] { return fmt::format("edges {} and {}", i, j); });
        if (at_parameters <= seam) ++pointwise;
        std::vector<dvec4> reversed = edges[j].points;
        std::reverse(reversed.begin(), reversed.end());
        if (std::memcmp(reversed.data(), edges[i].points.data(), reversed.size() * sizeof(dvec4)) == 0)
          ++identical;
      }
      if (partners > 1) ++crowded;
      if (partners == 0) lonely.push_back(edges[i]);
    }
    INFO(circles.text());
    CHECK(pairs == c.pairs);
    CHECK(crowded == 0);
    CHECK(pointwise == c.pointwise);
    CHECK(identical == c.identical);
    CHECK(circles.failures() == 0);
    CHECK(static_cast<int>(lonely.size()) == c.whole_sides + c.half_sides);
    // A lonely side is met from the other side by two halves, end to end, on its circle.
    int whole = 0;
    WorstCase halves;
    for (const Edge& side : lonely) {
      for (const Edge& first : lonely) {
        if (!near(first.start(), side.end()) || !near(first.end(), glm::normalize(side.start() + side.end())))
          continue;
        for (const Edge& second : lonely) {
          if (!near(second.start(), first.end()) || !near(second.end(), side.start())) continue;
          ++whole;
          double ignored = 0.0, off_circle = 0.0;
          compare_pair(side, first, ignored, off_circle);
          compare_pair(side, second, ignored, off_circle);
          const dvec3 axis = glm::normalize(glm::cross(side.start(), side.end()));
          off_circle = std::max(off_circle, std::abs(glm::dot(axis, first.at(0.5))));
          off_circle = std::max(off_circle, std::abs(glm::dot(axis, second.at(0.5))));
          halves.add(off_circle, seam, [&] { return fmt::format("side of patch {}", side.patch); });
        }
      }
    }
    INFO(halves.text());
    CHECK(whole == c.whole_sides);
    CHECK(halves.failures() == 0);
  }
}

TEST_CASE("corners are singular where the paper says and nowhere else", "[surfaces]") {
  for (const TilingCase& c : tiling_cases) {
    INFO(c.parameters);
    const Surface surface = tiling(c);
    int parallel = 0, collapsed = 0, corners = 0;
    double flattest = 1.0, worst_grid = 1.0;
    for (const Net& net : surface.patches) {
      for (int k = 0; k < 4; ++k, ++corners) {
        const double u = k == 1 || k == 2, v = k >= 2;
        const oracle::BigPoint x = oracle::derivative(net, 0, 0, u, v),
                               p = oracle::derivative(net, 1, 0, u, v),
                               q = oracle::derivative(net, 0, 1, u, v);
        dvec3 a, b;
        for (int d = 0; d < 3; ++d) {
          const oracle::Big w2 = x.c[3] * x.c[3];
          a[d] = static_cast<double>((x.c[3] * p.c[d] - p.c[3] * x.c[d]) / w2);
          b[d] = static_cast<double>((x.c[3] * q.c[d] - q.c[3] * x.c[d]) / w2);
        }
        if (glm::length(a) < 1e-9 || glm::length(b) < 1e-9) {
          ++collapsed;
          continue;
        }
        // Sine of the interior angle: roundings of the net, or at least that of 144 degrees.
        const double sine = glm::length(glm::cross(a, b)) / (glm::length(a) * glm::length(b));
        if (sine < 1e-12)
          ++parallel;
        else
          flattest = std::min(flattest, sine);
      }
      for (int i = 0; i <= 12; ++i) {
        for (int j = 0; j <= 12; ++j) {
          if (i % 12 == 0 && j % 12 == 0) continue;
          const SurfaceJet s = surface_jet(net, i / 12.0, j / 12.0);
          // Outward: the sphere's normal is the point.
          worst_grid = std::min(worst_grid, glm::dot(glm::cross(s.du, s.dv), s.point) /
                                                (glm::length(s.du) * glm::length(s.dv)));
        }
      }
    }
    CHECK(collapsed == 0);
    CHECK(parallel == c.straight);
    CHECK(flattest > 0.5);
    // Near a singular corner the tangents are nearly parallel already, but still turn the right way.
    CHECK(worst_grid > (c.straight > 0 ? 0.01 : 0.3));
  }
}

TEST_CASE("octants collapse an edge each", "[surfaces]") {
  const Surface surface = build_family(R"({"type": "sphere_octant"})");
  int collapsed = 0;
  for (const Net& net : surface.patches) {
    for (const dvec2 at : {dvec2(0, 0), dvec2(1, 0), dvec2(1, 1), dvec2(0, 1)}) {
      const SurfaceJet s = surface_jet(net, at.x, at.y);
      if (glm::length(s.du) < 1e-15 || glm::length(s.dv) < 1e-15) ++collapsed;
    }
  }
  CHECK(collapsed == 16);
}

TEST_CASE("every direction is covered once", "[surfaces]") {
  NetMaker make(23);
  for (const TilingCase& c : tiling_cases) {
    INFO(c.parameters);
    const Surface surface = tiling(c);
    if (surface.patches.size() < 3) continue;  // hemispheres have no sides of their own
    std::vector<std::array<dvec3, 4>> sides;   // inward normals
    for (const Net& net : surface.patches) {
      const dvec3 corner[4] = {net_point(net, 0, 0), net_point(net, 1, 0), net_point(net, 1, 1),
                               net_point(net, 0, 1)};
      std::array<dvec3, 4> normals;
      for (std::size_t k = 0; k < 4; ++k) normals[k] = glm::cross(corner[k], corner[(k + 1) % 4]);
      sides.push_back(normals);
    }
    const Tracer tracer({{surface, Solver::newton}});
    int wrong = 0, elsewhere = 0, doubtful = 0;
    for (int k = 0; k < 2000; ++k) {
      const double x = make.uniform(-1.0, 1.0), y = make.uniform(-1.0, 1.0), z = make.uniform(-1.0, 1.0);
      const dvec3 d(x, y, z);
      int count = 0, owner = -1;
      bool on_side = glm::length(d) < 0.1;
      for (std::size_t p = 0; p < sides.size(); ++p) {
        double least = 1.0;
        for (const dvec3& n : sides[p]) least = std::min(least, glm::dot(n, d));
        on_side = on_side || std::abs(least) < 1e-12;
        if (least > 0.0) ++count, owner = static_cast<int>(p);
      }
      if (on_side) {
        ++doubtful;
        continue;
      }
      const std::vector<Hit> hits = tracer.all({dvec3(0.0), d});
      if (count != 1 || hits.size() != 1)
        ++wrong;
      else if (hits.front().patch != owner)
        ++elsewhere;
    }
    CHECK(wrong == 0);
    CHECK(elsewhere == 0);
    CHECK(doubtful < 50);
  }
}

}  // namespace rondure
