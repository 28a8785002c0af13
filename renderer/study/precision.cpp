#include "renderer/study/precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/tangents_in.h"
#include "renderer/bezier/transform.h"
#include "renderer/normals/estimator.h"
#include "renderer/render/progress.h"
#include "renderer/sampling/warps.h"
#include "renderer/study/gnuplot.h"
#include "renderer/study/page.h"

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

double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double line_distance(const dvec3& p, const dvec3& origin, const dvec3& direction) {
  return glm::length(glm::cross(p - origin, glm::normalize(direction)));
}

using FloatVector = Vector3In<float>;

dvec3 widened(const FloatVector& v) { return {v[0], v[1], v[2]}; }
FloatVector narrowed(const dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
float dot_in(const FloatVector& a, const FloatVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Newton's method in single precision on a net in world space, from parameters that are right. False when it
// leaves the patch or the numbers.
bool float_hit(const Net& world, const FloatVector& origin, const FloatVector& direction, float& u, float& v,
               TangentsIn<float>& at) {
  const Frame frame = frame_about(glm::normalize(widened(direction)));
  const FloatVector plane[2] = {narrowed(frame.x), narrowed(frame.y)};
  for (int step = 0; step < 8; ++step) {
    at = tangents_in<float>(world, u, v);
    float f[2], fu[2], fv[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const FloatVector off = {at.point[0] - origin[0], at.point[1] - origin[1], at.point[2] - origin[2]};
      f[k] = dot_in(plane[k], off) * at.weight;
      fu[k] = dot_in(plane[k], at.du);
      fv[k] = dot_in(plane[k], at.dv);
    }
    const float det = fu[0] * fv[1] - fu[1] * fv[0];
    if (!(std::abs(det) > 0.0f)) return false;
    const float du = (fv[1] * f[0] - fv[0] * f[1]) / det, dv = (fu[0] * f[1] - fu[1] * f[0]) / det;
    if (!std::isfinite(du) || !std::isfinite(dv)) return false;
    u -= du, v -= dv;
    if (!(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)) return false;
  }
  at = tangents_in<float>(world, u, v);
  return true;
}

// The net in the world as single precision holds it.
Net rounded_to_float(const Surface& surface, const Net& net) {
  dmat4 move(1.0);
  move[3] = dvec4(surface.origin, 1.0);
  Net world = transformed(net, move);
  for (dvec4& p : points_of(world))
    for (int c = 0; c < 4; ++c) p[c] = static_cast<float>(p[c]);
  return world;
}

void float_ray(const Surface& surface, const Net& world, double radius, const Ray& ray, dvec2 start,
               Worst& worst) {
  const FloatVector origin = narrowed(ray.origin), direction = narrowed(ray.direction);
  auto u = static_cast<float>(start.x), v = static_cast<float>(start.y);
  TangentsIn<float> at;
  if (!float_hit(world, origin, direction, u, v, at)) return;
  const dvec3 point = widened(at.point);
  const FloatVector n = cross_in(at.du, at.dv);
  const double length = glm::length(widened(n));
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const dvec3 out = point - surface.origin;
  const dvec3 exact = net_point(surface.patches[0], u, v);
  worst.add(std::abs(glm::length(out) - radius) / radius,
            line_distance(point, widened(origin), widened(direction)) / radius,
            angle_between(widened(n) / length, glm::normalize(exact)));
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
  const Net world = rounded_to_float(surface, first.patches[0]);
  const Tracer tracer({TracedSurface{surface}});
  Worst single, twice;
  for (int k = 0; k < rays; ++k) {
    // Roberts's sequence (2018), and as many rays near a corner.
    dvec2 p(std::fmod(0.5 + 0.7548776662466927 * (k + 1), 1.0),
            std::fmod(0.5 + 0.5698402909980532 * (k + 1), 1.0));
    if (k % 2 == 1) p *= 1e-3;
    const dvec3 target = net_point(first.patches[0], p.x, p.y);
    const dvec3 out = glm::normalize(target), aside = frame_about(out).x;
    const dvec3 from = 0.8 * out + 0.6 * aside;
    const Ray ray{surface.origin + target + 4.0 * radius * from, -from};
    float_ray(first, world, radius, ray, p, single);
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

std::string plot_of(const Table& table, const std::string& family, const StudyFolder& folder) {
  Plot plot{family + ", radius 1",
            "distance of the centre from the world's origin (radii)",
            "worst of all rays",
            {}};
  for (const char* column : {"float_ray", "float_normal", "double_ray", "double_normal"}) {
    Curve curve{column, {}, {}};
    for (std::size_t k = 0; k < table.size(); ++k) {
      if (table.at(k, "family") != family || table.number(k, "radius") != 1.0) continue;
      curve.x.push_back(table.number(k, "distance"));
      curve.y.push_back(table.number(k, column));
    }
    plot.curves.push_back(curve);
  }
  return html_figure(
      plot_svg(folder, "precision-" + family, plot),
      "Single and double precision by distance: off the ray in radii, error of the normal in radians. "
      "Distance 0 is not drawn.");
}

}  // namespace

void study_precision(const StudyOptions& options, const Registry& registry) {
  require_gnuplot();
  const std::vector<std::string> names = options.families.empty()
                                             ? std::vector<std::string>{"cube", "hemispheres", "octants"}
                                             : options.families;
  std::vector<Subject> chosen = subjects_named(names);
  std::erase_if(chosen, [](const Subject& s) { return !s.sphere || s.name == "gc1_sphere"; });
  if (chosen.empty())
    throw std::runtime_error("none of these families is a unit sphere of rectangular patches");
  const StudyFolder folder(options.output);
  const std::vector<double> radii =
      options.quick ? std::vector{1e-3, 1.0, 1e3} : std::vector{1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6};
  const std::vector<double> distances = options.quick
                                            ? std::vector{0.0, 1e2, 1e4, 1e6}
                                            : std::vector{0.0, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8};
  const int rays = options.quick ? 64 : 512;
  Progress progress("precision", chosen.size() * radii.size() * distances.size(),
                    progress_style(options.quiet));
  std::string text = header;
  for (const Subject& subject : chosen) {
    const Surface surface = surface_of(subject, registry);
    for (const double radius : radii) {
      for (const double distance : distances) {
        text += line_of(subject, surface, radius, distance * radius, rays);
        progress.advance(1);
      }
    }
  }
  const Table table(text);
  folder.write("precision.csv", table.text());
  std::string body =
      "<p>Rays at 37&deg; to the normal at places of a patch, half of them within a thousandth of a corner. "
      "Single "
      "precision: control points, ray and Newton's method (started at the true root) in world space, all in "
      "floats. "
      "Double: Rondure's tracer. The same numbers are in <code>precision.csv</code>.</p>\n";
  for (const Subject& subject : chosen) body += plot_of(table, subject.name, folder);
  folder.write("index.html",
               html_page("Single and double precision", options.command, body + table_html(table)));
}

}  // namespace rondure
