#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <system_error>

#include "renderer/shading/light.h"

namespace rondure {
namespace {

// Rotation about z, x or y by degrees, right-handed.
dmat3 rotation(int axis, double degrees) {
  // Whole turns of many are taken out exactly, for as many would leave the range of a double.
  const double a =
      (std::fabs(degrees) > 360.0 ? std::remainder(degrees, 360.0) : degrees) * std::numbers::pi / 180.0;
  const double c = std::cos(a), s = std::sin(a);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  dmat3 m(1.0);
  m[i][i] = c;
  m[i][j] = s;
  m[j][i] = -s;
  m[j][j] = c;
  return m;
}

EnvironmentLight read_environment(Params& params) {
  EnvironmentLight light;
  light.file = params.path("file");
  light.file_where = params.raw("file")->where;
  std::error_code error;
  const auto status = std::filesystem::status(light.file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    params.fail("file", "no such file: " + light.file);
  if (error) params.fail("file", light.file + ": " + error.message());
  if (std::filesystem::is_directory(status)) params.fail("file", "a folder, not a file: " + light.file);
  if (!std::filesystem::is_regular_file(status)) params.fail("file", "not a regular file: " + light.file);
  light.scale = params.color("scale", light.scale);
  // One number turns about z; three turn about x, then y, then z.
  dvec3 angles(0.0);
  const Value* rotate = params.raw("rotate");
  if (rotate != nullptr && rotate->kind == Value::Kind::number) {
    angles.z = params.number("rotate", 0.0, Range{});
  } else {
    angles = params.vec3("rotate", dvec3(0.0));
  }
  light.to_world = rotation(2, angles.z) * rotation(1, angles.y) * rotation(0, angles.x);
  return light;
}

DirectionalLight read_directional(Params& params) {
  DirectionalLight light;
  const dvec3 direction = params.vec3("direction", light.direction);
  const double size = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
  if (size == 0.0) params.fail("direction", "\"direction\" must not be the zero vector");
  light.direction = glm::normalize(direction / size);  // scaled first: its square may be out of range
  light.irradiance = params.color("irradiance", light.irradiance);
  return light;
}

Light read(Params& params) {
  const std::string type =
      params.choice("type", {"constant", "environment", "point", "directional"}, "constant");
  if (type == "constant") return ConstantLight{params.color("radiance", ConstantLight{}.radiance)};
  if (type == "environment") return read_environment(params);
  if (type == "directional") return read_directional(params);
  PointLight light;
  light.position = params.vec3("position");
  light.intensity = params.color("intensity", light.intensity);
  return light;
}

}  // namespace

Light read_light(Params& params) {
  Light light = read(params);
  params.finish();
  return light;
}

const std::vector<TypeDoc>& light_docs() {
  static const std::vector<TypeDoc> docs = {
      {"constant", "The same radiance from every direction.", {{"radiance", "colour >= 0", "1", "radiance"}}},
      {"environment",
       "An equirectangular image at infinity: z up, the image's centre column toward x.",
       {{"file", "path", "", "image file (EXR, HDR, PNG, JPEG, TIFF, PNM, TGA, BMP), relative to the scene"},
        {"scale", "colour >= 0", "1", "factor on the image"},
        {"rotate", "degrees, or three of them", "0", "turn about z, or about x, then y, then z"}}},
      {"point",
       "A point that shines alike in all directions.",
       {{"position", "point", "", "where it is"},
        {"intensity", "colour >= 0", "1", "radiant intensity (power per solid angle)"}}},
      {"directional",
       "Parallel light from infinity.",
       {{"direction", "vector", "[0, 0, -1]", "the way that the light travels"},
        {"irradiance", "colour >= 0", "1", "irradiance on a surface that faces it"}}},
  };
  return docs;
}

}  // namespace rondure
