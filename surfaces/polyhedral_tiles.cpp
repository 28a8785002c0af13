#include "surfaces/polyhedral_tiles.h"

#include <algorithm>
#include <cmath>

#include "renderer/projective/frame.h"

namespace rondure {
namespace {

using Points = std::vector<lvec3>;

Points on_sphere(Points points) {
  for (lvec3& p : points) p = glm::normalize(p);
  return points;
}

// (+-a, +-b, +-c), every sign once.
Points signed_points(long double a, long double b, long double c) {
  Points points;
  for (int k = 0; k < 8; ++k) {
    const lvec3 p((k & 1) != 0 ? -a : a, (k & 2) != 0 ? -b : b, (k & 4) != 0 ? -c : c);
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
  return points;
}

// With their cyclic permutations.
Points signed_cycles(long double a, long double b, long double c) {
  Points points = signed_points(a, b, c);
  for (const Points& more : {signed_points(c, a, b), signed_points(b, c, a)})
    points.insert(points.end(), more.begin(), more.end());
  return points;
}

// Vertices, and the directions of the faces' middles.
struct Polyhedron {
  Points vertices, faces;
};

Polyhedron tetrahedron() {
  const Points corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  Points opposite = corners;
  for (lvec3& p : opposite) p = -p;
  return {on_sphere(corners), opposite};
}

Polyhedron octahedron() { return {signed_cycles(1, 0, 0), signed_points(1, 1, 1)}; }

Polyhedron icosahedron() {
  const long double golden = (1 + std::sqrt(5.0L)) / 2;
  Points faces = signed_points(1, 1, 1);
  for (const lvec3& p : signed_cycles(0, golden * golden, 1)) faces.push_back(p);
  return {on_sphere(signed_cycles(0, 1, golden)), faces};
}

// The vertices nearest to a face's middle, counter-clockwise, from the first of the list on.
Points face_about(const Points& vertices, const lvec3& middle) {
  long double highest = -2;
  for (const lvec3& p : vertices) highest = std::max(highest, glm::dot(p, middle));
  Points face;
  for (const lvec3& p : vertices) {
    if (glm::dot(p, middle) > highest - 1e-9L) face.push_back(p);
  }
  const lvec3 start = face.front();
  const auto angle = [&](const lvec3& p) {
    const lvec3 axis = glm::normalize(middle);
    const long double a = std::atan2(glm::dot(axis, glm::cross(start, p)),
                                     glm::dot(start, p) - glm::dot(start, axis) * glm::dot(p, axis));
    return a < -1e-9L ? a + 7 : a;  // any full turn and more: the order is all that counts
  };
  std::sort(face.begin(), face.end(), [&](const lvec3& p, const lvec3& q) { return angle(p) < angle(q); });
  return face;
}

lvec3 middle_of(const lvec3& p, const lvec3& q) { return glm::normalize(p + q); }

// The two triangles at the edge from p to q, in the order: the one that is to its right, first.
Tile pair_about(const Polyhedron& solid, const lvec3& p, const lvec3& q) {
  lvec3 right(0), left(0);
  for (const lvec3& direction : solid.faces) {
    const Points face = face_about(solid.vertices, direction);
    const auto at = [&](const lvec3& x) { return std::find(face.begin(), face.end(), x) - face.begin(); };
    const auto i = at(p), j = at(q);
    if (i == 3 || j == 3) continue;
    ((i + 1) % 3 == j ? left : right) = face[static_cast<std::size_t>(3 - i - j)];
  }
  return {{right, q, left, p}, middle_of(p, q)};
}

// All triangles with a corner at `top`, each with the one across the edge that is opposite.
void add_pairs_around(const Polyhedron& solid, const lvec3& top, std::vector<Tile>& tiles) {
  for (const lvec3& direction : solid.faces) {
    const Points face = face_about(solid.vertices, direction);
    for (std::size_t k = 0; k < 3; ++k) {
      if (face[k] == top) tiles.push_back(pair_about(solid, face[(k + 2) % 3], face[(k + 1) % 3]));
    }
  }
}

void add_thirds(const Points& face, std::vector<Tile>& tiles) {
  const lvec3 middle = glm::normalize(face[0] + face[1] + face[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const lvec3 after = middle_of(face[k], face[(k + 1) % 3]), before = middle_of(face[k], face[(k + 2) % 3]);
    tiles.push_back({{face[k], after, middle, before}, middle_of(after, before)});
  }
}

std::vector<Tile> thirds(const Polyhedron& solid) {
  std::vector<Tile> tiles;
  for (const lvec3& direction : solid.faces) add_thirds(face_about(solid.vertices, direction), tiles);
  return tiles;
}

std::vector<Tile> rhombicuboctahedron(bool halved) {
  const Points vertices = on_sphere(signed_cycles(1, 1, 1 + std::sqrt(2.0L)));
  std::vector<Tile> tiles;
  const auto add = [&](const Points& face) {
    tiles.push_back(
        {{face[0], face[1], face[2], face[3]}, glm::normalize(face[0] + face[1] + face[2] + face[3])});
  };
  for (const lvec3& axis : signed_cycles(1, 0, 0)) add(face_about(vertices, axis));
  for (const lvec3& between : signed_cycles(1, 1, 0)) {
    Points face = face_about(vertices, between);
    if (!halved) {
      add(face);
      continue;
    }
    // Cut the two sides that border on triangles. The other two have their middles in planes of coordinates.
    const lvec3 side = glm::abs(face[0] + face[1]);
    const bool at_triangle = std::min(side.x, std::min(side.y, side.z)) > 1e-9L;
    if (!at_triangle) std::rotate(face.begin(), face.begin() + 1, face.end());
    const lvec3 near = middle_of(face[0], face[1]), far = middle_of(face[2], face[3]);
    add({face[0], near, far, face[3]});
    add({face[1], face[2], far, near});
  }
  for (const lvec3& corner : signed_points(1, 1, 1)) add_thirds(face_about(vertices, corner), tiles);
  return tiles;
}

}  // namespace

std::vector<Tile> tetrahedron_pairs() {
  const Polyhedron solid = tetrahedron();
  const Points& v = solid.vertices;
  return {pair_about(solid, v[0], v[1]), pair_about(solid, v[2], v[3])};
}

std::vector<Tile> octahedron_pairs() {
  const Polyhedron solid = octahedron();
  std::vector<Tile> tiles;
  // About the four edges of the equator: from pole to pole.
  const Points equator{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (std::size_t k = 0; k < 4; ++k) tiles.push_back(pair_about(solid, equator[k], equator[(k + 1) % 4]));
  return tiles;
}

std::vector<Tile> icosahedron_pairs() {
  const Polyhedron solid = icosahedron();
  std::vector<Tile> tiles;
  const lvec3 top = solid.vertices.front();
  add_pairs_around(solid, top, tiles);
  add_pairs_around(solid, -top, tiles);
  return tiles;
}

std::vector<Tile> tetrahedron_quads() { return thirds(tetrahedron()); }
std::vector<Tile> octahedron_quads() { return thirds(octahedron()); }
std::vector<Tile> icosahedron_quads() { return thirds(icosahedron()); }
std::vector<Tile> rhombicuboctahedron_42() { return rhombicuboctahedron(false); }
std::vector<Tile> rhombicuboctahedron_54() { return rhombicuboctahedron(true); }

}  // namespace rondure
