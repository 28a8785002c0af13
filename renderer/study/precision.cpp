#include "renderer/study/precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/angle.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/normals/estimator.h"
#include "renderer/render/interrupt.h"
#include "renderer/render/progress.h"
#include "renderer/sampling/warps.h"
#include "renderer/study/float_solver.h"
#include "renderer/study/gnuplot.h"
#include "renderer/study/page.h"
#include "renderer/study/subjects.h"
#include "renderer/study/table.h"

namespace rondure {
namespace {

// The worst of many rays.
struct Worst {
  long hits = 0;
  double sphere = 0.0, ray = 0.0, normal = 0.0;

  void add(double off_sphere, double off_ray, double angle) {
    ++hits;
    sphere = std::max(sphere, off_sphere);
    ray = std::max(ray, off_ray);
    normal = std::max(normal, angle);
  }
};

double line_distance(const dvec3& p, const dvec3& origin, const dvec3& direction) {
  return glm::length(glm::cross(p - origin, glm::normalize(direction)));
}

dvec3 widened(const Vector3In<float>& v) { return {v[0], v[1], v[2]}; }

// The patch in the world.
Net placed(const Surface& surface, const Net& net) {
  dmat4 move(1.0);
  move[3] = dvec4(surface.origin, 1.0);
  return transformed(net, move);
}

void float_ray(const Surface& surface, const FloatSolver& solver, double radius, const Ray& ray,
               Worst& worst) {
  const std::optional<FloatHit> hit = solver.closest(ray);
  if (!hit) return;
  const dvec3 n = widened(cross_in(hit->at.du, hit->at.dv)), point = widened(hit->at.point);
  const double length = glm::length(n);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const dvec3 exact = net_point(surface.patches[0], hit->u, hit->v);
  worst.add(std::abs(glm::distance(point, surface.origin) - radius) / radius,
            line_distance(point, ray.origin, ray.direction) / radius,
            angle_between(n / length, glm::normalize(exact)));
}

void double_ray(const Surface& surface, const Tracer& tracer, double radius, const Ray& ray, Worst& worst) {
  const Hit hit = tracer.closest(ray);
  if (!hit) return;
  // In the surface's own frame; the ray's offset is taken there too.
  const dvec3 point = net_point(surface.patches[static_cast<std::size_t>(hit.patch)], hit.u, hit.v);
  worst.add(std::abs(glm::length(point) - radius) / radius,
            line_distance(point, ray.origin - surface.origin, ray.direction) / radius,
            angle_between(hit.normal, glm::normalize(point)));
}

std::string line_of(const Subject& subject, Surface surface, double radius, double distance, int rays) {
  dmat4 scale(radius);
  scale[3][3] = 1.0;
  for (Net& net : surface.patches) net = transformed(net, scale);
  surface.origin = distance * glm::normalize(dvec3(1.0, 0.7, -0.4));
  Surface first = surface;
  first.patches.resize(1);
  const FloatSolver solver(placed(surface, first.patches[0]));
  const Tracer tracer({TracedSurface{surface, Solver::newton}});
  const bool triangle = std::holds_alternative<TriangleNet>(first.patches[0]);
  Worst single, twice;
  for (int k = 0; k < rays; ++k) {
    // Roberts's sequence (2018), and as many rays near a corner.
    dvec2 p(std::fmod(0.5 + 0.7548776662466927 * (k + 1), 1.0),
            std::fmod(0.5 + 0.5698402909980532 * (k + 1), 1.0));
    if (triangle && p.x + p.y > 1.0) p = dvec2(1.0) - p;
    if (k % 2 == 1) p *= 1e-3;
    const dvec3 target = net_point(first.patches[0], p.x, p.y);
    const dvec3 out = glm::normalize(target), aside = frame_about(out).x;
    const dvec3 from = 0.8 * out + 0.6 * aside;
    const Ray ray{surface.origin + target + 4.0 * radius * from, -from};
    float_ray(first, solver, radius, ray, single);
    double_ray(surface, tracer, radius, ray, twice);
  }
  std::string text = fmt::format("{},{},{},{}", subject.name, csv_number(radius), csv_number(distance), rays);
  for (const Worst* w : {&single, &twice})
    text += fmt::format(",{},{},{},{}", w->hits, csv_number(w->sphere), csv_number(w->ray),
                        csv_number(w->normal));
  return text + "\n";
}

constexpr const char* header =
    "family,radius,distance,rays,float_hits,float_sphere,float_ray,float_normal,double_hits,double_sphere,"
    "double_ray,"
    "double_normal\n";

std::string table_html(const Table& table) {
  std::vector<std::vector<std::string>> rows = {
      {"family", "radius", "distance", "rays", "hits, float", "off the sphere", "off the ray", "normal (rad)",
       "hits, double", "off the sphere", "off the ray", "normal (rad)"}};
  for (std::size_t k = 0; k < table.size(); ++k) {
    std::vector<std::string> row = {table.at(k, "family"), number_text(table.number(k, "radius")),
                                    number_text(table.number(k, "distance")), table.at(k, "rays")};
    for (const char* kind : {"float_", "double_"}) {
      row.push_back(table.at(k, kind + std::string("hits")));
      for (const char* what : {"sphere", "ray", "normal"})
        row.push_back(number_text(table.number(k, kind + std::string(what))));
    }
    rows.push_back(row);
  }
  return html_table(rows);
}

// The worst of all rays by what one of `x` and `fixed` is, the other column being `at`.
std::string plot_of(const Table& table, const std::string& family, const std::string& x,
                    const std::string& fixed, double at, const StudyFolder& folder) {
  const bool by_distance = x == "distance";
  Plot plot{family + (by_distance ? ", radius 1" : ", about the origin"),
            by_distance ? "distance of the centre from the world's origin (radii)" : "radius",
            "worst of all hits",
            {}};
  const std::pair<const char*, const char*> columns[] = {
      {"float_sphere", "float: off the sphere (radii)"}, {"float_ray", "float: off the ray (radii)"},
      {"float_normal", "float: normal (rad)"},           {"double_sphere", "double: off the sphere (radii)"},
      {"double_ray", "double: off the ray (radii)"},     {"double_normal", "double: normal (rad)"}};
  for (const auto& [column, name] : columns) {
    Curve curve{name, {}, {}};
    for (std::size_t k = 0; k < table.size(); ++k) {
      if (table.at(k, "family") != family || table.number(k, fixed) != at) continue;
      if (!(table.number(k, "float_hits") > 0) && column[0] == 'f') continue;
      curve.x.push_back(table.number(k, x));
      curve.y.push_back(table.number(k, column));
    }
    plot.curves.push_back(curve);
  }
  const std::string name = "precision-" + family + "-" + x;
  return html_figure(
      plot_svg(folder, name, plot),
      fmt::format("Single and double precision by {}. {}Made by <code>gnuplot {}.gp</code>.", x,
                  by_distance ? "Distance 0, and what has no hit, is not drawn. " : "", name));
}

std::string plots_of(const Table& table, const std::string& family, const StudyFolder& folder) {
  return fmt::format("<h2>{}</h2>\n", html_escaped(family)) +
         plot_of(table, family, "distance", "radius", 1.0, folder) +
         plot_of(table, family, "radius", "distance", 0.0, folder);
}

}  // namespace

void study_precision(const StudyOptions& options, const Registry& registry) {
  require_gnuplot();
  const std::vector<std::string> names =
      options.families.empty() ? std::vector<std::string>{"cube", "hemispheres", "octants", "gc1_sphere"}
                               : options.families;
  const std::vector<Subject> chosen = spheres_named(names);
  const StudyFolder folder(options.output);
  const StudyFolder parts(folder.path("parts"));
  const std::vector<double> radii =
      options.quick ? std::vector{1e-3, 1.0, 1e3} : std::vector{1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6};
  const std::vector<double> distances = options.quick
                                            ? std::vector{0.0, 1e2, 1e4, 1e6}
                                            : std::vector{0.0, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8};
  const int rays = options.quick ? 64 : 512;
  const InterruptGuard guard;
  Progress progress("precision", chosen.size() * radii.size(), progress_style(options.quiet));
  Table table;
  for (const Subject& subject : chosen) {
    for (const double radius : radii) {
      const std::string key =
          fmt::format("{} {} {} {}", subject.object, radius, fmt::join(distances, " "), rays);
      table.append(Table(folder.kept(fmt::format("parts/{}-{:.0e}.csv", subject.name, radius), key, [&] {
        const Surface surface = surface_of(subject, registry);
        std::string text = header;
        for (const double distance : distances)
          text += line_of(subject, surface, radius, distance * radius, rays);
        return text;
      })));
      progress.advance(1);
      stop_if_interrupted(progress, folder);
    }
  }
  folder.write("precision.csv", table.text());
  std::string body =
      "<p>Rays at 37&deg; to the normal at places of a patch's parameters (Roberts's sequence, nothing "
      "random), "
      "every other one within a thousandth of a corner. Single precision: control points, ray and solver in "
      "world "
      "space, all in floats; Newton's method from the middle of each of the patch's 64 leaves whose box the "
      "ray meets "
      "(Martin et al. 2000), while the distance from the ray halves at least, 8 steps at most; it has found "
      "a hit when "
      "that distance is no more than 16 roundings of the largest coordinate. Double precision: Rondure's "
      "tracer with "
      "its solver for any patch, <code>newton</code>. Hits are out of all rays; the other columns are the "
      "worst of the "
      "hits: off the sphere and off the ray in radii, the normal in radians from that at the hit's "
      "parameters. The "
      "same numbers are in <code>precision.csv</code>.</p>\n";
  for (const Subject& subject : chosen) body += plots_of(table, subject.name, folder);
  folder.write("index.html",
               html_page("Single and double precision", options.command, body + table_html(table)));
}

}  // namespace rondure
