#include "renderer/study/parametrisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/film/image.h"
#include "renderer/film/preview.h"
#include "renderer/render/interrupt.h"
#include "renderer/render/progress.h"
#include "renderer/shading/color_map.h"
#include "renderer/study/page.h"
#include "renderer/study/picture.h"

namespace rondure {
namespace {

constexpr double least = 1e-17, most = 1e-2;  // of the maps

std::string scene_of(const std::string& object, int side) {
  std::string placed = object;
  placed.replace(placed.find('{'), 1, "{ \"material\": \"pewter\",");
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
  Table row;
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
        normal = std::max(
            normal, std::atan2(glm::length(glm::cross(a.normal, b.normal)), glm::dot(a.normal, b.normal)));
      }
      const dvec3 shown = mapped_color("viridis", place_of(largest));
      for (int c = 0; c < 3; ++c) map.push_back(srgb_byte(shown[c]));
    }
  }
  Compared result;
  result.row = Table(fmt::format("family,patches,rmse,color,normal,point,missed\n{},{},{},{},{},{},{}\n",
                                 subject.name, patches, csv_number(std::sqrt(sum / size)), csv_number(color),
                                 csv_number(normal), csv_number(point), missed));
  Legend legend{"largest difference of a channel", least, most, true, {}};
  for (int k = 0; k < 256; ++k) legend.colors.push_back(mapped_color("viridis", k / 255.0));
  result.picture = png_bytes(folder, film);
  result.map = png_bytes(folder, map, film.width(), film.height(), 1, &legend);
  return result;
}

}  // namespace

void study_parametrisation(const StudyOptions& options, const Registry& registry) {
  std::vector<Subject> chosen = subjects_named(options.families);
  std::erase_if(chosen, [](const Subject& s) { return !s.sphere; });
  if (chosen.empty()) throw std::runtime_error("none of these families is the whole unit sphere");
  require_image_module();
  const StudyFolder folder(options.output);
  const int side = options.quick ? 160 : 320;
  const InterruptGuard guard;
  Progress progress("parametrisations", chosen.size() + 1, progress_style(options.quiet));
  const auto film_of = [&](const std::string& name, const std::string& scene) {
    folder.write(name + ".json", scene);
    return take_picture(scene, name + ".json", registry, tracer_for(scene, name + ".json", registry));
  };
  const Film truth = film_of("sphere", scene_of(R"({ "type": "sphere" })", side));
  progress.advance(1);
  Table table;
  std::vector<std::vector<std::string>> rows = {{"family", "patches", "relative RMSE", "largest difference",
                                                 "normals (rad)", "points (radii)",
                                                 "pixels hit by one alone"}};
  std::string figures;
  for (const Subject& subject : chosen) {
    const Film film = film_of(subject.name, scene_of(subject.object, side));
    const Compared c = compare(subject, surface_of(subject, registry).patches.size(), truth, film, folder);
    table.append(c.row);
    rows.push_back({subject.name, c.row.at(0, "patches"), number_text(c.row.number(0, "rmse")),
                    number_text(c.row.number(0, "color")), number_text(c.row.number(0, "normal")),
                    number_text(c.row.number(0, "point")), c.row.at(0, "missed")});
    figures += html_figure(
        "<div style=\"display:flex;gap:6px\">" + html_picture(c.picture, subject.name) +
            html_picture(c.map, "difference") + "</div>",
        fmt::format(
            "{}: the picture, and its largest difference from the analytic sphere's in any channel (linear, "
            "logarithmic scale). 16 samples a pixel, seed 1: <code>rondure render {}.json --png "
            "picture.png</code>",
            html_escaped(subject.name), html_escaped(subject.name)));
    progress.advance(1);
    if (interrupted()) throw std::runtime_error("interrupted");
  }
  folder.write("parametrisation.csv", table.text());
  folder.write(
      "index.html",
      html_page("One sphere, many parametrisations", options.command,
                "<p>The same scene with the same samples, the sphere once analytic and once in patches. All "
                "numbers are in <code>parametrisation.csv</code>.</p>\n" +
                    html_table(rows) + figures));
}

}  // namespace rondure
