// Rendering beside singular points, at every magnification: nothing is missed, nothing is noise.
#include <fmt/format.h>

#include "renderer/study/corner_normals.h"
#include "renderer/study/ray_trials.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

TEST_CASE("rays at singular points hit by every solver", "[study]") {
  // Where the surface ends there, a place nearer to the end than rounding may be passed by: at a corner of
  // 180 degrees, or at one where both tangents vanish, that is the square of the distance in the parameters.
  constexpr double rounded = 3e-8;
  int closed = 0, open = 0;
  WorstCase off;
  for (const Subject& subject : subjects()) {
    const CornerTables tables = measure_corners(turned(subject), StagedScene::builtins(), true);
    if (tables.walks.size() == 0) continue;
    const bool whole = surface_of(subject, StagedScene::builtins()).closed;
    (whole ? closed : open) += 1;
    for (const std::string solver : RayTrials::names) {
      int missed = 0;
      for (std::size_t k = 0; k < tables.walks.size(); ++k) {
        off.add(tables.walks.number(k, "off_" + solver), 1e-14,
                [&] { return subject.name + " by " + solver; });
        if (!whole && tables.walks.number(k, "distance") < rounded) continue;
        missed += tables.walks.at(k, "hits_" + solver) != tables.walks.at(k, "rays");
      }
      CAPTURE(subject.name, solver);
      CHECK(missed == 0);
    }
  }
  INFO(off.text());
  CHECK(off.failures() == 0);
  CHECK(closed >= 7);
  CHECK(open >= 6);
}

TEST_CASE("by default close-ups of singular points are right down to pixels of 1e-8 radii", "[study]") {
  const StudyFolder folder(fresh_folder("close_ups"));
  const StudyFolder parts(folder.path("parts"));
  StudyOptions options;
  options.quick = true;
  int pictures = 0;
  for (const char* family : {"hemispheres", "octants", "octahedron_pairs", "ellipsoid_hemispheres",
                             "one_sheet", "hemisphere_part"}) {
    const Subject subject = turned(subjects_named({family}).at(0));
    const CornerTables tables = measure_corners(subject, StagedScene::builtins(), true);
    REQUIRE(tables.sites.size() > 0);
    const CloseUps ups = take_close_ups(subject, StagedScene::builtins(), tables.sites, 0,
                                        tables.sites.at(0, "group"), folder, options);
    double single = 0.0;
    for (const CloseUp& picture : ups.pictures) {
      CAPTURE(family, picture.estimator, picture.pixel);
      CHECK(picture.missed == 0);
      CHECK(picture.rejected == 0);
      if (picture.estimator == "cross_float") single = std::max(single, picture.off);
      if (picture.estimator != "limit") continue;
      // Normals good to 1e-12 rad, in light at 89 degrees, which a radian changes by 57 times its value of
      // 0.5.
      CHECK(picture.off < 3e-11);
      ++pictures;
    }
    CHECK(single > 1e-3);
  }
  CHECK(pictures == 12);
}

}  // namespace
}  // namespace rondure
