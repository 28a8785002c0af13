// `rondure study`: its files, its page, its errors.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "renderer/study/page.h"
#include "renderer/study/table.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// The browser, where there is one; empty otherwise.
std::string chromium() {
  const char* path = std::getenv("PATH");
  std::string folder;
  for (const char c : std::string(path ? path : "") + ":") {
    if (c != ':') {
      folder += c;
      continue;
    }
    if (std::filesystem::exists(folder + "/chromium")) return folder + "/chromium";
    folder.clear();
  }
  return {};
}

TEST_CASE("a study of corners writes tables and a page that agree", "[study]") {
  const std::string folder = fresh_folder("study_corners");
  const std::vector<std::string> command = {
      "study", "corner-normals", "--families", "hemispheres,cube,octants", "--quick",
      "-o",    folder,           "--quiet"};
  const ProcessResult run = run_rondure(command);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.empty());
  const Table sites(read_text_file(folder + "/sites.csv")), walks(read_text_file(folder + "/walks.csv")),
      slopes(read_text_file(folder + "/slopes.csv"));
  CHECK(sites.size() ==
        2 * 4 + 8 * 3);  // corners of hemispheres; two ends and the middle of each octant's pole
  CHECK(walks.size() > 40);
  CHECK(slopes.size() == 3 * 7);
  const std::string page = read_text_file(folder + "/index.html");
  CHECK(has(page, "<code>rondure study corner-normals --families hemispheres,cube,octants --quick</code>"));
  CHECK(has(page, "<tr><td>cube</td><td>6</td><td>quadric</td><td>0</td><td>proved on 6 pieces</td></tr>"));
  // Every number of the slopes' tables, row by row, as the page writes numbers.
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    const double slope = slopes.number(k, "slope");
    const std::string row = fmt::format("<tr><td>{}</td><td>{}</td>", slopes.at(k, "estimator"),
                                        std::isnan(slope) ? "-" : fmt::format("{:.3f}", slope));
    const std::string tail =
        fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>", slopes.at(k, "places"),
                    number_text(slopes.number(k, "worst")), number_text(slopes.number(k, "at_1e-8")),
                    slopes.at(k, "none"), number_text(slopes.number(k, "radiance")));
    CAPTURE(row, tail);
    bool found = false;
    for (std::size_t at = page.find(row); at != std::string::npos && !found; at = page.find(row, at + 1))
      found = page.substr(at, page.find("</tr>", at) + 5 - at).ends_with(tail);
    CHECK(found);
  }
  // And the slopes are those of the walks.
  double worst = 0.0;
  for (std::size_t k = 0; k < walks.size(); ++k)
    if (walks.at(k, "family") == "hemispheres") worst = std::max(worst, walks.number(k, "error_cross"));
  CHECK(slopes.at(1, "estimator") == "cross");
  CHECK(slopes.number(1, "worst") == worst);
  // Where an estimator gives no normal there is no error either, not one of zero.
  int without = 0;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    bool any = false, close = false;
    for (std::size_t at = 0; at < walks.size(); ++at) {
      if (walks.at(at, "family") != slopes.at(k, "family") || walks.at(at, "group") != slopes.at(k, "group"))
        continue;
      if (walks.at(at, "error_" + slopes.at(k, "estimator")).empty()) continue;
      any = true;
      close = close || std::abs(std::log10(walks.number(at, "distance")) + 8.0) < 0.2;
    }
    CAPTURE(slopes.at(k, "family"), slopes.at(k, "group"), slopes.at(k, "estimator"));
    CHECK(slopes.at(k, "worst").empty() == !any);
    CHECK(slopes.at(k, "at_1e-8").empty() == !close);
    without += !close;
  }
  CHECK(without > 0);  // single precision beside a pole
  // Nothing from elsewhere, every picture inside: 3 groups, 7 estimators, 2 magnifications, shading and
  // error; a legend each.
  CHECK(count_of(page, "src=\"data:image/png;base64,") == 3 * (7 * 2 * 2 + 1));
  CHECK(count_of(page, "src=\"") == 3 * (7 * 2 * 2 + 1));
  CHECK(count_of(page, "<svg") == 3 * 3);
  CHECK_FALSE(has(page, ">nan"));

  // Taken up again it has the same bytes, from parts that are not made anew.
  const auto when = std::filesystem::last_write_time(folder + "/parts/hemispheres-walks.csv");
  REQUIRE(run_rondure(command).exit_code == 0);
  CHECK(read_text_file(folder + "/index.html") == page);
  CHECK(std::filesystem::last_write_time(folder + "/parts/hemispheres-walks.csv") == when);

  // A close-up's command makes that picture.
  const std::string scene = folder + "/hemispheres-0-1e-08.json";
  const ProcessResult close = run_rondure({"render", scene, "--normals", "cross_float", "--png",
                                           folder + "/c.png", "-o", folder + "/c.exr", "--quiet"});
  INFO(close.err);
  CHECK(close.exit_code == 0);
}

TEST_CASE("a scene's own objects are studied as families are", "[study]") {
  const std::string folder = fresh_folder("study_scene");
  write_text_file(folder + "/my scene's.json", R"({ "objects": [ { "type": "sphere" },
    { "type": "sphere_tiling", "topology": "hemispheres", "radius": 1e3, "center": [5e3, 0, 0], "name": "a, \"b\"",
      "transform": [ { "scale": [1, 2, 1] } ] },
    { "type": "bezier", "patches": [ { "kind": "triangle", "degree": 2, "net": { "200": [1, 0, -1, 1],
      "020": [-1, 0, -1, 1], "110": [0, 1, 0, 1], "101": [0, 0, 0, 1], "011": [0, 0, 0, 1], "002": [0, 0, 0, 1] } } ] } ] })");
  const ProcessResult run = run_rondure({"study", "corner-normals", "--scene", folder + "/my scene's.json",
                                         "--quick", "-o", folder + "/out", "--quiet"});
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Table sites(read_text_file(folder + "/out/sites.csv")),
      slopes(read_text_file(folder + "/out/slopes.csv"));
  REQUIRE(sites.size() == 8 + 1);
  CHECK(sites.at(0, "family") == "1_sphere_tiling");
  CHECK(sites.at(8, "family") == "2_bezier");
  CHECK(sites.at(8, "limit") == "0");
  CHECK(slopes.at(0, "estimator") == "limit");
  CHECK(slopes.number(0, "worst") < 1e-12);
  CHECK(slopes.number(1, "slope") == Approx(-1.0).margin(0.3));
  // The command is one that a shell reads as it was given.
  CHECK(has(read_text_file(folder + "/out/index.html"), "<code>rondure study corner-normals --scene '" +
                                                            folder + "/my scene'\\''s.json' --quick</code>"));
  // An object of thousands of units is looked at in its own.
  for (const char* pixel : {"1e-04", "1e-08"})
    CHECK(has(read_text_file(fmt::format("{}/out/parts/1_sphere_tiling-0-{}-limit.txt", folder, pixel)),
              " 0 0"));
  const ProcessResult both = run_rondure({"study", "corner-normals", "--scene", folder + "/my scene's.json",
                                          "--families", "cube", "-o", folder + "/x"});
  CHECK(both.err == "rondure: error: --scene takes the place of --families: give one of them\n");
  const ProcessResult other =
      run_rondure({"study", "precision", "--scene", folder + "/my scene's.json", "-o", folder + "/x"});
  CHECK(other.err ==
        "rondure: error: --scene is for the study corner-normals; the others compare whole spheres\n");
  write_text_file(folder + "/none.json", R"({ "objects": [ { "type": "sphere" } ] })");
  const ProcessResult none =
      run_rondure({"study", "corner-normals", "--scene", folder + "/none.json", "-o", folder + "/x"});
  CHECK(none.exit_code == 1);
  CHECK(has(none.err, "none.json: no object has patches to study"));
  CHECK_FALSE(std::filesystem::exists(folder + "/x"));
}

TEST_CASE("the page opens in a browser without complaints", "[study]") {
  const std::string browser = chromium();
  if (browser.empty()) {
    WARN("chromium is not installed; .ci/run installs it");
    return;
  }
  const std::string folder = fresh_folder("study_browser");
  REQUIRE(
      run_rondure({"study", "corner-normals", "--families", "octants", "--quick", "-o", folder, "--quiet"})
          .exit_code == 0);
  // What the browser makes of the page, after a script of ours has looked at every picture.
  std::string page = read_text_file(folder + "/index.html");
  page.replace(page.find("</body>"), 7,
               "<script>let bad = 0; for (const i of document.images) bad += i.naturalWidth === (i.alt === "
               "'legend' ? 384 : 96) ? 0 : 1;"
               "for (const s of document.querySelectorAll('svg')) bad += s.getBoundingClientRect().width > "
               "300 ? 0 : 1;"
               "document.title = document.images.length + ' pictures, ' + bad + ' bad';</script></body>");
  write_text_file(folder + "/probe.html", page);
  const ProcessResult run = run_process({browser, "--headless", "--no-sandbox", "--disable-gpu",
                                         "--user-data-dir=" + folder + "/profile", "--dump-dom",
                                         "file://" + folder + "/probe.html"});
  CHECK(run.exit_code == 0);
  CHECK(has(run.out, "<title>58 pictures, 0 bad</title>"));
}

TEST_CASE("studies refuse what they do not know", "[study]") {
  const ProcessResult name = run_rondure({"study", "corner-normal"});
  CHECK(name.exit_code == 1);
  CHECK(name.err == "rondure: error: unknown study \"corner-normal\"; did you mean \"corner-normals\"?\n");
  const std::string folder = fresh_folder("study_errors");
  const ProcessResult family =
      run_rondure({"study", "corner-normals", "--families", "hemisphere", "-o", folder + "/a", "--quiet"});
  CHECK(family.exit_code == 1);
  CHECK(family.err == "rondure: error: unknown family \"hemisphere\"; did you mean \"hemispheres\"?\n");
  const ProcessResult open = run_rondure(
      {"study", "parametrisation", "--families", "hemispheres,cone_side", "-o", folder + "/a", "--quiet"});
  CHECK(open.exit_code == 1);
  CHECK(has(open.err,
            "rondure: error: family \"cone_side\" is not the whole unit sphere, which this study compares "
            "with; these are: \"hemispheres\", "));
  ProcessOptions nowhere;
  nowhere.environment["PATH"] = folder;
  const ProcessResult plots =
      run_rondure({"study", "precision", "--quick", "-o", folder + "/a", "--quiet"}, nowhere);
  CHECK(plots.exit_code == 1);
  CHECK(plots.err ==
        "rondure: error: gnuplot is not to be found; the study plots with it (Debian's gnuplot-nox)\n");
  write_text_file(folder + "/file", "");
  CHECK(run_rondure({"study", "parametrisation", "--quick", "-o", folder + "/file", "--quiet"}).exit_code ==
        1);
  CHECK_FALSE(std::filesystem::exists(folder + "/a"));
}

TEST_CASE("the sphere is the same from every parametrisation", "[study]") {
  const std::string folder = fresh_folder("study_parametrisation");
  const ProcessResult run = run_rondure({"study", "parametrisation", "--families", "hemispheres,octants,cube",
                                         "--quick", "-o", folder, "--quiet"});
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Table table(read_text_file(folder + "/parametrisation.csv"));
  REQUIRE(table.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    // As the README's accuracy section has it for path-traced scenes.
    CHECK(table.number(k, "rmse") < 1e-12);
    CHECK(table.number(k, "normal") < 1e-12);
    CHECK(table.number(k, "point") < 1e-13);
    CHECK(table.number(k, "missed") == 0);
    // Not the sphere itself, in closed form.
    CHECK(table.number(k, "normal") > 0.0);
    CHECK(table.number(k, "rmse") != table.number((k + 1) % 3, "rmse"));
  }
  const std::string page = read_text_file(folder + "/index.html");
  for (std::size_t k = 0; k < 3; ++k) {
    std::string row =
        fmt::format("<tr><td>{}</td><td>{}</td>", table.at(k, "family"), table.at(k, "patches"));
    for (const char* column : {"rmse", "color", "normal", "point"})
      row += fmt::format("<td>{}</td>", number_text(table.number(k, column)));
    CHECK(has(page, row + fmt::format("<td>{}</td></tr>", table.at(k, "missed"))));
  }
  CHECK(count_of(page, "src=\"data:image/png;base64,") == 2 * 3);
  // Taken up again: one part is missing, the rest is not made anew.
  const auto when = std::filesystem::last_write_time(folder + "/parts/cube.png");
  std::filesystem::remove(folder + "/parts/octants-map.png");
  REQUIRE(run_rondure({"study", "parametrisation", "--families", "hemispheres,octants,cube", "--quick", "-o",
                       folder, "--quiet"})
              .exit_code == 0);
  CHECK(read_text_file(folder + "/index.html") == page);
  CHECK(std::filesystem::last_write_time(folder + "/parts/cube.png") == when);
}

TEST_CASE("double precision does not depend on scale, single precision does", "[study]") {
  const std::string folder = fresh_folder("study_precision");
  const ProcessResult run =
      run_rondure({"study", "precision", "--families", "cube", "--quick", "-o", folder, "--quiet"});
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Table table(read_text_file(folder + "/precision.csv"));
  REQUIRE(table.size() == 3 * 4);
  for (std::size_t k = 0; k < table.size(); ++k) {
    CHECK(table.at(k, "double_hits") == table.at(k, "rays"));
    CHECK(table.number(k, "double_sphere") < 1e-15);
    CHECK(table.number(k, "double_normal") < 1e-12);
    // A float's share of the distance, at least.
    const double share = table.number(k, "distance") / table.number(k, "radius") * 0x1p-24;
    if (share > 1e-6 && table.number(k, "float_hits") > 0)
      CHECK(table.number(k, "float_sphere") > 0.05 * share);
    // About the origin it is a float's rounding, at every scale.
    if (share == 0.0) {
      CHECK(table.at(k, "float_hits") == table.at(k, "rays"));
      CHECK(table.number(k, "float_sphere") < 16 * 0x1p-24);
      CHECK(table.number(k, "float_ray") < 16 * 0x1p-24);
    }
  }
  const std::string page = read_text_file(folder + "/index.html");
  for (std::size_t k = 0; k < table.size(); ++k) {
    std::string row =
        fmt::format("<tr><td>cube</td><td>{}</td><td>{}</td><td>64</td>",
                    number_text(table.number(k, "radius")), number_text(table.number(k, "distance")));
    for (const std::string kind : {"float_", "double_"}) {
      row += fmt::format("<td>{}</td>", table.at(k, kind + "hits"));
      for (const char* what : {"sphere", "ray", "normal"})
        row += fmt::format("<td>{}</td>", number_text(table.number(k, kind + what)));
    }
    CHECK(has(page, row + "</tr>"));
  }
  CHECK(count_of(page, "<svg") == 2);
  // Taken up again from what is there.
  const auto when = std::filesystem::last_write_time(folder + "/parts/cube-1e+00.csv");
  REQUIRE(run_rondure({"study", "precision", "--families", "cube", "--quick", "-o", folder, "--quiet"})
              .exit_code == 0);
  CHECK(read_text_file(folder + "/index.html") == page);
  CHECK(std::filesystem::last_write_time(folder + "/parts/cube-1e+00.csv") == when);
}

}  // namespace
}  // namespace rondure
