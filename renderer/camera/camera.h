// Cameras: perspective with a thin lens, and orthographic.
//
// The image plane has (0, 0) at the top left and (1, 1) at the bottom right.
#pragma once

#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/type_doc.h"
#include "renderer/intersect/ray.h"

namespace rondure {

enum class Projection { perspective, orthographic };

struct Camera {
  Projection projection = Projection::perspective;
  dvec3 origin{0.0, -4.0, 1.0};
  // Orthonormal: right, up, and forward = up x right.
  dvec3 right{1.0, 0.0, 0.0};
  dvec3 up{0.0, 0.0, 1.0};
  dvec3 forward{0.0, 1.0, 0.0};
  double extent = 1.0;          // height of the image at distance 1, or of the orthographic window
  double aperture = 0.0;        // radius of the lens
  double focus_distance = 1.0;  // along `forward`
};

// Throws std::invalid_argument when origin and target coincide or `up` is parallel to the view.
Camera look_at(Projection projection, const dvec3& origin, const dvec3& target, const dvec3& up);

// At the origin of a scene that names no camera: looks at the origin from (0, -4, 1), 35 degrees high, z up.
Camera default_camera();

// `film` in [0, 1]^2 and outside it under wide filters; `aspect` is width / height; `lens` in [0, 1)^2. The
// direction is unit.
Ray camera_ray(const Camera& camera, double aspect, dvec2 film, dvec2 lens);

// In the convention of OpenEXR (column vectors here; the writer transposes): the camera looks along -z, y up.
dmat4 world_to_camera(const Camera& camera);
// x and y in [-1, 1] over the image, y up. With d the distance along the view, z is d under an orthographic
// camera and 1 - 1 / d under a perspective one: there are no clipping planes.
dmat4 world_to_ndc(const Camera& camera, double aspect);

// Reads the object at hand, "type" included, and finishes it.
Camera read_camera(Params& params);
const std::vector<TypeDoc>& camera_docs();

}  // namespace rondure
