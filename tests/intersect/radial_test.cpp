// The solver in one unknown against Newton and clipping, and against the surface as a function of direction.
#include "renderer/intersect/radial.h"

#include <fmt/core.h>

#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/random_direction.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

struct Model {
  const char* name;
  const char* object;
  bool closed, smooth;
};

constexpr const char* octahedron =
    R"({"type": "iss", "degree": 2, "vertices": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]], "patches": [
  {"triangle": [0,2,4]}, {"triangle": [1,2,4]}, {"triangle": [0,3,4]}, {"triangle": [1,3,4]},
  {"triangle": [0,2,5]}, {"triangle": [1,2,5]}, {"triangle": [0,3,5]}, {"triangle": [1,3,5]}]})";

constexpr Model models[] = {
    {"pebble", R"({"type": "iss", "octants": {"degree": 3, "interior": 1}})", true, true},
    {"rounded tetrahedron", R"({"type": "iss", "octants": {"degree": 3,
      "interior": [0.25, 1.75, 1.75, 0.25, 1.75, 0.25, 0.25, 1.75]}})",
     true, true},
    {"pear",
     R"({"type": "iss", "octants": {"degree": 4, "interior": [{"112": 0.4, "rest": 0.6}, 0.6, 0.6, 0.6,
      {"112": 1.4, "rest": 1.1}, 1.1, 1.1, 1.1]}})",
     true, true},
    {"raspberry", R"({"type": "iss", "octants": {"degree": 6,
      "interior": {"411": 0.7, "141": 0.7, "114": 0.7, "222": 0.12, "rest": 0.35}}})",
     true, true},
    {"degree 9", R"({"type": "iss", "octants": {"degree": 9, "interior": 0.8}})", true, true},
    {"creased octahedron", octahedron, true, false},
    {"plane triangle", R"({"type": "iss", "degree": 1})", false, true},
    {"long domain", R"({"type": "iss", "degree": 5, "vertices": [[7,0,0],[1,0.8,0],[0.2,0.3,1]],
      "patches": [{"triangle": [0,1,2], "c": {"311": 0.2, "113": 4, "rest": 1}}]})",
     false, true},
    {"fan",
     R"({"type": "iss", "fan": {"sides": 5, "degree": 4, "weights": {"400": 0.7, "022": 1.4, "rest": 1}}})",
     false, true},
};

double size_of(const Surface& surface) {
  double size = 0.0;
  for (const Net& net : surface.patches)
    for (const double u : {0.0, 0.3, 1.0})
      for (const double v : {0.0, 0.3, 1.0})
        if (u + v <= 1.0) size = std::max(size, glm::length(net_point(net, u, v)));
  return size;
}

// Rays at everything, and at edges, corners and the lines between pieces, some of them touching the surface.
Ray make_ray(const Surface& surface, double size, std::mt19937_64& random) {
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const auto pick = [&](int count) { return static_cast<int>(count * draw()); };
  const Net& net = surface.patches[static_cast<std::size_t>(pick(static_cast<int>(surface.patches.size())))];
  double u = draw(), v = draw();
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  const int where = pick(6);
  if (where == 1) v = 0.0;
  if (where == 2) v = 1.0 - u;
  if (where == 3) u = pick(3) == 0 ? 1.0 : 0.0, v = u == 1.0 ? 0.0 : pick(2);
  if (where == 4) u = 0.25 * pick(4), v = (1.0 - u) * (pick(2) == 0 ? draw() : 0.5);
  const dvec3 target = net_point(net, u, v), normal = unit_normal(net, u, v);
  dvec3 d = random_direction(random);
  const int how = pick(4);
  if (how == 0)
    d = glm::normalize(d - glm::dot(d, normal) * normal + std::pow(10.0, -2.0 - 14.0 * draw()) * normal);
  double distance = size * (0.1 + 4.0 * draw());
  if (how == 1) distance = 1e6 * size;
  if (how == 2) d = glm::normalize(target), distance = glm::length(target);  // from the centre
  const double length = std::exp2(pick(20) - 10);
  return {target - distance * d, length * d};
}

// Where rounding may decide: within 16 ulps of tangency, at a radius of curvature down to 1/50 of the size,
// the cosine is below sqrt(2 * 16 * 2^-53 * 50) = 4e-7; at the rim of an open surface the ray passes within
// an ulp over the cosine.
bool undecided(const Hit& hit, const Ray& ray, bool seamless) {
  const double cosine = std::fabs(glm::dot(hit.normal, ray.direction)) / glm::length(ray.direction);
  const double rim = std::min({hit.u, hit.v, 1.0 - hit.u - hit.v});
  return cosine < 5e-7 || (!seamless && rim * cosine < 64.0 * 0x1p-53);
}

struct Tally {
  WorstCase t;
  long rays = 0, hits = 0, several = 0, tangential = 0, wrong = 0, not_nearest = 0;
  std::string first = "none";
};

void compare(const Surface& surface, const Tracer& radial, const Tracer& other, int count, std::uint64_t seed,
             bool seamless, Tally& tally) {
  std::mt19937_64 random(seed);
  const double size = size_of(surface);
  for (int k = 0; k < count; ++k) {
    Ray ray = make_ray(surface, size, random);
    ray.origin += surface.origin;
    const std::vector<Hit> a = radial.all(ray), b = other.all(ray);
    ++tally.rays, tally.hits += static_cast<long>(a.size()), tally.several += a.size() > 2;
    const auto describe = [&] {
      return fmt::format("o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} and {} hits",
                         ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                         ray.direction.z, a.size(), b.size());
    };
    std::size_t i = 0, j = 0;
    bool tangential = false, wrong = false;
    while (i < a.size() || j < b.size()) {
      const bool both = i < a.size() && j < b.size();
      if (both && std::fabs(a[i].t - b[j].t) <= a[i].t_error + b[j].t_error) {
        tally.t.add(std::fabs(a[i].t - b[j].t), a[i].t_error + b[j].t_error, describe);
        ++i, ++j;
        continue;
      }
      const bool alone_in_a = j == b.size() || (both && a[i].t < b[j].t);
      const Hit& alone = alone_in_a ? a[i++] : b[j++];
      // Nor is a hit told from one beside it that rounding decides: at a crease, of another patch.
      bool open = false;
      for (const std::vector<Hit>* hits : {&a, &b})
        for (const Hit& hit : *hits)
          open = open ||
                 (std::fabs(hit.t - alone.t) <= hit.t_error + alone.t_error && undecided(hit, ray, seamless));
      (open ? tangential : wrong) = true;
    }
    tally.tangential += tangential;
    if (wrong && tally.wrong++ == 0) tally.first = describe();
    bool sure = true;
    for (const Hit& hit : a) sure = sure && !undecided(hit, ray, seamless);
    if (!sure) continue;
    const Hit nearest = radial.closest(ray);
    if (static_cast<bool>(nearest) == a.empty() || (nearest && nearest.t > a[0].t + a[0].t_error))
      ++tally.not_nearest;
    if (radial.occluded(ray) == a.empty()) ++tally.not_nearest;
  }
}

int soak(int count) { return static_cast<int>(soaked(count, 50.0 * count)); }

}  // namespace

TEST_CASE("Planar domains have a radial form, wherever they are placed, and nothing else has", "[radial]") {
  std::mt19937_64 random(1);
  int without = 0, with = 0;
  for (const Model& model : models) {
    for (const Net& net : build_family(model.object).patches) {
      without += !has_radial_form(net);
      dmat4 map(1.0);
      for (int k = 0; k < 3; ++k) map[k] = dvec4(random_direction(random) * 1e-4, 0.0);
      const bool sound = std::fabs(glm::dot(dvec3(map[0]), glm::cross(dvec3(map[1]), dvec3(map[2])))) > 1e-13;
      without += sound && !has_radial_form(transformed(net, map));
      map[3] = dvec4(0.1, 0.2, 0.3, 1.0);  // the origin is no longer where the domain is seen from
      with += std::get<TriangleNet>(net).n > 1 && has_radial_form(transformed(net, map));
    }
  }
  for (const char* object :
       {R"({"type": "sphere_tiling"})", R"({"type": "iss", "patches": [{"sphere": [0,1,2]}]})",
        R"({"type": "iss", "form": "quadrilaterals"})"})
    for (const Net& net : build_family(object).patches) with += has_radial_form(net);
  CHECK(without == 0);
  CHECK(with == 0);
}

TEST_CASE("The radial solver finds the hits of Newton and of clipping, and no other", "[radial][hits]") {
  for (const Model& model : models) {
    Surface surface = build_family(model.object);
    const bool seamless = model.closed && model.smooth;
    const Tracer radial({{surface, Solver::radial}});
    Tally newton, clipping;
    compare(surface, radial, Tracer({{surface, Solver::newton}}), soak(4000), 2, seamless, newton);
    compare(surface, radial, Tracer({{surface, Solver::clipping}}), soak(600), 3, seamless, clipping);
    // Turned, stretched by 3, 1/2 and 1, made small, and far from the origin.
    const dmat4 map(0.6e-3, 0.8e-3, 0, 0, -2.4e-3, 1.8e-3, 0, 0, 0, 0, 0.5e-3, 0, 0, 0, 0, 1);
    for (Net& net : surface.patches) net = transformed(net, map);
    surface.origin = dvec3(0.3, -2.0, 1.0);
    Tally placed;
    compare(surface, Tracer({{surface, Solver::radial}}), Tracer({{surface, Solver::newton}}), soak(1500), 4,
            seamless, placed);
    for (const Tally* tally : {&newton, &clipping, &placed}) {
      INFO(model.name << ": " << tally->rays << " rays, " << tally->hits << " hits, " << tally->several
                      << " rays with more than two, " << tally->tangential << " undecided by rounding, t "
                      << tally->t.text() << ", wrong " << tally->first);
      CHECK(tally->wrong == 0);
      CHECK(tally->not_nearest == 0);
      CHECK(tally->t.failures() == 0);
      CHECK(tally->hits > tally->rays / 2);
      // A quarter is aimed along the surface, of which a half closer than 10^-9; most of those meet it all
      // the same.
      CHECK(tally->tangential < tally->rays / 6);
    }
  }
}

TEST_CASE("A closed model is met exactly once from its centre, at edges and corners too", "[radial][hits]") {
  std::mt19937_64 random(7);
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  for (const Model& model : models) {
    if (!model.closed) continue;
    const Surface surface = build_family(model.object);
    // And one in which every other patch is met by Newton's method, as three tensor-product patches.
    Surface mixed = surface;
    mixed.patches.clear();
    for (std::size_t k = 0; k < 8; ++k) {
      const auto& net = std::get<TriangleNet>(surface.patches[k]);
      if ((k == 0) || (k == 3) || (k == 5) || (k == 6)) {
        mixed.patches.emplace_back(net);
        continue;
      }
      for (const TensorNet& part : as_three_tensors(net)) mixed.patches.emplace_back(part);
    }
    const Tracer whole({{surface, Solver::radial}}), seams({{mixed, Solver::radial}});
    long wrong = 0, leaks = 0;
    for (int k = 0; k < soak(6000); ++k) {
      dvec3 d = random_direction(random);
      // To the sides and the corners of the octants, to their quarters, and as close to them as doubles go.
      if (k % 3 == 0) d[k / 3 % 3] = k % 2 == 0 ? 0.0 : std::pow(10.0, -17.0 * draw());
      if (k % 7 == 0) d[k / 7 % 3] = d[(k / 7 + 1) % 3];
      if (k % 50 == 0) d = dvec3(k % 100 == 0, k % 150 == 0, 1.0);
      wrong += whole.all({dvec3(0.0), d}).size() != 1;
      wrong += seams.all({dvec3(0.0), d}).size() != 1;
      // From another point inside there is a way out, through whatever edge.
      const dvec3 origin = 0.05 * random_direction(random), target = whole.closest({dvec3(0.0), d}).point;
      leaks += !whole.occluded({origin, target - origin}) + !seams.occluded({origin, target - origin});
    }
    INFO(model.name);
    CHECK(wrong == 0);
    CHECK(leaks == 0);
  }
}

TEST_CASE("A ray in a plane patch has no isolated hit", "[radial][hits]") {
  const Tracer plane({{build_family(R"({"type": "iss", "degree": 1})"), Solver::radial}});
  // x + y + z = 1 along (1, -1, 0), whose coordinates stay exact; between pieces, and through them.
  for (const double z : {0.5, 0.375}) {
    CHECK(plane.all({dvec3(-1.0, 2.0 - z, z), dvec3(1.0, -1.0, 0.0)}).empty());
    CHECK(plane.all({dvec3(0.25, 0.75 - z, z) - dvec3(2.0, -2.0, 2e-3), dvec3(1.0, -1.0, 1e-3)}).size() == 1);
  }
}

// In a plane where patches meet, both roots near a vertex, one in the patches before it and one behind it:
// in each the polynomial ends between the two, in noise.
TEST_CASE("A ray in the plane of a seam meets both walls beneath a vertex", "[radial][hits]") {
  std::mt19937_64 random(12);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const int aimed = static_cast<int>(soaked(10'000, 1'000'000));
  int wrong = 0;
  std::string worst = "none";
  for (const Model& model : {models[0], models[1], models[2]}) {
    const Tracer tracer({{build_family(model.object), Solver::radial}});
    const std::vector<Net>& nets = tracer.surfaces()[0].surface.patches;
    const double band = tangency_band(tracer.surfaces()[0].surface, 1.0);
    for (int k = 0; k < aimed; ++k) {
      constexpr dvec2 corners[3] = {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}};
      const dvec2 at = corners[random() % 3];
      const dvec3 vertex = net_point(nets[random() % nets.size()], at.x, at.y);
      // An axis across the vertex's own.
      const int own = std::fabs(vertex.x) > 0.5 * largest(vertex)   ? 0
                      : std::fabs(vertex.y) > 0.5 * largest(vertex) ? 1
                                                                    : 2;
      dvec3 along(0.0);
      along[(own + 1 + static_cast<int>(random() % 2)) % 3] = random() % 2 ? 1.0 : -1.0;
      const double depth = std::pow(10.0, draw(std::log10(10.0 * band), -9.0));
      const dvec3 direction = along + std::pow(10.0, draw(-17.0, -10.0)) * vertex;
      const Ray ray{(1.0 - depth) * vertex - draw(1.0, 9.0) * direction, direction};
      const std::vector<Hit> hits = tracer.all(ray);
      const Hit closest = tracer.closest(ray);
      if (hits.size() == 2 && closest.t == hits[0].t && tracer.occluded(ray)) continue;
      ++wrong;
      worst = fmt::format(
          "{}, depth {:.3g}: {} hits, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})",
          model.name, depth, hits.size(), ray.origin.x, ray.origin.y, ray.origin.z, direction.x, direction.y,
          direction.z);
    }
  }
  INFO(wrong << " of " << 3 * aimed << " rays are met wrongly; the last: " << worst);
  CHECK(wrong == 0);
}

}  // namespace rondure
