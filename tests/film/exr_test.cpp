#include "renderer/film/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "renderer/api/version.h"
#include "renderer/film/atomic_file.h"
#include "renderer/sampling/sampler.h"
#include "tests/catch.h"
#include "tests/process.h"

namespace rondure {
namespace {

// Three samples a pixel of arbitrary numbers.
Film make_film() {
  Film film(7, 5, {2, 1, 6, 4});
  film.samples = 3;
  film.rest.resize(film.whole.size());
  for (int y = 1; y < 4; ++y) {
    for (int x = 2; x < 6; ++x) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        Sampler s(1, x, y, i);
        FilmSample sample;
        for (dvec3* v : {&sample.color, &sample.normal, &sample.albedo}) {
          for (int c = 0; c < 3; ++c) (*v)[c] = s.next_1d();
        }
        sample.alpha = i == 0 ? 1.0 : 0.0;
        film.rest[film.index(x, y)].add(sample);
      }
      film.geometry[film.index(x, y)] = {
          {x + 0.25, y + 0.5, -1.0}, 10.0 + x, {0.125 * x, 0.25}, 10 * x + y, x % 3 - 1};
    }
  }
  return film;
}

ExrHeader make_header() {
  ExrHeader header{0x0123456789abcdefu, 18446744073709551615u, "path", "newton", default_camera()};
  return header;
}

std::map<std::string, std::vector<float>> read_channels(Imf::InputFile& file) {
  const Imath::Box2i window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  std::map<std::string, std::vector<float>> result;
  Imf::FrameBuffer buffer;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
    CHECK(c.channel().type == Imf::FLOAT);
    std::vector<float>& values = result[c.name()];
    values.resize(static_cast<std::size_t>(width * height));
    buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return result;
}

TEST_CASE("the EXR holds the film's layers in its window", "[film]") {
  const std::string path = fresh_folder("exr_layers") + "/a.exr";
  const Film film = make_film();
  write_exr(path, film, make_header());
  Imf::InputFile file(path.c_str());
  CHECK(file.header().dataWindow() == Imath::Box2i({2, 1}, {5, 3}));
  CHECK(file.header().displayWindow() == Imath::Box2i({0, 0}, {6, 4}));
  auto channels = read_channels(file);
  CHECK(channels.size() == 21);
  int failures = 0, compared = 0;
  for (int y = 1; y < 4; ++y) {
    for (int x = 2; x < 6; ++x) {
      const std::size_t i = film.index(x, y);
      const auto same = [&](const std::string& name, double value) {
        ++compared;
        failures += channels.at(name).at(i) != static_cast<float>(value);
      };
      // The means and the variance of the mean, by their definitions, from the samples themselves.
      double color[3][3], mean = 0.0, variance = 0.0, albedo_b = 0.0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        Sampler s(1, x, y, k);
        for (double& c : color[k]) c = s.next_1d();
        mean += color[k][0] / 3;
        for (int skip = 0; skip < 5; ++skip) s.next_1d();
        albedo_b += s.next_1d() / 3;
      }
      for (const auto& c : color) variance += (c[0] - mean) * (c[0] - mean) / 2 / 3;
      // Doubles summed in another order, then rounded to floats: one float ulp.
      failures += std::abs(channels.at("R").at(i) - mean) > 1.2e-7;
      failures += std::abs(channels.at("Albedo.B").at(i) - albedo_b) > 1.2e-7;
      failures += std::abs(channels.at("Variance.R").at(i) - variance) > 1.2e-7;
      same("G", film.mean(x, y).color.y);
      same("B", film.mean(x, y).color.z);
      same("A", 1.0 / 3.0);
      same("N.X", film.mean(x, y).normal.x);
      same("N.Z", film.mean(x, y).normal.z);
      same("Albedo.R", film.mean(x, y).albedo.x);
      same("P.X", x + 0.25);
      same("P.Y", y + 0.5);
      same("P.Z", -1.0);
      same("Depth.Z", 10.0 + x);
      same("UV.U", 0.125 * x);
      same("UV.V", 0.25);
      same("Patch.id", 10 * x + y);
      same("Patch.surface", x % 3 - 1);
      same("Variance.G", film.variance(x, y).y);
      same("Variance.B", film.variance(x, y).z);
    }
  }
  CHECK(compared == 12 * 16);
  CHECK(failures == 0);
}

TEST_CASE("a variance beyond a float is written as the largest", "[film]") {
  const std::string path = fresh_folder("exr_variance") + "/a.exr";
  Film film = make_film();
  FilmSample bright;
  bright.color = dvec3(3e38, 0.0, 0.0);
  film.rest[0].add(bright);
  write_exr(path, film, make_header());
  Imf::InputFile file(path.c_str());
  auto channels = read_channels(file);
  CHECK(channels.at("Variance.R")[0] == std::numeric_limits<float>::max());
  CHECK(channels.at("R")[0] == Approx(1e38).epsilon(1e-6));
  CHECK(channels.at("Variance.G")[0] < 1.0f);
}

TEST_CASE("a place beyond a float is written as the largest", "[film]") {
  const std::string path = fresh_folder("exr_far") + "/a.exr";
  Film film = make_film();
  film.geometry[0].point = {1e50, -1e50, 1.0}, film.geometry[0].depth = 1e50;
  ExrHeader header = make_header();
  header.camera.origin = {1e60, -4.0, 1.0};
  write_exr(path, film, header);
  Imf::InputFile file(path.c_str());
  auto channels = read_channels(file);
  constexpr float most = std::numeric_limits<float>::max();
  CHECK(channels.at("P.X")[0] == most);
  CHECK(channels.at("P.Y")[0] == -most);
  CHECK(channels.at("Depth.Z")[0] == most);
  long infinite = 0;
  for (const Imath::M44f& m : {Imf::worldToCamera(file.header()), Imf::worldToNDC(file.header())})
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) infinite += !std::isfinite(m[i][j]);
  CHECK(infinite == 0);
}

TEST_CASE("the EXR's header tells what was rendered", "[film]") {
  const std::string path = fresh_folder("exr_header") + "/a.exr";
  write_exr(path, make_film(), make_header());
  Imf::InputFile file(path.c_str());
  const Imf::Header& h = file.header();
  const auto text = [&](const char* name) { return h.typedAttribute<Imf::StringAttribute>(name).value(); };
  CHECK(text("rondure:scene_hash") == "0123456789abcdef");
  CHECK(text("rondure:seed") == "18446744073709551615");
  CHECK(text("rondure:integrator") == "path");
  CHECK(text("rondure:solver") == "newton");
  CHECK(text("software") == std::string("rondure ") + version);
  CHECK(h.typedAttribute<Imf::IntAttribute>("rondure:samples_per_pixel").value() == 3);
  CHECK(Imf::hasChromaticities(h));
  // Neither the day nor the machine: what is here is all.
  int attributes = 0;
  for (auto a = h.begin(); a != h.end(); ++a) ++attributes;
  CHECK(attributes == 8 + 9);  // OpenEXR's required eight, and those above with the two matrices

  // A point one unit ahead, two up and three to the right of the default camera.
  const Camera camera = default_camera();
  const dvec3 p = camera.origin + camera.forward + 2.0 * camera.up + 3.0 * camera.right;
  Imath::V3f in_camera, in_ndc;
  const Imath::V3f point(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  Imf::worldToCamera(h).multVecMatrix(point, in_camera);
  Imf::worldToNDC(h).multVecMatrix(point, in_ndc);
  CHECK((in_camera - Imath::V3f(3, 2, -1)).length() < 1e-5f);  // some float ulps of 5
  const double half = std::tan(17.5 * 3.14159265358979 / 180);
  CHECK(in_ndc.y == Approx(2.0 / half).epsilon(1e-5));
  CHECK(in_ndc.x == Approx(3.0 / half / 1.4).epsilon(1e-5));  // the picture is 7 x 5

  CHECK(h.pixelAspectRatio() == 1.0f);
  CHECK(h.screenWindowCenter() == Imath::V2f(0.0f));
  CHECK(h.screenWindowWidth() == Approx(2.0 * half * 1.4).epsilon(1e-6));
}

TEST_CASE("the screen window of an orthographic camera is what it sees", "[film]") {
  const std::string path = fresh_folder("exr_screen") + "/a.exr";
  ExrHeader header = make_header();
  for (const auto& [height, width] : {std::pair(2.5, 3.5), std::pair(1e60, 3.4028234663852886e38)}) {
    header.camera = look_at(Projection::orthographic, {0, -4, 1}, {0, 0, 0}, {0, 0, 1});
    header.camera.extent = height;
    write_exr(path, make_film(), header);
    CHECK(Imf::InputFile(path.c_str()).header().screenWindowWidth() == static_cast<float>(width));
  }
}

TEST_CASE("equal films are equal files, and old files give way whole", "[film]") {
  const std::string folder = fresh_folder("exr_bytes");
  write_text_file(folder + "/a.exr", "an old file");
  write_exr(folder + "/a.exr", make_film(), make_header());
  write_exr(folder + "/b.exr", make_film(), make_header());
  CHECK(read_text_file(folder + "/a.exr") == read_text_file(folder + "/b.exr"));
  CHECK(read_text_file(folder + "/a.exr").size() > 500);
  // Nothing else is left in the folder.
  CHECK(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()) ==
        2);
}

TEST_CASE("a name that cannot be written is refused, and nothing is left", "[film]") {
  const std::string folder = fresh_folder("exr_refused");
  CHECK_THROWS_WITH(check_writable(folder + "/no/a.exr"),
                    folder + "/no/a.exr: cannot write: No such file or directory");
  CHECK_THROWS_WITH(check_writable(folder), folder + ": cannot write: Is a directory");
  CHECK_THROWS_WITH(write_exr(folder + "/no/a.exr", make_film(), make_header()),
                    Catch::Contains("/no/a.exr: cannot write"));
  CHECK_THROWS_WITH(check_writable("/dev/null"), "/dev/null: cannot write: not a regular file");
  check_writable(folder + "/a.exr");
  {
    AtomicFile abandoned(folder + "/a.exr");
    CHECK(std::filesystem::exists(abandoned.temporary()));
  }
  CHECK(std::filesystem::is_empty(folder));

  // Through a link, the file that it leads to is replaced.
  write_text_file(folder + "/file", "old");
  std::filesystem::create_symlink("file", folder + "/link");
  AtomicFile through(folder + "/link");
  write_text_file(through.temporary(), "new");
  through.commit();
  CHECK(std::filesystem::is_symlink(folder + "/link"));
  CHECK(read_text_file(folder + "/file") == "new");
}

}  // namespace
}  // namespace rondure
