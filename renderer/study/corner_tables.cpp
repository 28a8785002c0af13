#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/solver_name.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/walk.h"

namespace rondure {
namespace {

std::string group_of(const SingularSite& site) {
  return site.kind == "collapsed side"
             ? fmt::format("{} ({})", site.kind, site.place == "corner" ? "end" : "middle")
         : site.place == "corner" ? site.kind
                                  : fmt::format("{} ({})", site.kind, site.place);
}

std::string sites_text(const std::string& family, const Surface& surface,
                       const std::vector<SingularSite>& sites) {
  std::string text =
      "family,site,group,patch,u,v,x,y,z,place,kind,order,side_order,limit,spread,nx,ny,nz,ax,ay,az,proof,"
      "within\n";
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const SingularSite& s = sites[k];
    const dvec3 n = s.limit.value_or(dvec3(std::nan("")));
    // The normal along one way in, which there always is.
    const dvec3 a = unit_normal(surface.patches[static_cast<std::size_t>(s.patch)], s.at.x, s.at.y);
    const dvec3 p = surface.origin + s.point;
    text += fmt::format("{},{},{},{},{}", family, k, group_of(s), s.patch, csv_number(s.at.x));
    for (const double x : {s.at.y, p.x, p.y, p.z}) text += "," + csv_number(x);
    text += fmt::format(",{},{},{},{},{},{}", s.place, s.kind, s.germ.order, s.germ.side_order,
                        s.limit ? 1 : 0, csv_number(s.germ.spread));
    for (const double x : {n.x, n.y, n.z, a.x, a.y, a.z}) text += "," + csv_number(x);
    static constexpr const char* proofs[] = {"none", "exact", "unique"};
    text += fmt::format(",{},{}\n", proofs[static_cast<int>(s.proof)], csv_number(s.within));
  }
  return text;
}

std::string walks_header() {
  std::string text = "family,site,group,way,distance,u,v,sine,condition,smallest,reference";
  for (const char* what : {"error", "radiance"})
    for (const std::string& name : estimator_names()) text += fmt::format(",{}_{}", what, name);
  text += ",rays";
  for (const char* solver : RayTrials::names)
    for (const char* what : {"hits", "off", "steps", "undecided", "cells"})
      text += fmt::format(",{}_{}", what, solver);
  return text + "\n";
}

std::string walk_line(const std::string& family, const std::string& group, const WalkStep& s) {
  std::string text = fmt::format("{},{},{}", family, s.site, group);
  for (const double x : {s.way, s.distance, s.at.x, s.at.y, s.sine, s.condition, s.smallest})
    text += "," + csv_number(x);
  text += "," + s.reference;
  for (const double x : s.error) text += "," + csv_number(x);
  for (const double x : s.radiance) text += "," + csv_number(x);
  text += fmt::format(",{}", RayTrials::rays);
  for (const RayTrial& t : s.trials)
    text += fmt::format(",{},{},{},{},{}", t.hits, csv_number(t.off), t.steps, t.undecided, t.cells);
  return text + "\n";
}

}  // namespace

CornerTables measure_corners(const Subject& subject, const Registry& registry, bool quick) {
  const TracedSurface traced = traced_subject(subject, registry);
  const Surface& surface = traced.surface;
  const SiteSearch search = singular_sites(surface);
  CornerTables tables;
  tables.sites = Table(sites_text(subject.name, surface, search.sites));
  tables.families = Table(fmt::format("family,patches,solver,sites,undecided,pieces\n{},{},{},{},{},{}\n",
                                      subject.name, surface.patches.size(), solver_name(traced),
                                      search.sites.size(), search.undecided, search.pieces));
  std::string text = walks_header();
  if (!search.sites.empty()) {
    const NormalField field(surface);
    const RayTrials trials(traced);
    WalkOptions options;
    if (quick) options.ways = 1, options.per_decade = 1;
    std::map<std::string, int> walked;
    for (std::size_t k = 0; k < search.sites.size(); ++k) {
      const std::string group = group_of(search.sites[k]);
      // The sites of a group are alike in most families; a quick study looks at two of each.
      if (quick && ++walked[group] > 2) continue;
      for (const WalkStep& step : walk(surface, field, trials, search.sites[k], k, options))
        text += walk_line(subject.name, group, step);
    }
  }
  tables.walks = Table(text);
  return tables;
}

Table corner_slopes(const Table& walks) {
  std::string text = "family,group,estimator,slope,low,high,places,worst,at_1e-8,none,radiance\n";
  std::vector<std::pair<std::string, std::string>> groups;
  for (std::size_t k = 0; k < walks.size(); ++k) {
    const std::pair<std::string, std::string> group(walks.at(k, "family"), walks.at(k, "group"));
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  for (const auto& [family, group] : groups) {
    for (const std::string& name : estimator_names()) {
      std::vector<double> distances, errors;
      // Not numbers where the estimator gives no normal to measure.
      const double nan = std::nan("");
      double worst = nan, near = nan, radiance = 0.0;
      int none = 0;
      for (std::size_t k = 0; k < walks.size(); ++k) {
        if (walks.at(k, "family") != family || walks.at(k, "group") != group) continue;
        const double error = walks.number(k, "error_" + name), d = walks.number(k, "distance");
        radiance = std::max(radiance, walks.number(k, "radiance_" + name));
        if (std::isnan(error)) {
          ++none;
          continue;
        }
        distances.push_back(d);
        errors.push_back(error);
        worst = std::fmax(worst, error);
        if (std::abs(std::log10(d) + 8.0) < 0.2) near = std::fmax(near, error);
      }
      const std::optional<Slope> slope = fitted_slope(distances, errors);
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", family, group, name,
                          csv_number(slope ? slope->value : nan), csv_number(slope ? slope->low : nan),
                          csv_number(slope ? slope->high : nan), slope ? slope->places : 0, csv_number(worst),
                          csv_number(near), none, csv_number(radiance));
    }
  }
  return Table(text);
}

}  // namespace rondure
