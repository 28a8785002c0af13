#include "renderer/shading/environment.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/film/exr.h"
#include "renderer/film/film.h"
#include "renderer/sampling/sampler.h"
#include "renderer/sampling/warps.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using std::numbers::pi;

// Black but for one texel of radiance (1, 2, 3).
Image spot(int width, int height, int x, int y) {
  Image image{width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), 0.0f)};
  for (int c = 0; c < 3; ++c) image.rgb[static_cast<std::size_t>(3 * (y * width + x) + c)] = float(c + 1);
  return image;
}

Image noise(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    image.rgb.push_back(float(std::pow(Sampler(1, i, 0, 0).next_1d(), 4)));
  return image;
}

TEST_CASE("an environment's image lies as documented", "[shading]") {
  // Centres of texels of an 8 x 4 image: column c at 180 - 45 (c + 1/2) degrees, row r at 45 (r + 1/2) from
  // the zenith.
  WorstCase worst;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double phi = (180.0 - 45.0 * (x + 0.5)) * pi / 180.0, theta = 45.0 * (y + 0.5) * pi / 180.0;
      const dvec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const dvec3 radiance = Environment(spot(8, 4, x, y)).radiance(d);
      // Half a texel is pi / 8; arc functions of rounded directions are good to 1e-15 over that.
      worst.add(glm::length(radiance - dvec3(1, 2, 3)), 1e-13,
                [&] { return fmt::format("texel {}, {}", x, y); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  // Just right of the centre column, toward x, is -y; the top is +z.
  CHECK(Environment(spot(8, 4, 4, 2)).radiance(glm::normalize(dvec3(1, -0.4, -0.4))).x > 0.0);
  CHECK(Environment(spot(8, 4, 4, 0)).radiance({0, 0, 1}).x > 0.0);
}

TEST_CASE("environment samples have the density that they say", "[shading]") {
  for (const Image& image : {noise(16, 8), spot(16, 8, 3, 0), spot(16, 8, 15, 4)}) {
    const Environment environment(image);
    // The density integrates to 1, by midpoints on a finer grid that shares the texels' edges.
    constexpr int w = 16 * 20, h = 8 * 20;
    double integral = 0.0;
    int unlit = 0;
    for (int y = 0; y < h; ++y) {
      const double theta = pi * (y + 0.5) / h;
      for (int x = 0; x < w; ++x) {
        const double phi = 2.0 * pi * (x + 0.5) / w;
        const dvec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        integral += environment.pdf(d) * std::sin(theta) * 2.0 * pi * pi / (w * h);
        unlit += environment.pdf(d) == 0.0 && environment.radiance(d).x > 0.0;
      }
    }
    CHECK(integral == Approx(1.0).epsilon(1e-10));
    CHECK(unlit == 0);  // where there is light there are samples

    WorstCase worst;
    double light = 0.0, squares = 0.0, reference = 0.0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      Sampler sampler(2, i, 0, 0);
      const Environment::Sample s = environment.sample(sampler.next_2d());
      const auto describe = [&] { return std::to_string(i); };
      worst.add(std::abs(glm::length(s.direction) - 1.0), 1e-14, describe);
      // Directions on the edge of two texels may fall either way: none among so few.
      worst.add(std::abs(environment.pdf(s.direction) / s.pdf - 1.0), 1e-10, describe);
      const double value = environment.radiance(s.direction).x / s.pdf;
      light += value / n;
      squares += value * value / n;
    }
    INFO(worst.text());
    CHECK(worst.failures() == 0);
    for (int y = 0; y < 800; ++y) {  // the total flux, by another rule: uniform in z
      for (int x = 0; x < 400; ++x) {
        reference +=
            environment.radiance(sample_sphere({(y + 0.5) / 800, (x + 0.5) / 400})).x * 4 * pi / 320000.0;
      }
    }
    const double error = std::sqrt((squares - light * light) / n);
    INFO("light " << light << " +- " << error << ", wanted " << reference);
    CHECK(std::abs(light - reference) <
          5.0 * error + 1e-3 * reference);  // midpoints: a thousandth near the poles
    CHECK(error < 0.02 * light);
  }
}

TEST_CASE("an environment file reaches the world, scaled and turned", "[shading]") {
  // 255 is 1 in sRGB; 188 is 0.5 to half a step (0.5029).
  const std::string file = scratch_folder() + "/environment.png";
  std::vector<unsigned char> rgb(3 * 8 * 4, 0);
  for (int y = 0; y < 4; ++y) {
    rgb[static_cast<std::size_t>(3 * (y * 8 + 3))] = 255;  // two columns about +x
    rgb[static_cast<std::size_t>(3 * (y * 8 + 4))] = 255;
    rgb[static_cast<std::size_t>(3 * (y * 8 + 4) + 1)] = 188;
    rgb[static_cast<std::size_t>(3 * (y * 8 + 3) + 1)] = 188;
  }
  write_png(file, 8, 4, rgb);
  const Image image = read_image(file);
  CHECK((image.width == 8 && image.height == 4));
  CHECK(image.at(3, 1).x == 1.0);
  CHECK(image.at(4, 2).y == Approx(0.5029).epsilon(1e-3));
  CHECK(image.at(5, 2) == dvec3(0.0));

  const auto stage = [&](const char* rotate) {
    return StagedScene(fmt::format(
        R"({{ "lights": [ {{ "type": "environment", "file": "{}", "scale": 3, "rotate": {} }} ],
           "objects": [ {{ "type": "sphere" }} ] }})",
        file, rotate));
  };
  const StagedScene plain = stage("0"), turned = stage("90"), tipped = stage("[0, -90, 0]");
  CHECK(plain.world.background({1, 0, 0}).x == Approx(3.0));
  CHECK(plain.world.background({0, 1, 0}).x == 0.0);
  CHECK(turned.world.background({0, 1, 0}).x == Approx(3.0));  // about z, right-handed: x goes to y
  CHECK(tipped.world.background({0, 0, 1}).x == Approx(3.0));  // about y by -90: x goes to z
  // Whole turns count for nothing: the double 1e308 is -64 (mod 360), by integers.
  const StagedScene many = stage("1e308"), rest = stage("-64");
  for (const dvec3& d : {dvec3(1, 0, 0), dvec3(0.6, 0.8, 0), dvec3(0.44, -0.9, 0)})
    CHECK(many.world.background(d) == rest.world.background(d));
  WorstCase worst;
  for (int i = 0; i < 2000; ++i) {
    Sampler sampler(2, i, 0, 0);
    const LightSample l = tipped.world.sample_light({0, 0, 0}, 0.5, sampler.next_2d());
    const auto describe = [&] { return std::to_string(i); };
    worst.add(std::abs(tipped.world.background_pdf(l.direction) / l.pdf - 1.0), 1e-10, describe);
    worst.add(glm::length(tipped.world.background(l.direction) - l.radiance), 1e-12, describe);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("an EXR's pixels lie in their place in the whole picture", "[shading]") {
  const std::string file = scratch_folder() + "/part.exr";
  Film film(8, 4, {3, 1, 6, 3});
  film.samples = 1;
  for (int y = 1; y < 3; ++y) {
    for (int x = 3; x < 6; ++x) {
      FilmSample sample;
      sample.color = dvec3(x, y, 0.5);
      film.whole[film.index(x, y)].add(sample);
    }
  }
  write_exr(file, film, {0, 0, "path", "newton", default_camera()});
  const Image image = read_image(file);
  REQUIRE((image.width == 8 && image.height == 4));
  int failures = 0;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool inside = x >= 3 && x < 6 && y >= 1 && y < 3;
      failures += image.at(x, y) != (inside ? dvec3(x, y, 0.5) : dvec3(0.0));
    }
  }
  CHECK(failures == 0);
}

TEST_CASE("image files that cannot be read are named", "[shading]") {
  CHECK_THROWS_WITH(read_image("/nowhere/sky.hdr"),
                    Catch::Contains("/nowhere/sky.hdr: cannot read the image: "));
  CHECK_THROWS_WITH(
      StagedScene(R"({ "lights": [ { "type": "environment", "file": "sky.hdr" } ],
                                     "objects": [ { "type": "sphere" } ] })"),
      Catch::Contains("test.json:1:48: ") && Catch::Contains("no such file: ") && Catch::Contains("sky.hdr"));
}

}  // namespace
}  // namespace rondure
