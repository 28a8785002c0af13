// Coefficients of inverse spherical surfaces as scenes give them.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "renderer/api/params.h"

namespace rondure {

// Which coefficients (i, j) a construction needs; the others follow from it and may not be given.
using Needed = std::function<bool(int i, int j)>;
Needed all_needed();

// Positive numbers in triangle_index order: one number for all, or an object keyed "ijk" in which "rest"
// stands for the keys that are not there. Coefficients that are not needed come out as 1.
std::vector<double> read_coefficients(const Params& params, const Value& value, int n, const Needed& needed);

// The weights w_ijk of one patch from "c", "radii" (1 / c) or "weights", of which at most one may be given,
// and none stands for c = 1. `u` are the vectors that c refers to.
std::vector<double> read_weights(Params& patch, int n, const std::vector<dvec3>& u, const Needed& needed);

// Vectors keyed "ijk", all of them, none of them zero.
std::vector<dvec3> read_vectors(const Params& patch, const Value& value, int n);

}  // namespace rondure
