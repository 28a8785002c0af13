// Nets in projective 3-space as scenes write them.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/projective/preimage.h"

namespace rondure {

// The array `key` of nets with control points [p0, p1, p2, p3]. Refuses those with base points, where the
// image under delta (or, `ruled`, under ruled_image) is no point, and names them.
std::vector<Preimage> read_preimages(Params& params, std::string_view key, bool ruled);

// `fallback` is empty where the key is required.
ParameterDoc preimages_doc(const char* key, const char* fallback = "");

}  // namespace rondure
