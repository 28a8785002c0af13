// Spherical partitions, and single-valuedness, which does not follow from them.
#include "renderer/inverse_spherical/partition.h"

#include <glm/geometric.hpp>

#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"

namespace rondure {
namespace {

std::vector<dvec3> octant(int n) {
  return general_form(PlanarIss{n,
                                {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)},
                                std::vector<double>(static_cast<std::size_t>(triangle_size(n)), 1.0)})
      .u;
}

dvec3& at(std::vector<dvec3>& u, int n, int i, int j) {
  return u[static_cast<std::size_t>(triangle_index(n, i, j))];
}

// An n-partition of degree 3 whose projection domain folds over: found by search, confirmed in whole numbers.
std::vector<dvec3> folding_partition() {
  std::vector<dvec3> u(10);
  at(u, 3, 3, 0) = {1, 0, 0}, at(u, 3, 0, 3) = {0, 1, 0}, at(u, 3, 0, 0) = {0, 0, 1};
  at(u, 3, 2, 1) = {36, 16, 0}, at(u, 3, 1, 2) = {1, 3, 0};
  at(u, 3, 0, 2) = {0, 24, 24}, at(u, 3, 0, 1) = {0, 4, 6};
  at(u, 3, 1, 0) = {7, 0, 6}, at(u, 3, 2, 0) = {40, 0, 24}, at(u, 3, 1, 1) = {48, 128, 16};
  return u;
}

}  // namespace

TEST_CASE("planar domains always partition, and never fold", "[iss]") {
  NetMaker make(31);
  int faults = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 12;
    PlanarIss s = random_planar_iss(make, n);
    if (trial % 2 == 1) std::swap(s.corners[0], s.corners[1]);  // clockwise
    const Iss general = general_form(s);
    faults += partition_fault(n, general.u).has_value() + fold_fault(n, general.u).has_value();
  }
  CHECK(faults == 0);
}

TEST_CASE("what breaks a partition is named", "[iss]") {
  const auto say = [](const std::vector<dvec3>& u, int n) { return partition_fault(n, u).value_or("none"); };
  std::vector<dvec3> u = octant(3);
  CHECK(say(u, 3) == "none");
  at(u, 3, 1, 1) = {0.1, 1, 0.02};
  // 111 is now beyond the side from 120 to 021 of its neighbour.
  CHECK(say(u, 3) == "the sub-triangle <120, 021, 111> is inverted, so that it overlaps its neighbours");
  u = octant(3);
  at(u, 3, 1, 1) = dvec3(2, 1, 0) + dvec3(2, 0, 1);
  CHECK(say(u, 3) == "the sub-triangle <210, 111, 201> is flat");
  u = octant(3);
  std::swap(at(u, 3, 2, 1), at(u, 3, 1, 2));
  CHECK(say(u, 3) == "120 does not come after 210 on the side from 300 to 030");
  u = octant(3);
  at(u, 3, 0, 1).x = 1e-6;
  CHECK(say(u, 3) == "012 does not lie on the great circle through 030 and 003");
  at(u, 3, 0, 1).x = 1e-12;
  CHECK(say(u, 3) == "none");
  u = octant(12);
  at(u, 12, 0, 0) = {1, 1, 0};
  CHECK(say(u, 12) == "the three corners lie on one great circle, and span no spherical triangle");
}

TEST_CASE("a partition does not make a surface single-valued", "[iss]") {
  const std::vector<dvec3> u = folding_partition();
  CHECK_FALSE(partition_fault(3, u).has_value());
  const std::string fault = fold_fault(3, u).value_or("none");
  CHECK_THAT(fault, Catch::Contains("folds over"));
  // The map does turn round: at (0.2, 0.65, 0.15) neighbouring directions turn the other way than at the
  // corners.
  const auto direction = [&](double a, double b) {
    const Iss s{3, u, std::vector<double>(10, 1.0)};
    dvec3 sum(0.0);
    for (int i = 0; i <= 3; ++i) {
      for (int j = 0; j <= 3 - i; ++j) {
        const double k = 3 - i - j, c = 1.0 - a - b;
        const double f[4] = {1, 1, 2, 6};
        sum += 6.0 / (f[i] * f[j] * f[3 - i - j]) * std::pow(a, i) * std::pow(b, j) * std::pow(c, k) *
               s.u[static_cast<std::size_t>(triangle_index(3, i, j))];
      }
    }
    return glm::normalize(sum);
  };
  const auto turn = [&](double a, double b) {
    const double h = 1e-3;
    return orientation(direction(a + h, b), direction(a, b + h), direction(a, b));
  };
  CHECK(turn(0.2, 0.65) < -1e-9);
  CHECK(turn(0.9, 0.05) > 1e-9);
}

TEST_CASE("domains that are nearly planar are certified", "[iss]") {
  NetMaker make(32);
  int certified = 0, both = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 5;
    const Iss s = random_general_iss(make, n);
    if (partition_fault(n, s.u)) continue;
    ++both;
    certified += !fold_fault(n, s.u).has_value();
  }
  // Stretched by a tenth at most, none folds.
  CHECK(both == 60);
  CHECK(certified == both);
}

}  // namespace rondure
