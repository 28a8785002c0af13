// The ray cases of tests/data/rays, computed at 50 digits: nets of the four papers' tilings and single
// patches.

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;
using Json = nlohmann::json;

namespace {

dvec3 vector_of(const Json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

struct Totals {
  long rays = 0, hits = 0, ambiguous = 0, wrong = 0;
  std::string worst = "none";
  WorstCase t, point, parameter;
};

void check_file(const std::filesystem::path& path, Solver solver, Totals& totals) {
  std::ifstream stream(path);
  const Json data = Json::parse(stream);
  const Tracer tracer({{build_family(data["object"].dump()), solver}});
  for (const Json& ray : data["rays"]) {
    ++totals.rays;
    const dvec3 direction = vector_of(ray["direction"]);
    const std::vector<Hit> hits = tracer.all({vector_of(ray["origin"]), direction});
    const auto describe = [&] { return path.filename().string() + " " + ray.dump().substr(0, 200); };
    if (hits.size() != ray["hits"].size()) {
      // Where the file says that rounding decides, any count is right that keeps each hit near one of those
      // listed.
      if (ray["ambiguous"].empty())
        ++totals.wrong, totals.worst = describe();
      else
        ++totals.ambiguous;
      continue;
    }
    totals.hits += static_cast<long>(hits.size());
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const Json& expected = ray["hits"][k];
      const double cosine = std::fabs(glm::dot(hits[k].normal, direction)) / glm::length(direction);
      // 8 ulp on the surface, as in sphere_hits_test; along the ray that is stretched by 1 / cos, at a double
      // root to its square root: 2 sqrt(8 ulp).
      const double stretch = std::fmin(quotient(8.0 * 0x1p-52, cosine), 2.0 * std::sqrt(8.0 * 0x1p-52));
      const double t = expected["t"].get<double>();
      totals.t.add(std::fabs(hits[k].t - t), stretch / glm::length(direction) + 8.0 * 0x1p-52 * std::fabs(t),
                   describe);
      totals.point.add(glm::distance(hits[k].point, vector_of(expected["point"])), stretch + 8.0 * 0x1p-52,
                       describe);
      // On the seam any owner may report; inside a patch it must be the one, at its parameters.
      const Json& owners = expected["owners"];
      bool owned = false;
      double off = 1.0;
      for (const Json& owner : owners) {
        if (owner["patch"].get<int>() != hits[k].patch) continue;
        owned = true;
        const bool free_u = owner["u"].is_null(), free_v = owner["v"].is_null();
        off = std::fmax(free_u ? 0.0 : std::fabs(owner["u"].get<double>() - hits[k].u),
                        free_v ? 0.0 : std::fabs(owner["v"].get<double>() - hits[k].v));
        // Speeds are of the order of 1. At singular corners the surface moves with the square of the
        // parameters, and a tangential ray leaves it with the square of that: 16 ulps become sqrt and fourth
        // root, 6e-8 and 2.4e-4.
        const bool singular = owner["kind"] == "singular-corner",
                   tangent = expected["multiplicity"].get<int>() > 1;
        totals.parameter.add(off, singular ? (tangent ? 1e-3 : 1e-6) : 8.0 * stretch + 64.0 * 0x1p-52,
                             describe);
      }
      if (!owned) ++totals.wrong, totals.worst = describe();
    }
  }
}

}  // namespace

TEST_CASE("The reference's ray cases come out as they should", "[hits]") {
  Totals totals;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() + "/tests/data/rays")) {
    ++files;
    for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric})
      check_file(entry.path(), solver, totals);
  }
  INFO(files << " files, " << totals.rays << " rays, " << totals.hits << " hits, " << totals.ambiguous
             << " decided by rounding");
  INFO("wrong: " << totals.worst);
  INFO("t: " << totals.t.text());
  INFO("point: " << totals.point.text());
  INFO("parameters: " << totals.parameter.text());
  CHECK(files == 48);
  CHECK(totals.wrong == 0);
  CHECK(totals.t.failures() == 0);
  CHECK(totals.point.failures() == 0);
  CHECK(totals.parameter.failures() == 0);
  CHECK(totals.hits > 600);
  CHECK(totals.ambiguous < totals.rays / 5);
}
