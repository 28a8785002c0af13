#include "renderer/study/parametrisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/angle.h"
#include "renderer/film/image.h"
#include "renderer/film/preview.h"
#include "renderer/render/interrupt.h"
#include "renderer/render/progress.h"
#include "renderer/shading/color_map.h"
#include "renderer/study/page.h"
#include "renderer/study/picture.h"
#include "renderer/study/subjects.h"
#include "renderer/study/table.h"

namespace rondure {
namespace {

constexpr double least = 1e-17, most = 1e-2;  // of the maps
constexpr int shown_side = 320;               // of pictures on the page, in screen pixels

constexpr const char* analytic_sphere = R"({ "type": "sphere" })";

std::string scene_of(const std::string& object, int side) {
  // By the patches themselves: in closed form the quadric would be met, whatever they are.
  const bool patches = object != analytic_sphere;
  std::string placed = object;
  placed.replace(
      placed.find('{'), 1,
      patches ? "{ \"material\": \"pewter\", \"solver\": \"newton\"," : "{ \"material\": \"pewter\",");
  return fmt::format(R"({{
  "camera": {{ "origin": [1.1, -4.6, 2.3], "target": [0, 0, 0], "fov": 27 }},
  "film": {{ "resolution": [{0}, {0}], "filter": "box" }},
  "sampling": {{ "spp": 16, "seed": 1 }},
  "integrator": {{ "type": "path", "max_depth": 4 }},
  "materials": {{
    "pewter": {{ "type": "rough_conductor", "roughness": 0.3 }},
    "floor": {{ "albedo": 0.5 }}
  }},
  "lights": [ {{ "type": "constant", "radiance": 0.3 }},
    {{ "type": "directional", "direction": [0.6, 0.9, -1], "irradiance": 2 }} ],
  "objects": [ {1},
    {{ "type": "bezier", "material": "floor", "center": [0, 0, -1], "radius": 20, "patches": [ {{ "degree": [1, 1],
      "net": [ [ [-1, -1, 0, 1], [-1, 1, 0, 1] ], [ [1, -1, 0, 1], [1, 1, 0, 1] ] ] }} ] }} ]
}}
)",
                     side, placed);
}

struct Compared {
  std::string row;           // a table of one row
  std::string picture, map;  // PNG
};

double place_of(double difference) {
  return std::log(std::max(difference, least) / least) / std::log(most / least);
}

Compared compare(const Subject& subject, std::size_t patches, const Film& truth, const Film& film,
                 const StudyFolder& folder) {
  double sum = 0.0, size = 0.0, color = 0.0, normal = 0.0, point = 0.0;
  long missed = 0;
  std::vector<unsigned char> map;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const FilmSample a = truth.mean(x, y), b = film.mean(x, y);
      const PixelGeometry &p = truth.geometry[truth.index(x, y)], &q = film.geometry[film.index(x, y)];
      const dvec3 d = b.color - a.color;
      const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      sum += glm::dot(d, d);
      size += glm::dot(a.color, a.color);
      color = std::max(color, largest);
      missed += p.surface != q.surface;
      if (p.surface == 0 && q.surface == 0) {
        point = std::max(point, glm::distance(p.point, q.point));
        normal = std::max(normal, angle_between(a.normal, b.normal));
      }
      const dvec3 shown = mapped_color("viridis", place_of(largest));
      for (int c = 0; c < 3; ++c) map.push_back(srgb_byte(shown[c]));
    }
  }
  Compared result;
  result.row = fmt::format("family,patches,rmse,color,normal,point,missed\n{},{},{},{},{},{},{}\n",
                           subject.name, patches, csv_number(std::sqrt(sum / size)), csv_number(color),
                           csv_number(normal), csv_number(point), missed);
  Legend legend{"largest difference of a channel", least, most, true, {}};
  for (int k = 0; k < 256; ++k) legend.colors.push_back(mapped_color("viridis", k / 255.0));
  const int zoom = shown_side / film.width();
  result.picture = png_bytes(folder, film, zoom);
  result.map = png_bytes(folder, map, film.width(), film.height(), zoom, &legend);
  return result;
}

// The same scene with the sphere in patches or analytic, each made when first asked for.
class Comparison {
 public:
  Comparison(const StudyFolder& folder, const Registry& registry, int side)
      : folder_(folder), registry_(registry), side_(side) {}

  // From files of an earlier run where they are of the same scenes.
  Compared of(const Subject& subject) {
    const std::string truth = scene_of(analytic_sphere, side_), scene = scene_of(subject.object, side_);
    folder_.write("sphere.json", truth);
    folder_.write(subject.name + ".json", scene);
    std::optional<Compared> fresh;
    const auto made = [&]() -> const Compared& {
      if (fresh) return *fresh;
      if (!truth_) truth_ = film_of(truth, "sphere.json");
      const Film film = film_of(scene, subject.name + ".json");
      fresh = compare(subject, surface_of(subject, registry_).patches.size(), *truth_, film, folder_);
      return *fresh;
    };
    const std::string part = "parts/" + subject.name, key = truth + scene;
    Compared kept;
    kept.row = folder_.kept(part + ".csv", key, [&] { return made().row; });
    kept.picture = folder_.kept(part + ".png", key, [&] { return made().picture; });
    kept.map = folder_.kept(part + "-map.png", key, [&] { return made().map; });
    return kept;
  }

 private:
  const StudyFolder& folder_;
  const Registry& registry_;
  int side_;
  std::optional<Film> truth_;

  Film film_of(const std::string& scene, const std::string& name) const {
    return take_picture(scene, name, registry_, tracer_for(scene, name, registry_));
  }
};

std::string figure_of(const Subject& subject, const Compared& compared) {
  const std::string name = html_escaped(subject.name);
  return html_figure(
      "<div class=\"pair\">" + html_picture(compared.picture, subject.name) +
          html_picture(compared.map, subject.name + ", difference") + "</div>",
      fmt::format(
          "{}: the picture, by <code>rondure render {}.json --png picture.png</code>, and its difference "
          "from "
          "that of the analytic sphere (<code>sphere.json</code>): the largest of the three channels, linear "
          "values, on a logarithmic scale. 16 samples a pixel, seed 1.",
          name, name));
}

}  // namespace

void study_parametrisation(const StudyOptions& options, const Registry& registry) {
  const std::vector<Subject> chosen = spheres_named(options.families);
  require_image_module();
  const StudyFolder folder(options.output);
  const StudyFolder parts(folder.path("parts"));
  const InterruptGuard guard;
  Progress progress("parametrisations", chosen.size(), progress_style(options.quiet));
  Comparison comparison(folder, registry, options.quick ? shown_side / 2 : shown_side);
  Table table;
  std::vector<std::vector<std::string>> rows = {{"family", "patches", "relative RMSE", "largest difference",
                                                 "normals (rad)", "points (radii)",
                                                 "pixels hit by one alone"}};
  std::string figures;
  for (const Subject& subject : chosen) {
    const Compared c = comparison.of(subject);
    const Table row(c.row);
    table.append(row);
    rows.push_back({subject.name, row.at(0, "patches"), number_text(row.number(0, "rmse")),
                    number_text(row.number(0, "color")), number_text(row.number(0, "normal")),
                    number_text(row.number(0, "point")), row.at(0, "missed")});
    figures += figure_of(subject, c);
    progress.advance(1);
    stop_if_interrupted(progress, folder);
  }
  folder.write("parametrisation.csv", table.text());
  folder.write(
      "index.html",
      html_page(
          "One sphere, many parametrisations", options.command,
          "<p>The same scene with the same samples, the sphere once analytic and once in patches, met by "
          "<code>newton</code> on the patches themselves: the default solver meets spheres in closed "
          "form, whatever their patches, and gives the same bits for all. Differences of pictures, and "
          "the largest angles of normals and distances of points at pixels' first hits. All numbers are "
          "in <code>parametrisation.csv</code>.</p>\n" +
              html_table(rows) + figures));
}

}  // namespace rondure
