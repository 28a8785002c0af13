// B-spline surfaces on the sphere as scenes ask for them.
#include <fmt/format.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/rational.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using nlohmann::json;

json bspline_reference() {
  std::ifstream file(source_folder() + "/tests/data/dhj_bspline_surface.json");
  return json::parse(file);
}

// A net of random points near those of a stereographic plane, so that it has no base point.
std::string random_net(NetMaker& make, int rows, int columns) {
  json net = json::array();
  for (int i = 0; i < rows; ++i) {
    json row = json::array();
    for (int j = 0; j < columns; ++j) {
      const double x = 0.5 * j + make.uniform(-0.2, 0.2), y = 0.5 * i + make.uniform(-0.2, 0.2);
      row.push_back({make.uniform(1, 2), x, y, make.uniform(-0.3, 0.3)});
    }
    net.push_back(row);
  }
  return net.dump();
}

}  // namespace

TEST_CASE("the reference's B-spline surface, piece by piece", "[surfaces]") {
  const json data = bspline_reference();
  const Surface surface = build_family(data["object"].dump());
  REQUIRE(surface.patches.size() == data["pieces"].size());
  WorstCase worst;
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const auto& net = std::get<TensorNet>(surface.patches[k]);
    const json& expected = data["pieces"][k];
    REQUIRE((net.m == 4 && net.n == 2));
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; j <= 2; ++j) {
        for (int d = 0; d < 4; ++d) {
          // Coordinates up to 7; the preimage's thirds and sixths are rounded too.
          worst.add(std::abs(net.at(i, j)[d] - expected[i][j][d].get<double>()), 32 * 0x1p-53,
                    [&] { return fmt::format("piece {} ({}, {}) {}", k, i, j, d); });
        }
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() == 4 * 60);
  CHECK(worst.failures() == 0);
}

TEST_CASE("pieces lie on the sphere, share their edges and are as smooth as their knots", "[surfaces]") {
  NetMaker make(81);
  WorstCase on_sphere, smooth;
  int shared = 0;
  for (int degree = 1; degree <= 3; ++degree) {
    const int rows = degree + 3, columns = degree + 2;
    const Surface surface =
        build_family(fmt::format(R"({{"type": "spherical_bspline", "degree": [{0}, {0}], "net": {1}}})",
                                 degree, random_net(make, rows, columns)));
    const std::size_t across = static_cast<std::size_t>(columns - degree);
    REQUIRE(surface.patches.size() == static_cast<std::size_t>(rows - degree) * across);
    for (const Net& net : surface.patches) {
      const auto& t = std::get<TensorNet>(net);
      CHECK((t.m == 2 * degree && t.n == 2 * degree));
      for (int k = 0; k < 20; ++k)
        on_sphere.add(std::abs(glm::length(net_point(net, make.uniform(0, 1), make.uniform(0, 1))) - 1.0),
                      16 * 0x1p-52, [&] { return fmt::format("degree {}", degree); });
    }
    // From each patch to the next along u: control points of the common edge, and differences up to order
    // degree - 1, which simple equidistant knots keep.
    for (std::size_t k = 0; k + across < surface.patches.size(); ++k) {
      const auto &a = std::get<TensorNet>(surface.patches[k]),
                 &b = std::get<TensorNet>(surface.patches[k + across]);
      for (int j = 0; j <= a.n; ++j) {
        shared += a.at(a.m, j) == b.at(0, j);
        for (int order = 1; order < degree; ++order) {
          dvec4 left(0.0), right(0.0);
          for (int r = 0; r <= order; ++r) {
            const double sign = (order - r) % 2 == 0 ? 1.0 : -1.0;
            left += sign * binomial(order, r) * a.at(a.m - order + r, j);
            right += sign * binomial(order, r) * b.at(r, j);
          }
          // Sums of up to 4 numbers below 30, rounded.
          smooth.add(glm::length(left - right), 1e-13,
                     [&] { return fmt::format("degree {}, order {}", degree, order); });
        }
      }
    }
  }
  INFO(on_sphere.text());
  INFO(smooth.text());
  CHECK(on_sphere.failures() == 0);
  CHECK(smooth.failures() == 0);
  CHECK(smooth.count() > 40);
  // 2 knots along u, as many patches across, 2 degree + 1 points an edge.
  CHECK(shared == 2 * 2 * 3 + 2 * 2 * 5 + 2 * 2 * 7);
}

// A knot of multiplicity m keeps the derivatives up to order degree - m, and no more (section 4; equation 35
// and the sentence before it). Homogeneous derivatives in the spline's parameter are compared from both
// sides.
TEST_CASE("knots of any multiplicity and spacing leave the derivatives that they should", "[surfaces]") {
  NetMaker make(83);
  WorstCase kept;
  int broken = 0, knots_seen = 0;
  for (int degree = 1; degree <= 4; ++degree) {
    for (int multiplicity = 1; multiplicity <= degree; ++multiplicity) {
      for (const bool along_u : {true, false}) {
        // One inner knot, at a third.
        std::string knots = "[";
        for (int k = 0; k <= degree; ++k) knots += "-1, ";
        for (int k = 0; k < multiplicity; ++k) knots += "0.5, ";
        for (int k = 0; k <= degree; ++k) knots += k < degree ? "3.5, " : "3.5]";
        const double before = 1.5, after = 3.0;
        const std::string plain = "[0, 0, 1, 1]";
        const int points = degree + 1 + multiplicity;
        const Surface surface = build_family(fmt::format(
            R"({{"type": "spherical_bspline", "degree": [{}, {}], "net": {}, "knots": [{}, {}]}})",
            along_u ? degree : 1, along_u ? 1 : degree,
            along_u ? random_net(make, points, 2) : random_net(make, 2, points), along_u ? knots : plain,
            along_u ? plain : knots));
        REQUIRE(surface.patches.size() == 2);
        ++knots_seen;
        const auto &a = std::get<TensorNet>(surface.patches[0]), &b = std::get<TensorNet>(surface.patches[1]);
        const int n = 2 * degree;
        const auto at = [&](const TensorNet& net, int k) { return along_u ? net.at(k, 1) : net.at(1, k); };
        double jump_after = 0.0;
        for (int order = 0; order <= degree - multiplicity + 1; ++order) {
          dvec4 left(0.0), right(0.0);
          double size = 0.0;
          for (int r = 0; r <= order; ++r) {
            const double factor = ((order - r) % 2 == 0 ? 1.0 : -1.0) * binomial(order, r);
            const dvec4 low = factor / std::pow(before, order) * at(a, n - order + r),
                        high = factor / std::pow(after, order) * at(b, r);
            left += low, right += high;
            size += glm::length(low) + glm::length(high);
          }
          const double jump = glm::length(left - right);
          // Some roundings of each control point.
          if (order <= degree - multiplicity)
            kept.add(jump, 16 * 0x1p-53 * size, [&] {
              return fmt::format("degree {}, knot of {}, order {}", degree, multiplicity, order);
            });
          else
            jump_after = jump / size;
        }
        broken += jump_after > 1e-9;  // rounding: some 1e-15
      }
    }
  }
  INFO(kept.text());
  CHECK(kept.failures() == 0);
  CHECK(kept.count() == 2 * (1 + 3 + 6 + 10));
  CHECK(knots_seen == 2 * 10);
  CHECK(broken == knots_seen);
}

TEST_CASE("the size of a net in projective space is of no matter", "[surfaces]") {
  const auto scaled = [](const char* form, double factor) {
    std::string points[4];
    const double base[4][4] = {
        {1, -0.5, -0.4, 0}, {1, 0.5, -0.5, 0.1}, {1.2, -0.4, 0.5, 0}, {1, 0.6, 0.5, 0}};
    for (int k = 0; k < 4; ++k)
      points[k] = fmt::format("[{}, {}, {}, {}]", base[k][0] * factor, base[k][1] * factor,
                              base[k][2] * factor, base[k][3] * factor);
    return build_family(fmt::format(fmt::runtime(form), points[0], points[1], points[2], points[3]));
  };
  for (const char* form :
       {R"({{"type": "spherical_bspline", "degree": [1, 1], "net": [[{}, {}], [{}, {}]]}})",
        R"({{"type": "projected_net", "patches": [{{"degree": [1, 1], "net": [[{}, {}], [{}, {}]]}}]}})",
        R"({{"type": "curve", "preimage": [{}, {}, {}, {}]}})"}) {
    INFO(form);
    const Surface usual = scaled(form, 1.0);
    // Powers of two change no bit.
    for (const double factor : {0x1p900, 0x1p-900}) {
      const Surface other = scaled(form, factor);
      REQUIRE(other.patches.size() == usual.patches.size());
      double off = 0.0;
      for (std::size_t k = 0; k < usual.patches.size(); ++k)
        off = std::max(
            off, glm::distance(net_point(usual.patches[k], 0.3, 0.6), net_point(other.patches[k], 0.3, 0.6)));
      CHECK(off < 1e-13);
    }
  }
}

TEST_CASE("B-splines without a surface are refused", "[surfaces]") {
  const std::string net = R"("net": [[[1,0,0,0],[1,0,1,0],[1,0,2,0]],[[1,1,0,0],[1,1,1,0],[1,1,2,0]]])";
  const auto refused = [](const std::string& rest, const std::string& part) {
    const std::string message = family_error(R"({"type": "spherical_bspline", )" + rest + "}");
    INFO(rest << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  refused(net, "degree 2 needs at least 3 control points along u");
  refused(net + R"(, "degree": [1, 2], "knots": [[0,0,1,1],[0,0,0,1,1]])",
          "along v: 3 control points of degree 2 need 6 knots");
  refused(net + R"(, "degree": [1, 2], "knots": [[0,0,1,0.5],[0,0,0,1,1,1]])", "along u: knot 3 is less");
  refused(net + R"(, "degree": [1, 2], "knots": [[0,0,1,"x"],[0,0,0,1,1,1]])",
          "a knot must be a finite number");
  refused(net + R"(, "degree": [1, 1], "knots": [[0,0,1,1]])", "two arrays of numbers");
  refused(R"("degree": [1, 1], "net": [[[1,0,0,0],[1,0,1,0]],[[1,1,0,0]]])", "equally many control points");
  refused(R"("degree": [1, 1], "net": [[[1,0,0,0],[1,0,1,0]],[[-1,0,0,0],[1,1,1,0]]])", "(u, v) = (0.5, ");
  refused(R"("degree": [1, 1], "net": [[[1,0,0],[1,0,1]],[[1,0,0],[1,1,1]]])", "[p0, p1, p2, p3]");
}

}  // namespace rondure
