#include "surfaces/iss_coefficients.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "renderer/bezier/triangle_keys.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

double positive(const Params& params, const Value& value, const std::string& name) {
  if (value.kind != Kind::number || !std::isfinite(value.number) || !(value.number > 0.0)) {
    params.fail(value, fmt::format("coefficient {} must be a positive number", name));
  }
  return value.number;
}

// Calls `read(place, value)` for every keyed member, each key once, and returns which places were given.
template <class Read>
std::vector<bool> read_keyed(const Params& params, const Value& value, int n, Read read) {
  std::vector<bool> given(static_cast<std::size_t>(triangle_size(n)), false);
  for (const Value::Member& member : value.members) {
    if (member.key == "rest") continue;
    Value key;
    key.where = member.where;
    const std::optional<std::size_t> place = triangle_key(n, member.key);
    if (!place) {
      params.fail(key,
                  fmt::format("\"{}\" is no index of degree {}: \"ijk\" or \"i,j,k\" with i + j + k = {}",
                              member.key, n, n));
    }
    if (given[*place]) params.fail(key, fmt::format("coefficient \"{}\" is given twice", member.key));
    given[*place] = true;
    read(*place, member);
  }
  return given;
}

std::string missing_key(const std::vector<bool>& given, int n, const Needed& needed) {
  for (int i = n; i >= 0; --i) {
    for (int j = n - i; j >= 0; --j) {
      if (!given[static_cast<std::size_t>(triangle_index(n, i, j))] && needed(i, j)) {
        return triangle_key_name(n, i, j);
      }
    }
  }
  return {};
}

}  // namespace

Needed all_needed() {
  return [](int, int) { return true; };
}

std::vector<double> read_coefficients(const Params& params, const Value& value, int n, const Needed& needed) {
  const auto size = static_cast<std::size_t>(triangle_size(n));
  if (value.kind == Kind::number) return std::vector<double>(size, positive(params, value, "for all"));
  if (value.kind != Kind::object) {
    params.fail(value, "coefficients are one number for all or an object with keys \"ijk\" and \"rest\"");
  }
  const Value* rest = value.find("rest");
  std::vector<double> c(size, rest ? positive(params, *rest, "\"rest\"") : 1.0);
  std::vector<bool> may(size, false);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) may[static_cast<std::size_t>(triangle_index(n, i, j))] = needed(i, j);
  }
  const std::vector<bool> given = read_keyed(params, value, n, [&](std::size_t at, const Value::Member& m) {
    if (!may[at]) params.fail(m.value, fmt::format("coefficient \"{}\" follows from the others here", m.key));
    c[at] = positive(params, m.value, fmt::format("\"{}\"", m.key));
  });
  const std::string missing = rest ? "" : missing_key(given, n, needed);
  if (!missing.empty()) {
    params.fail(value, fmt::format("coefficient \"{}\" is missing; \"rest\" would stand for it", missing));
  }
  return c;
}

std::vector<double> read_weights(Params& patch, int n, const std::vector<dvec3>& u, const Needed& needed) {
  const char* found = nullptr;
  for (const char* key : {"c", "radii", "weights"}) {
    if (!patch.has(key)) continue;
    if (found) patch.fail(key, fmt::format("give one of \"{}\" and \"{}\", not both", found, key));
    found = key;
  }
  std::vector<double> w(u.size(), 1.0);
  if (found) w = read_coefficients(patch, *patch.raw(found), n, needed);
  const std::string form = found ? found : "c";
  for (std::size_t k = 0; k < w.size(); ++k) {
    if (form == "radii") w[k] = glm::length(u[k]) / w[k];
    if (form == "c") w[k] *= glm::length(u[k]);
    if (!std::isfinite(w[k]) || !(w[k] > 0.0)) patch.fail(form, "a weight c |u| is out of a double's range");
  }
  return w;
}

std::vector<dvec3> read_vectors(const Params& patch, const Value& value, int n) {
  if (value.kind != Kind::object) patch.fail(value, "\"u\" is an object of vectors with keys \"ijk\"");
  std::vector<dvec3> u(static_cast<std::size_t>(triangle_size(n)), dvec3(0.0));
  const std::vector<bool> given = read_keyed(patch, value, n, [&](std::size_t at, const Value::Member& m) {
    bool good = m.value.kind == Kind::array && m.value.items.size() == 3;
    for (std::size_t k = 0; good && k < 3; ++k) {
      const Value& item = m.value.items[k];
      good = item.kind == Kind::number && std::isfinite(item.number);
      if (good) u[at][static_cast<int>(k)] = item.number;
    }
    if (!good || !(glm::length(u[at]) > 0.0) || !std::isfinite(glm::length(u[at]))) {
      patch.fail(m.value, fmt::format("vector \"{}\" must be three numbers, not all zero", m.key));
    }
  });
  if (const Value* rest = value.find("rest")) patch.fail(*rest, "\"rest\" has no meaning among vectors");
  const std::string missing = missing_key(given, n, all_needed());
  if (!missing.empty()) patch.fail(value, fmt::format("vector \"{}\" is missing", missing));
  return u;
}

}  // namespace rondure
