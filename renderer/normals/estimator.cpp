#include "renderer/normals/estimator.h"

#include <algorithm>

namespace rondure {

const std::vector<std::string>& estimator_names() {
  static const std::vector<std::string> names = {"limit", "cross",     "cross_float", "taylor",
                                                 "shift", "hodograph", "analytic"};
  return names;
}

std::string estimator_list() {
  std::string list;
  for (const std::string& name : estimator_names()) list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return list;
}

std::optional<NormalEstimator> estimator_named(const std::string& name) {
  const auto& names = estimator_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<NormalEstimator>(found - names.begin());
}

}  // namespace rondure
