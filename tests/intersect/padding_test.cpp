// The padding of the hierarchy's boxes, by itself: every box that a ray meets in extended precision must be
// offered by the single-precision traversal, whichever instructions and nodes Embree uses, and whatever the
// query does with them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <set>

#include "renderer/intersect/embree_scene.h"
#include "tests/catch.h"
#include "tests/intersect/random_direction.h"

using namespace rondure;

namespace {

struct Probe {
  dvec3 origin, direction;
  double far;
};

// Closed slabs; the last bit of 64 is a millionth of the padding. Where the ray enters the box, if it does.
std::optional<long double> entry_of(const Probe& ray, const Box& box) {
  long double enter = 0, leave = ray.far;
  for (int k = 0; k < 3; ++k) {
    const long double o = ray.origin[k], d = ray.direction[k];
    if (d == 0) {
      if (o < box.low[k] || o > box.high[k]) return {};
      continue;
    }
    const long double a = (box.low[k] - o) / d, b = (box.high[k] - o) / d;
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return {};
  return enter;
}

// What a query is told of, and what it answers.
struct Visit {
  enum Kind { look, narrow, stop } kind;
  const Probe* ray;
  const std::vector<Box>* boxes;
  std::set<unsigned> seen{};
  long double nearest = INFINITY;  // of the boxes that are truly met
};

// Looks on; or narrows the search to before where the ray enters the box, as the closest hit does; or stops
// at the first box that is truly met, as the test of a shadow does.
bool remember(void* query, unsigned, unsigned leaf, float& far) noexcept {
  Visit& visit = *static_cast<Visit*>(query);
  visit.seen.insert(leaf);
  if (visit.kind == Visit::look) return false;
  const auto entry = entry_of(*visit.ray, (*visit.boxes)[leaf]);
  if (!entry) return false;
  visit.nearest = std::min(visit.nearest, *entry);
  if (visit.kind == Visit::narrow) far = std::min(far, round_far(static_cast<double>(*entry)));
  return visit.kind == Visit::stop;
}

class Layouts {
 public:
  double draw(double low = 0.0, double high = 1.0) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double decade(double low, double high) { return std::pow(10.0, draw(low, high)); }
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

  // Boxes within the unit sphere: points, needles, plates and bricks, of sizes from 10^-18, spread all over
  // or crowded at a place near the rim, where a float is coarsest.
  std::vector<Box> boxes(std::size_t count) {
    const dvec3 crowd = 0.9 * random_direction(random_);
    const double spread = draw() < 0.5 ? 0.9 : decade(-7.0, -1.0);
    std::vector<Box> out;
    for (std::size_t k = 0; k < count; ++k) {
      const dvec3 at = spread < 0.9 ? crowd + spread * 0.05 * random_direction(random_) * draw()
                                    : 0.9 * std::cbrt(draw()) * random_direction(random_);
      dvec3 half(0.0);
      const auto kind = below(4);
      for (std::size_t j = 0; j < kind; ++j) half[static_cast<int>((j + k) % 3)] = decade(-18.0, -1.3);
      out.push_back({at - half, at + half});
    }
    return out;
  }

  // Towards a box's corner, edge, face or inside, from the sphere's rim or from within, in any direction,
  // along an axis, or nearly so; from twice the radius at most.
  Probe probe(const std::vector<Box>& boxes) {
    const Box& box = boxes[below(boxes.size())];
    dvec3 target;
    for (int k = 0; k < 3; ++k) {
      const double part = below(2) == 0 ? std::floor(2.0 * draw()) : draw();
      target[k] = box.low[k] + part * (box.high[k] - box.low[k]);
      if (part == 1.0) target[k] = box.high[k];
    }
    Probe out;
    dvec3 d = random_direction(random_);
    const auto sort = below(4);
    if (sort > 0) {
      const int axis = static_cast<int>(below(3));
      for (int k = 0; k < 3; ++k)
        if (k != axis)
          d[k] = sort == 1 ? 0.0 : sort == 2 ? d[k] * decade(-16.0, -3.0) : (below(2) == 0 ? 0.0 : d[k]);
      if (d == dvec3(0.0)) d[axis] = 1.0;
    }
    out.direction = d * (1.0 + draw());
    const double back = below(3) == 0 ? decade(-12.0, 0.0) : 1.1 / glm::length(out.direction);
    out.origin = target - back * out.direction;
    // To just past the target, or all the way.
    out.far = below(2) == 0 ? back * (1.0 + 0x1p-50) : 4.0;
    return out;
  }

 private:
  std::mt19937_64 random_{29};
};

}  // namespace

namespace {

struct Count {
  long met = 0, lost = 0, offered = 0, nearest_lost = 0, shadows_wrong = 0, packets = 0, lost_in_packets = 0;
  std::string worst = "none";
};

void probe(const EmbreeScene& scene, const std::vector<Box>& boxes, const Probe& ray, Count& count) {
  const auto describe = [&] {
    count.worst = fmt::format("o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}), far {:.17g}",
                              ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                              ray.direction.z, ray.far);
  };
  Visit all{Visit::look, &ray, &boxes}, any = all, closest{Visit::narrow, &ray, &boxes},
                                        shadow{Visit::stop, &ray, &boxes};
  scene.visit_all(ray.origin, ray.direction, ray.far, &all);
  const bool stopped = scene.visit_any(ray.origin, ray.direction, ray.far, &any);
  scene.visit_all(ray.origin, ray.direction, ray.far, &closest);
  const bool occluded = scene.visit_any(ray.origin, ray.direction, ray.far, &shadow);
  count.offered += static_cast<long>(all.seen.size());
  long double nearest = INFINITY;
  for (unsigned b = 0; b < boxes.size(); ++b) {
    const auto entry = entry_of(ray, boxes[b]);
    if (!entry) continue;
    ++count.met;
    nearest = std::min(nearest, *entry);
    if (all.seen.count(b) != 0 && any.seen.count(b) != 0) continue;
    ++count.lost, describe();
  }
  if (closest.nearest != nearest) ++count.nearest_lost, describe();
  if (stopped || occluded != (nearest < INFINITY)) ++count.shadows_wrong, describe();
}

using Seen = std::array<std::set<unsigned>, EmbreeScene::packet_width>;

void remember_packet(void* query, unsigned, unsigned leaf, std::size_t first, std::size_t count,
                     const int* valid, float*) noexcept {
  for (std::size_t k = 0; k < count; ++k)
    if (valid[k] != 0) (*static_cast<Seen*>(query))[first + k].insert(leaf);
}

// The same rays together, but for some.
void probe_packet(const EmbreeScene& scene, const std::vector<Box>& boxes, const std::vector<Probe>& rays,
                  Count& count) {
  if (scene.width() == 0) return;
  ++count.packets;
  EmbreeScene::Packet packet;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = static_cast<int>(c);
      packet.origin[c][k] = static_cast<float>(rays[k].origin[axis]);
      packet.direction[c][k] = static_cast<float>(rays[k].direction[axis]);
    }
    packet.far[k] = round_far(rays[k].far), packet.valid[k] = k % 7 == 4 ? 0 : -1;
  }
  Seen seen;
  scene.visit_packet(packet, remember_packet, &seen);
  for (std::size_t k = 0; k < rays.size(); ++k)
    for (unsigned b = 0; b < boxes.size(); ++b)
      if (packet.valid[k] == 0 ? seen[k].count(b) != 0 : entry_of(rays[k], boxes[b]) && seen[k].count(b) == 0)
        ++count.lost_in_packets;
}

}  // namespace

TEST_CASE("The padding covers every rounding of the traversal, with each instruction set and hierarchy",
          "[hits]") {
  constexpr int scenes = 40, rays = 160;
  std::set<std::string> tried;
  for (const char* instructions : {"", "isa=sse2", "isa=sse4.2", "isa=avx", "isa=avx2", "isa=avx512"})
    // Nodes of four boxes, or of eight, which need AVX.
    for (const char* hierarchy : {"", "object_accel=bvh4.object", "object_accel=bvh8.object"}) {
      const std::string settings =
          fmt::format("{}{}{}", instructions, *instructions && *hierarchy ? "," : "", hierarchy);
      Layouts layouts;
      Count count;
      bool available = true;
      for (int s = 0; s < scenes && available; ++s) {
        const std::vector<Box> boxes = layouts.boxes(1 + 20 * static_cast<std::size_t>(s));
        std::vector<LeafName> names;
        for (unsigned b = 0; b < boxes.size(); ++b) names.push_back({0, b});
        try {
          const EmbreeScene scene(boxes, names, 1.0, remember, settings.c_str());
          std::vector<Probe> together;
          for (int k = 0; k < rays; ++k) {
            // Some packets are of one ray and what is near it, to either side of a plane.
            Probe next = layouts.probe(boxes);
            if (!together.empty() && k / 16 % 2 == 0) {
              next = together.front();
              next.origin += 1e-3 * layouts.draw() * next.direction;
              const int axis = static_cast<int>(layouts.below(3));
              if (std::fabs(next.direction[axis]) < 0.5)
                next.direction[axis] = layouts.decade(-25.0, -2.0) * (layouts.below(2) == 0 ? -1.0 : 1.0);
            }
            probe(scene, boxes, next, count);
            together.push_back(next);
            if (together.size() < EmbreeScene::packet_width) continue;
            probe_packet(scene, boxes, together, count);
            together.clear();
          }
        } catch (const std::runtime_error&) {
          available = false;  // not on this processor, or not of this width
        }
      }
      if (!available) continue;
      tried.insert(settings);
      INFO(settings << ": " << count.met << " boxes met, " << count.offered << " offered, " << count.lost
                    << " lost, " << count.nearest_lost << " times the nearest, " << count.shadows_wrong
                    << " shadows wrong, " << count.lost_in_packets << " lost in " << count.packets
                    << " packets: " << count.worst);
      CHECK(count.lost == 0);
      CHECK(count.nearest_lost == 0);
      CHECK(count.shadows_wrong == 0);
      CHECK(count.lost_in_packets == 0);
      CHECK(count.met > scenes * rays / 2);
      // The traversal does look: most boxes of a scene are not offered.
      CHECK(count.offered < 400L * scenes * rays / 4);
    }
  INFO(fmt::format("{}", fmt::join(tried, "; ")));
  CHECK(tried.size() >= 4);
  // Nodes of four are to be had everywhere.
  CHECK(tried.count("object_accel=bvh4.object") == 1);
}
