// The study of normals at singular points: what `rondure study corner-normals` does.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/registry.h"
#include "renderer/study/study_options.h"
#include "renderer/study/subjects.h"
#include "renderer/study/table.h"

namespace rondure {

// Tables of one subject, angles in radians. `families`: family, patches, solver (the default), sites,
// undecided, pieces: on how many patches the search for singular points was given up, and what it took.
// `sites`: family, site, group, patch, u, v, x, y, z, place, kind, order, side_order, limit, spread, nx, ny,
// nz (the limit), ax, ay, az (along one way in), proof, within. `walks`: family, site, group, way, distance,
// u, v, sine, condition, smallest, reference, error_E and radiance_E for every estimator E, rays, hits_S,
// off_S, steps_S, undecided_S and cells_S for every solver S of renderer/study/ray_trials.h.
struct CornerTables {
  Table families, sites, walks;
};
CornerTables measure_corners(const Subject& subject, const Registry& registry, bool quick);

// family, group, estimator, slope, low, high, places, worst, at_1e-8, none, radiance: what the walks of one
// group (sites of one kind in one place of a family) come to.
Table corner_slopes(const Table& walks);

// A close-up of one site by one estimator.
struct CloseUp {
  std::string estimator;
  double pixel = 0.0;         // size, in radii
  std::string shaded, error;  // PNG
  double off = 0.0;           // largest difference of the shading from that by the reference
  // Pixels that the default solver or clipping hits alone, and samples that are not numbers.
  long missed = 0, rejected = 0;
};
struct CloseUps {
  std::string family, group;
  std::string reference;                      // what the shading is compared with: "analytic" or "limit"
  std::vector<CloseUp> pictures;              // estimator by estimator, magnification by magnification
  std::string shaded_command, error_command;  // that make the first of them
  std::string legend;                         // PNG, of the errors' colours
};
// `done` is called after each picture, and may throw.
CloseUps take_close_ups(
    const Subject& subject, const Registry& registry, const Table& sites, std::size_t row,
    const std::string& group, const StudyFolder& folder, const StudyOptions& options,
    const std::function<void()>& done = [] {});
std::size_t close_ups_a_site(const StudyOptions& options);

// Which singular points there are, and how that is known: a part of the page.
std::string sites_section(const Table& families, const Table& sites);

std::string corner_page(const CornerTables& tables, const Table& slopes,
                        const std::vector<CloseUps>& close_ups, const StudyFolder& folder,
                        const StudyOptions& options);

// Writes families.csv, sites.csv, walks.csv, slopes.csv, the plots and index.html, and what the page's
// pictures are of. Interrupted and started again it goes on where it was. Throws std::runtime_error for what
// is missing or cannot be written.
void study_corner_normals(const StudyOptions& options, const Registry& registry);

}  // namespace rondure
