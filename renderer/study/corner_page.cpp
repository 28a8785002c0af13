#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "renderer/normals/estimator.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/gnuplot.h"
#include "renderer/study/page.h"
#include "renderer/study/ray_trials.h"

namespace rondure {
namespace {

// The rows of one group of the walks, and the largest value of a column at each distance.
struct Group {
  std::string family, name;
  std::vector<std::size_t> rows;

  std::string stem() const {
    std::string out = family + "-" + name;
    std::erase_if(out, [](char c) { return c == '(' || c == ')'; });
    std::replace(out.begin(), out.end(), ' ', '-');
    return out;
  }
};

std::vector<Group> groups_of(const Table& walks) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < walks.size(); ++k) {
    const std::string &family = walks.at(k, "family"), &name = walks.at(k, "group");
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.family == family && g.name == name; });
    if (found == groups.end()) found = groups.insert(groups.end(), Group{family, name, {}});
    found->rows.push_back(k);
  }
  return groups;
}

// Over all walks of a group, decade by half decade; `least` instead of the largest.
Curve envelope(const Table& walks, const Group& group, const std::string& column, const std::string& name,
               bool least = false) {
  std::map<long, double> at;
  for (const std::size_t row : group.rows) {
    const double value = walks.number(row, column);
    if (std::isnan(value)) continue;
    const long place = std::lround(2.0 * std::log10(walks.number(row, "distance")));
    const auto [known, fresh] = at.emplace(place, value);
    if (!fresh) known->second = least ? std::min(known->second, value) : std::max(known->second, value);
  }
  Curve curve{name, {}, {}};
  for (const auto& [place, value] : at) {
    curve.x.push_back(std::pow(10.0, 0.5 * static_cast<double>(place)));
    curve.y.push_back(value);
  }
  return curve;
}

std::string slopes_table(const Table& slopes, const Group& group) {
  std::vector<std::vector<std::string>> rows = {
      {"normals", "slope of log error over log distance", "fitted over", "places", "worst error (rad)",
       "error at 10<sup>-8</sup> (rad)", "places without a normal", "worst radiance error"}};
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    if (slopes.at(k, "family") != group.family || slopes.at(k, "group") != group.name) continue;
    const double slope = slopes.number(k, "slope");
    rows.push_back({slopes.at(k, "estimator"), std::isnan(slope) ? "-" : fmt::format("{:.3f}", slope),
                    std::isnan(slope) ? "-"
                                      : fmt::format("{} to {}", number_text(slopes.number(k, "low"), 2),
                                                    number_text(slopes.number(k, "high"), 2)),
                    slopes.at(k, "places"), number_text(slopes.number(k, "worst")),
                    number_text(slopes.number(k, "at_1e-8")), slopes.at(k, "none"),
                    number_text(slopes.number(k, "radiance"))});
  }
  return html_table(rows);
}

// What rays at the places of the walks came to, solver by solver.
std::string solvers_table(const Table& walks, const Group& group) {
  std::vector<std::vector<std::string>> rows = {{"solver", "rays", "hits", "furthest off (extents)",
                                                 "Newton steps a ray", "leaves left to clipping, a ray",
                                                 "cells of clipping a ray", "most at one place"}};
  for (const std::string solver : RayTrials::names) {
    double rays = 0, hits = 0, off = 0, steps = 0, undecided = 0, cells = 0, most_cells = 0;
    for (const std::size_t row : group.rows) {
      rays += walks.number(row, "rays");
      hits += walks.number(row, "hits_" + solver);
      off = std::max(off, walks.number(row, "off_" + solver));
      steps += walks.number(row, "steps_" + solver);
      undecided += walks.number(row, "undecided_" + solver);
      cells += walks.number(row, "cells_" + solver);
      most_cells = std::max(most_cells, walks.number(row, "cells_" + solver));
    }
    rows.push_back({solver, fmt::format("{}", rays), fmt::format("{}", hits), number_text(off),
                    number_text(steps / rays), number_text(undecided / rays), number_text(cells / rays),
                    fmt::format("{}", most_cells)});
  }
  return html_table(rows);
}

std::string made_by(const std::string& plot) {
  return fmt::format("Made by <code>gnuplot {}.gp</code>.", plot);
}

std::string plots(const Table& walks, const Group& group, const StudyFolder& folder) {
  Plot errors{
      group.family + ": " + group.name, "distance in the parameters", "error of the normal (rad)", {}};
  Plot radiance{group.family + ": " + group.name, "distance in the parameters", "error of the radiance", {}};
  for (const std::string& name : estimator_names()) {
    errors.curves.push_back(envelope(walks, group, "error_" + name, name));
    radiance.curves.push_back(envelope(walks, group, "radiance_" + name, name));
  }
  Plot conditioning{group.family + ": " + group.name, "distance in the parameters", "conditioning, work", {}};
  conditioning.curves = {envelope(walks, group, "sine", "least |Su x Sv| / (|Su| |Sv|)", true),
                         envelope(walks, group, "smallest", "least singular value", true),
                         envelope(walks, group, "condition", "largest condition"),
                         envelope(walks, group, "cells_newton", "most cells of clipping"),
                         envelope(walks, group, "steps_newton", "most Newton steps")};
  const std::string stem = group.stem(), to = walks.at(group.rows.front(), "reference");
  std::string out;
  out += html_figure(
      plot_svg(folder, stem + "-error", errors),
      fmt::format("Angle to the {} normal, radians: the largest over all walks. Zeros are not drawn. {}", to,
                  made_by(stem + "-error")));
  out += html_figure(
      plot_svg(folder, stem + "-radiance", radiance),
      "Difference of max(0, n&middot;l) for light at 60&deg; to the true normal, of which it is 0.5. " +
          made_by(stem + "-radiance"));
  out += html_figure(plot_svg(folder, stem + "-conditioning", conditioning),
                     "Conditioning of the Jacobian (Su Sv), and what two rays at each place cost the solver "
                     "<code>newton</code>. " +
                         made_by(stem + "-conditioning"));
  return out;
}

std::string close_up_section(const CloseUps& ups) {
  std::vector<std::string> head = {"normals"};
  for (const CloseUp& p : ups.pictures)
    if (p.estimator == ups.pictures.front().estimator)
      head.push_back(fmt::format("pixel = {:.0e} radii", p.pixel));
  std::vector<std::vector<std::string>> rows = {head};
  for (const CloseUp& p : ups.pictures) {
    if (rows.back().front() != p.estimator || rows.size() == 1) rows.push_back({p.estimator});
    rows.back().push_back(fmt::format("<div class=\"pair\">{}{}</div>off by {}<br>{} missed, {} rejected",
                                      html_picture(p.shaded, p.estimator + ", shaded"),
                                      html_picture(p.error, p.estimator + ", error"), number_text(p.off),
                                      p.missed, p.rejected));
  }
  return html_figure(
      html_table(rows) + html_picture(ups.legend, "legend"),
      fmt::format(
          "Close-ups of the first of these points, straight down, hits by the default solver, in light at "
          "89&deg; "
          "to the normal: left the shading, of which the true value is 0.5 (linear), 4 samples a pixel; "
          "right "
          "the angle to the {} normal, one sample a pixel, on a logarithmic scale. Black is where a ray "
          "passes "
          "by the surface, or nothing is lit. Seed 1. Off by: the largest difference of a pixel from the "
          "shading by the {} normal. Missed: pixels that the default solver or <code>clipping</code> hits "
          "alone. Rejected: samples that are no numbers. The first by <code>{}</code> and <code>{}</code>, "
          "those of other scenes and normals alike.",
          ups.reference, ups.reference, html_escaped(ups.shaded_command), html_escaped(ups.error_command)));
}

}  // namespace

std::string corner_page(const CornerTables& tables, const Table& slopes,
                        const std::vector<CloseUps>& close_ups, const StudyFolder& folder,
                        const StudyOptions& options) {
  const Table& walks = tables.walks;
  std::string body =
      "<p>What degenerate parametrisations do to normals. At each singular point the program walks in along "
      "straight "
      "lines of the parameters and compares what the estimators give with the gradient of the quadric that "
      "the patch "
      "lies on, or where there is none with the limit normal. All numbers are in <code>families.csv</code>, "
      "<code>sites.csv</code>, <code>walks.csv</code> and <code>slopes.csv</code>; angles in radians, "
      "distances in "
      "parameters (the domain is [0, 1]<sup>2</sup>, or a triangle of side 1). Every surface is turned by "
      "40&deg; about "
      "(1, 2, 3): along the axes some cross products come out right by chance. Slopes are fitted by least "
      "squares over "
      "places with an error between 10 &times; 2<sup>-52</sup> and 0.1. Two rays are aimed at every place, "
      "along the "
      "normal and at 60&deg; to it, and met by a scene's default solver for the surface and by the two that "
      "meet any "
      "patch; on an open surface a ray may rightly pass by a place that is nearer to the boundary than the "
      "place is "
      "rounded. A radius is that of the sphere, 1; for objects of a scene, half of what they extend. Nothing "
      "is random but the samples of the close-ups, whose seed is 1. Commands are for the "
      "folder of "
      "this page.</p>\n";
  body += sites_section(tables.families, tables.sites);
  for (const Group& group : groups_of(walks)) {
    body += fmt::format("<h2>{}: {}</h2>\n", html_escaped(group.family), html_escaped(group.name));
    body += slopes_table(slopes, group) + solvers_table(walks, group) + plots(walks, group, folder);
    for (const CloseUps& ups : close_ups)
      if (ups.family == group.family && ups.group == group.name) body += close_up_section(ups);
  }
  return html_page("Normals at singular points", options.command, body);
}

}  // namespace rondure
