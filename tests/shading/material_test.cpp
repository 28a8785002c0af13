#include "renderer/shading/material.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "renderer/sampling/sampler.h"
#include "renderer/sampling/warps.h"
#include "renderer/shading/fresnel.h"
#include "tests/catch.h"
#include "tests/intersect/random_direction.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using std::numbers::pi;

const dvec3 surface_normal = glm::normalize(dvec3(0.3, -0.5, 0.8));

dvec3 direction_at(double degrees) {
  const Frame f = frame_about(surface_normal);
  const double a = degrees * pi / 180.0;
  return f.to_world({std::sin(a) * 0.6, std::sin(a) * 0.8, std::cos(a)});
}

std::vector<Material> rough_materials() {
  std::vector<Material> all = {{Diffuse{{0.9, 0.5, 0.1}}}};
  for (const double alpha : {0.05, 0.3, 1.0}) {
    RoughConductor m;
    m.alpha = alpha;
    all.push_back({m});
  }
  return all;
}

// Bins over the sphere about a direction, in s = sqrt((1 - z) / 2) and angle: fine where a narrow lobe is.
constexpr int rings = 16, sectors = 12, bins = rings * sectors;

std::size_t bin_of(const Frame& frame, const dvec3& direction) {
  const dvec3 d = frame.to_local(direction);
  const int ring = std::clamp(int(std::sqrt(std::max(0.0, (1.0 - d.z) / 2.0)) * rings), 0, rings - 1);
  const double turn = std::atan2(d.y, d.x) / (2.0 * pi) + 0.5;
  return static_cast<std::size_t>(ring * sectors + std::min(int(turn * sectors), sectors - 1));
}

TEST_CASE("scattering samples follow their density", "[shading]") {
  constexpr int n = 100000;
  // Midpoints to integrate the density over a bin, along s and around. The narrowest lobe is some 2 alpha =
  // 0.1 wide in s: 100 midpoints.
  constexpr int sub_s = 64, sub_a = 32;
  for (const Material& material : rough_materials()) {
    for (const double angle : {0.0, 40.0, 80.0, 130.0}) {
      const dvec3 out = direction_at(angle);
      const Frame frame =
          frame_about(2.0 * glm::dot(out, surface_normal) * surface_normal - out);  // the lobe at the pole
      std::vector<double> found(bins, 0.0), expected(bins, 0.0);
      double lost = 0.0;
      WorstCase agreement;
      for (int i = 0; i < n; ++i) {
        Sampler sampler(11, i, 0, 0);  // a pixel a sample: independent, as chi-square asks
        const double lobe = sampler.next_1d();
        const auto s = sample_scattering(material, surface_normal, out, lobe, sampler.next_2d());
        if (!s) {
          ++lost;
          continue;
        }
        ++found[bin_of(frame, s->direction)];
        // Sample, density and value are computed on different ways; the half vector between nearly mirrored
        // directions keeps 1e-16, and the narrowest lobe magnifies it by 1 / alpha^2 = 400.
        const double pdf = scattering_pdf(material, surface_normal, out, s->direction);
        const auto describe = [&] { return std::to_string(angle) + " degrees, sample " + std::to_string(i); };
        agreement.add(std::abs(pdf / s->pdf - 1.0), 1e-9, describe);
        const dvec3 f = evaluate_scattering(material, surface_normal, out, s->direction);
        agreement.add(glm::length(f - s->weight * s->pdf), 1e-9 * (1.0 + s->pdf), describe);
      }
      for (int ring = 0; ring < rings; ++ring) {
        for (int sector = 0; sector < sectors; ++sector) {
          double& sum = expected[static_cast<std::size_t>(ring * sectors + sector)];
          for (int i = 0; i < sub_s * sub_a; ++i) {
            const double along = (ring + (i / sub_a + 0.5) / sub_s) / rings;
            const double z = 1.0 - 2.0 * along * along;
            const double a = 2.0 * pi * ((sector + (i % sub_a + 0.5) / sub_a) / sectors - 0.5);
            const double r = std::sqrt(1.0 - z * z);
            const dvec3 in = frame.to_world({r * std::cos(a), r * std::sin(a), z});
            const double solid_angle = 8.0 * pi * along / bins / (sub_s * sub_a);  // 4 s ds da
            sum += scattering_pdf(material, surface_normal, out, in) * solid_angle * n;
          }
        }
      }
      // Bins that expect less than 10 are pooled. Midpoints straddle the horizon, where the density has a
      // jump: one cell in 64 along s, or in 32 around, of a bin that it crosses; 2% on top of chance.
      double chi2 = 0.0, rest = 0.0, rest_expected = 0.0;
      int degrees = 0;
      for (std::size_t b = 0; b < bins; ++b) {
        if (expected[b] < 10.0) {
          rest += found[b];
          rest_expected += expected[b];
          continue;
        }
        const double slack = std::max(0.0, std::abs(found[b] - expected[b]) - 0.02 * expected[b]);
        chi2 += slack * slack / expected[b];
        ++degrees;
      }
      INFO("material " << material.scattering.index() << ", " << angle << " degrees: chi2 " << chi2 << " of "
                       << degrees << ", lost " << lost << ", rest " << rest << " of " << rest_expected << "; "
                       << agreement.text());
      CHECK(agreement.failures() == 0);
      CHECK(degrees > 3);
      CHECK(chi2 < degrees + 6.0 * std::sqrt(2.0 * degrees));  // mean k, deviation sqrt(2 k); six of them
      CHECK(std::abs(rest - rest_expected) < 6.0 * std::sqrt(rest_expected + 1.0) + 0.01 * n);
    }
  }
}

TEST_CASE("no material returns more light than it gets, and diffuse returns its albedo", "[shading]") {
  std::vector<Material> all = rough_materials();
  all.push_back({Mirror{{1.0, 0.5, 0.2}}});
  all.push_back({Dielectric{}});
  for (const Material& material : all) {
    for (const double angle : {0.0, 30.0, 60.0, 85.0, 110.0}) {
      const dvec3 out = direction_at(angle);
      dvec3 sum(0.0);
      constexpr int n = 4096;
      for (std::uint32_t i = 0; i < n; ++i) {
        Sampler sampler(5, 1, 1, i);
        const double lobe = sampler.next_1d();
        const auto s = sample_scattering(material, surface_normal, out, lobe, sampler.next_2d());
        if (s) sum += s->weight / s->squeeze;
      }
      sum /= double(n);
      INFO("material " << material.scattering.index() << ", " << angle << " degrees: " << sum.x << " "
                       << sum.y << " " << sum.z);
      for (int c = 0; c < 3; ++c) CHECK(sum[c] <= 1.0 + 1e-12);
      // The true Fresnel share and shadowing leave a metal at least a quarter of red; glass and mirrors all.
      CHECK(sum.x > 0.25);
      if (material.scattering.index() == 0) CHECK(sum.x == Approx(0.9).epsilon(1e-12));
      if (material.scattering.index() == 2) CHECK(sum.x == Approx(1.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("scattering is reciprocal", "[shading]") {
  WorstCase worst;
  for (const Material& material : rough_materials()) {
    for (int i = 0; i < 2000; ++i) {
      Sampler sampler(6, i, 0, 0);
      const Frame f = frame_about(i % 2 == 0 ? surface_normal : -surface_normal);
      const dvec3 a = f.to_world(sample_cosine_hemisphere(sampler.next_2d()));
      const dvec3 b = f.to_world(sample_cosine_hemisphere(sampler.next_2d()));
      const dvec3 ab =
          evaluate_scattering(material, surface_normal, a, b) / std::abs(glm::dot(surface_normal, b));
      const dvec3 ba =
          evaluate_scattering(material, surface_normal, b, a) / std::abs(glm::dot(surface_normal, a));
      // Cosines as small as 1e-3 lose three digits.
      worst.add(glm::length(ab - ba), 1e-10 * glm::length(ab) + 1e-300, [&] { return std::to_string(i); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("Fresnel reflectance has its known values", "[shading]") {
  CHECK(fresnel_dielectric(1.0, 1.5) == Approx(0.04).epsilon(1e-14));
  CHECK(fresnel_dielectric(0.0, 1.5) == Approx(1.0).epsilon(1e-14));
  // At Brewster's angle, tan = n, the p part vanishes and the s part is ((n^2 - 1) / (n^2 + 1))^2.
  const double brewster = std::cos(std::atan(1.5));
  CHECK(fresnel_dielectric(brewster, 1.5) == Approx(0.5 * std::pow(1.25 / 3.25, 2)).epsilon(1e-13));
  CHECK(fresnel_dielectric(std::cos(std::asin(1.0 / 1.5)) - 1e-9, 1.0 / 1.5) == 1.0);
  WorstCase worst;
  for (int i = 1; i < 100; ++i) {
    const double cosine = i / 100.0;
    const double far = std::sqrt(1.0 - (1.0 - cosine * cosine) / (1.5 * 1.5));
    const auto describe = [&] { return std::to_string(cosine); };
    // The same from both sides: the way back finds the cosine's square to some eps, so the cosine to eps /
    // cosine and the reflectance, whose slope is below 6, to three times 6 eps / cosine. And a metal without
    // absorption is a dielectric.
    const double back = fresnel_dielectric(far, 1.0 / 1.5);
    worst.add(std::abs(fresnel_dielectric(cosine, 1.5) - back), 4e-15 / cosine, describe);
    worst.add(std::abs(fresnel_conductor(cosine, dvec3(1.5), dvec3(0.0)).x - fresnel_dielectric(cosine, 1.5)),
              1e-14, describe);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  const dvec3 copper = fresnel_conductor(1.0, {0.2, 0.92, 1.1}, {3.9, 2.45, 2.14});
  CHECK(copper.x ==
        Approx((0.64 + 15.21) / (1.44 + 15.21)).epsilon(1e-13));  // ((n-1)^2 + k^2) / ((n+1)^2 + k^2)
}

// By less than rounding the law of reflection alone puts the light on either side: of these directions a
// fifth.
TEST_CASE("light that grazes leaves on the side where it came", "[shading]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> digits(13.0, 20.0);
  long through = 0;
  WorstCase moved;
  for (const Material& material : {Material{Mirror{}}, Material{Dielectric{1.5, dvec3(1.0)}}})
    for (int k = 0; k < 20000; ++k) {
      const dvec3 n = random_direction(random);
      const dvec3 along = glm::normalize(glm::cross(n, random_direction(random)));
      const dvec3 out =
          glm::normalize(along + (k % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, -digits(random)) * n);
      const double height = glm::dot(n, out);
      const auto reflected = sample_scattering(material, n, out, 0.0, {});
      REQUIRE(reflected);
      const double leaves = glm::dot(n, reflected->direction);
      through += height < 0.0 ? !(leaves < 0.0) : !(leaves > 0.0);
      // 2^-49 as its height is raised at most, and four roundings.
      moved.add(glm::length(reflected->direction + out - 2.0 * height * n), 0x1p-49 + 0x1p-51,
                [&] { return fmt::format("at a height of {}", height); });
    }
  CHECK(through == 0);
  INFO(moved.text());
  CHECK(moved.failures() == 0);
}

TEST_CASE("glass obeys Snell's law and splits light by Fresnel's", "[shading]") {
  const Material glass{Dielectric{1.5, dvec3(0.8)}};
  for (const double angle : {0.0, 25.0, 70.0, 120.0, 160.0}) {
    const dvec3 out = direction_at(angle);
    const double side = glm::dot(out, surface_normal);
    const double eta = side > 0 ? 1.5 : 1.0 / 1.5;
    const double reflectance = fresnel_dielectric(std::abs(side), eta);
    const auto reflected = sample_scattering(glass, surface_normal, out, 0.5 * reflectance, {});
    REQUIRE(reflected);
    CHECK(glm::length(reflected->direction + out - 2.0 * side * surface_normal) < 1e-15);
    CHECK(reflected->weight == dvec3(1.0));
    if (reflectance == 1.0) continue;  // beyond the critical angle
    const auto refracted = sample_scattering(glass, surface_normal, out, 0.5 * (1.0 + reflectance), {});
    REQUIRE(refracted);
    const dvec3 in = refracted->direction;
    CHECK(glm::dot(in, surface_normal) * side < 0.0);
    CHECK(glm::length(glm::cross(out, surface_normal) + eta * glm::cross(in, surface_normal)) < 1e-14);
    CHECK(refracted->weight.x == Approx(0.8 / (eta * eta)));
    CHECK(refracted->squeeze == Approx(1.0 / (eta * eta)));
    CHECK((refracted->specular && is_specular(glass)));
  }
}

}  // namespace
}  // namespace rondure
