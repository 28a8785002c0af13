// Quadrics from matrices, and the maps onto them.
#include "renderer/projective/quadric.h"

#include <fmt/format.h>

#include <glm/matrix.hpp>

#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr QuadricKind kinds[] = {QuadricKind::ellipsoid, QuadricKind::two_sheets, QuadricKind::one_sheet,
                                 QuadricKind::elliptic_paraboloid, QuadricKind::hyperbolic_paraboloid};

lmat4 random_frame(NetMaker& make) {
  const lvec3 a = glm::normalize(lvec3(make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(1, 2)));
  const lvec3 b = glm::normalize(glm::cross(a, lvec3(make.uniform(1, 2), make.uniform(-1, 1), 0)));
  lmat4 frame(1);
  frame[0] = lvec4(b, 0), frame[1] = lvec4(glm::cross(a, b), 0), frame[2] = lvec4(a, 0);
  frame[3] = {make.uniform(-3, 3), make.uniform(-3, 3), make.uniform(-3, 3), 1};
  return frame;
}

long double largest(const lmat4& m) {
  long double most = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) most = std::max(most, std::abs(m[i][j]));
  }
  return most;
}

// The largest difference of the matrices when both are scaled to the same greatest entry.
long double off(const lmat4& a, const lmat4& b) {
  int i = 0, j = 0;
  for (int k = 0; k < 16; ++k) {
    if (std::abs(a[k / 4][k % 4]) > std::abs(a[i][j])) i = k / 4, j = k % 4;
  }
  return largest(a / a[i][j] - b / b[i][j]);
}

lmat4 diagonal(long double x, long double y, long double z, long double w) {
  lmat4 m(0);
  m[0][0] = x, m[1][1] = y, m[2][2] = z, m[3][3] = w;
  return m;
}

}  // namespace

TEST_CASE("matrices of quadrics are recognised, whatever their position and factor", "[projective]") {
  NetMaker make(21);
  WorstCase worst;
  int wrong = 0;
  for (int k = 0; k < 300; ++k) {
    const QuadricKind kind = kinds[k % 5];
    const Quadric given{
        kind, {make.uniform(0.2, 3), make.uniform(0.2, 3), make.uniform(0.2, 3)}, random_frame(make)};
    const lmat4 matrix =
        matrix_of(given) * static_cast<long double>(make.uniform(0.1, 2) * (k % 2 == 0 ? 1 : -1));
    const auto found = classify(matrix);
    const auto* quadric = std::get_if<Quadric>(&found);
    if (!quadric || quadric->kind != kind) {
      ++wrong;
      continue;
    }
    const auto text = [&] { return fmt::format("quadric {}", k); };
    // Some hundred roundings of 2^-64, conditioned by the ratios of the axes' squares, up to (3 / 0.2)^2.
    worst.add(double(off(matrix, matrix_of(*quadric))), 1e-14, text);
    // The frame is rigid and right-handed.
    const lmat4& f = quadric->frame;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        worst.add(double(std::abs(glm::dot(f[i], f[j]) - (i == j ? 1 : 0))), 1e-17, text);
    }
    worst.add(double(std::abs(glm::determinant(f) - 1)), 1e-17, text);
  }
  INFO(worst.text());
  CHECK(wrong == 0);
  CHECK(worst.failures() == 0);
  CHECK(worst.count() > 3000);
}

TEST_CASE("a diagonal matrix keeps its axes", "[projective]") {
  const auto ellipsoid = std::get<Quadric>(classify(diagonal(1, 4, 0.25L, -1)));
  CHECK(ellipsoid.frame == lmat4(1));
  CHECK(ellipsoid.semi_axes == lvec3(1, 0.5L, 2));
  const auto upright = std::get<Quadric>(classify(diagonal(-1, -4, 0.25L, -1)));
  CHECK(upright.kind == QuadricKind::two_sheets);
  CHECK(upright.frame == lmat4(1));
  CHECK(upright.semi_axes == lvec3(1, 0.5L, 2));
  const auto lying = std::get<Quadric>(classify(diagonal(-0.25L, 1, 4, -1)));
  CHECK(lying.kind == QuadricKind::one_sheet);
  CHECK(lying.frame[2] == lvec4(1, 0, 0, 0));
  CHECK(lying.semi_axes == lvec3(1, 0.5L, 2));
}

// Where axes are those of the coordinates nothing cancels, and small terms count.
TEST_CASE("long quadrics are not taken for cylinders", "[projective]") {
  const auto needle = std::get<Quadric>(classify(diagonal(1, 4, 0x1p-46L, -1)));
  CHECK(needle.kind == QuadricKind::ellipsoid);
  CHECK(needle.semi_axes == lvec3(1, 0.5L, 0x1p23L));
  const auto tube = std::get<Quadric>(classify(diagonal(1, 1, -0x1p-46L, -1)));
  CHECK(tube.kind == QuadricKind::one_sheet);
  CHECK(tube.semi_axes == lvec3(1, 1, 0x1p23L));
  lmat4 far = diagonal(1, 1, 0, 0);
  far[0][3] = far[3][0] = 0x1p44L, far[2][3] = far[3][2] = -0.5L;
  const auto bowl = std::get<Quadric>(classify(far));
  CHECK(bowl.kind == QuadricKind::elliptic_paraboloid);
  CHECK(bowl.semi_axes == lvec3(1, 1, 1));
  CHECK(bowl.frame[3] == lvec4(-0x1p44L, 0, -0x1p88L, 1));
  lmat4 sheet = diagonal(1, 0, 0, 0);
  sheet[0][3] = sheet[3][0] = 0x1p44L, sheet[2][3] = sheet[3][2] = -0.5L;
  CHECK(std::get<std::string>(classify(sheet)) == "a parabolic cylinder");
}

TEST_CASE("what is no smooth quadric is named", "[projective]") {
  struct Case {
    lmat4 matrix;
    const char* name;
  };
  const auto with = [](lmat4 m, int i, int j, long double value) {
    m[i][j] = m[j][i] = value;
    return m;
  };
  const Case cases[] = {
      {diagonal(1, 1, 1, 1), "imaginary ellipsoid"},
      {diagonal(1, 2, 3, 0), "imaginary cone"},
      {diagonal(1, 2, -3, 0), "elliptic cone"},
      {diagonal(1, 2, 0, -1), "elliptic cylinder"},
      {diagonal(1, -2, 0, -1), "hyperbolic cylinder"},
      {diagonal(1, 2, 0, 1), "imaginary cylinder"},
      {diagonal(0, -2, -1, -1), "imaginary cylinder"},
      {diagonal(1, -2, 0, 0), "a pair of planes"},
      {diagonal(1, 2, 0, 0), "imaginary pair of planes"},
      {with(diagonal(1, 0, 0, 0), 2, 3, 1), "parabolic cylinder"},
      {diagonal(1, 0, 0, -1), "parallel planes"},
      {diagonal(0, 0, 0, -1), "a plane or nothing"},
      {lmat4(0), "a plane or nothing"},
  };
  NetMaker make(22);
  for (const Case& c : cases) {
    INFO(c.name);
    // In place, and anywhere else.
    const lmat4 back = glm::inverse(random_frame(make));
    for (const lmat4& m : {c.matrix, -c.matrix, glm::transpose(back) * c.matrix * back}) {
      const auto found = classify(m);
      REQUIRE(std::holds_alternative<std::string>(found));
      INFO(std::get<std::string>(found));
      CHECK(std::get<std::string>(found).find(c.name) != std::string::npos);
    }
  }
}

TEST_CASE("the maps take delta and ruled_image to the quadric", "[projective]") {
  NetMaker make(23);
  WorstCase worst;
  int turned = 0;
  for (int k = 0; k < 500; ++k) {
    const Quadric quadric{
        kinds[k % 5], {make.uniform(0.2, 3), make.uniform(0.2, 3), make.uniform(0.2, 3)}, random_frame(make)};
    lvec4 p(make.point());
    const lvec4 x = map_to(quadric) * (is_ruled(quadric.kind) ? ruled_image(p, p) : delta(p));
    const lmat4 matrix = matrix_of(quadric);
    const long double scale = largest(matrix) * glm::dot(x, x);
    worst.add(double(std::abs(glm::dot(x, matrix * x)) / scale), 1e-17,
              [&] { return fmt::format("point {}", k); });
    // Images of the sphere go on facing outward.
    turned += !is_ruled(quadric.kind) && !(glm::determinant(map_to(quadric)) > 0);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(turned == 0);
  // Equation (38) as printed, in the order x, y, z, w of x1, x2, x3, x0.
  const lvec4 p(2, 3, 5, 7);
  CHECK(ruled_image(p, p) == lvec4(2 * 7 - 3 * 5, 3 * 7 + 2 * 5, 3 * 7 - 2 * 5, 2 * 7 + 3 * 5));
}

}  // namespace rondure
