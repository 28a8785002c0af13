#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "renderer/camera/camera.h"

namespace rondure {

// Coordinates of a camera: beyond them squares of distances would leave the range of a double.
constexpr double farthest = 1e100;

Camera read_camera(Params& params) {
  const std::string type = params.choice("type", {"perspective", "orthographic"}, "perspective");
  const Projection projection = type == "perspective" ? Projection::perspective : Projection::orthographic;
  const Range place = Range::closed(-farthest, farthest);
  const dvec3 origin = params.vec3("origin", dvec3(0, -4, 1), place);
  const dvec3 target = params.vec3("target", dvec3(0, 0, 0), place);
  const dvec3 up = params.vec3("up", dvec3(0, 0, 1));
  Camera camera;
  try {
    camera = look_at(projection, origin, target, up);
  } catch (const std::invalid_argument& e) {
    params.fail(e.what());
  }
  if (projection == Projection::perspective) {
    const double fov = params.number("fov", 35.0, Range::open(0.0, 180.0));
    camera.extent = 2.0 * std::tan(fov * std::numbers::pi / 360.0);
    camera.aperture = params.number("aperture", 0.0, Range::not_negative());
    camera.focus_distance = params.number("focus_distance", camera.focus_distance, Range::positive());
  } else {
    camera.extent = params.number("height", camera.extent, Range::positive());
  }
  params.finish();
  return camera;
}

const std::vector<TypeDoc>& camera_docs() {
  static const ParameterDoc origin{"origin", "point within 1e100", "[0, -4, 1]", "where the camera is"};
  static const ParameterDoc target{"target", "point within 1e100", "[0, 0, 0]",
                                   "the point at the picture's centre"};
  static const ParameterDoc up{"up", "vector", "[0, 0, 1]", "what is upward in the picture"};
  static const std::vector<TypeDoc> docs = {
      {"perspective",
       "Central projection, through a thin lens where `aperture` is positive.",
       {origin,
        target,
        up,
        {"fov", "degrees in (0, 180)", "35", "angle of view from the picture's top to its bottom"},
        {"aperture", "number >= 0", "0", "radius of the lens"},
        {"focus_distance", "number > 0", "distance to target",
         "distance, along the view, of the plane in focus"}}},
      {"orthographic",
       "Parallel projection.",
       {origin, target, up, {"height", "number > 0", "2.5", "height of the window that is seen"}}},
  };
  return docs;
}

}  // namespace rondure
