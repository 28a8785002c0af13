#include "renderer/projective/ball.h"

#include "renderer/projective/cube_faces.h"

namespace rondure {

std::vector<TensorNet> ball(const dvec3& centre, double radius) {
  std::vector<TensorNet> nets;
  for (const Net& face : cube_of(cube_face_2_4())) {
    nets.push_back(std::get<TensorNet>(face));
    for (dvec4& p : nets.back().points) p = dvec4(radius * dvec3(p) + p.w * centre, p.w);
  }
  return nets;
}

}  // namespace rondure
