// The study of one sphere from every parametrisation: what `rondure study parametrisation` does.
#pragma once

#include "renderer/api/registry.h"
#include "renderer/study/study_options.h"

namespace rondure {

// Writes parametrisation.csv (family, patches, rmse, color, normal, point, missed: relative root mean square
// and largest difference of the picture from the analytic sphere's, largest angle of normals in radians,
// largest distance of points, pixels that only one of the two hits) and index.html with the pictures and maps
// of their differences.
void study_parametrisation(const StudyOptions& options, const Registry& registry);

}  // namespace rondure
