#include "renderer/study/study_options.h"

#include <fmt/format.h>

#include <stdexcept>

#include "renderer/render/interrupt.h"

namespace rondure {

void stop_if_interrupted(Progress& progress, const StudyFolder& folder) {
  if (!interrupted()) return;
  progress.clear();
  throw std::runtime_error(
      fmt::format("interrupted; what is done is kept in {}, and the same command goes on", folder.path("")));
}

}  // namespace rondure
