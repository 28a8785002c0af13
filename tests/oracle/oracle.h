// Where a ray meets a surface, found at 50 digits and certified: the judge of the solvers, with which it
// shares no line.
//
// The nets and the ray are taken as the exact numbers that their doubles are. Two planes through the ray turn
// a net into a pair of Bernstein polynomials, whose common zeros are looked for by halving the parameter
// domain. A piece is dropped when the coefficients of a polynomial, or of a combination of the two, keep one
// sign by more than their rounding. It holds exactly one root when the preconditioned Jacobian stays within
// 1/2 of the identity all over the piece enlarged, and Newton's method ends inside (Krawczyk 1969). What is
// neither by the time it is 10^-39 of the net in space is a multiple root.
#pragma once

#include <vector>

#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"

namespace rondure::oracle {

struct Root {
  int patch = 0;
  double u = 0.0, v = 0.0;
  double t = 0.0;
  dvec3 point{0.0};      // in the surface's frame
  double outside = 0.0;  // by how much (u, v) is outside of the patch's domain; negative inside
  double cosine = 0.0;   // |normal . direction| of unit vectors; 0 where there is no normal
  // 1; 2: two within 10^-19 of each other, or touching, or missing by as little; 0: not known (singular points)
  int multiplicity = 0;
  bool certified = true;  // proven: 1 to exist, 2 that there are no more
  int way = 0;            // sign of normal . direction
};

// A place where the line would touch the patch if it were moved by `depth` at right angles to itself.
struct Graze {
  int patch = 0;
  double t = 0.0;
  double depth = 0.0;    // scene units, >= 0
  double outside = 0.0;  // as of a root
};

struct Meeting {
  std::vector<Root> roots;  // of the whole line, in order of t, patch by patch: a seam's root comes twice
  std::vector<Graze> grazes;
  std::size_t pieces = 0;  // of parameter domains looked at
  bool exhausted = false;  // given up after very many: roots may be missing
};

// The surface must have patches. `graze`: up to which depth, relative to the largest coordinate of a net,
// grazes are told. `margin`: how far outside of its domain, in parameters, a patch's roots are told too.
Meeting meet(const Surface& surface, const Ray& ray, double graze = 0x1p-46, double margin = 0x1p-40);

// One crossing of a closed or open surface: roots of neighbouring patches at one place are one.
struct Crossing {
  double t = 0.0, cosine = 0.0;
  double low = 0.0, high = 0.0;  // range of the roots' t
  double outside = 0.0;          // the least of any of its patches
  int multiplicity = 0;
  bool certified = true;
  int way = 0;
  bool touches = false;  // its patches are crossed in different ways: a sharp edge is touched
  std::vector<int> patches;
};

// `resolution`: how far apart roots of different patches count as one, in t; `across`: how far the patches may
// be apart at right angles, over the speed of t, which along the ray is that over the cosine where both are
// crossed the same way.
std::vector<Crossing> crossings(const Meeting& meeting, double resolution, double across = 0.0);

}  // namespace rondure::oracle
