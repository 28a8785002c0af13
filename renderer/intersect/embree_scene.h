// Embree behind a narrow door: boxes go in, candidate leaves come out. Nothing else includes Embree's
// headers.
//
// Why a single-precision traversal cannot lose a double-precision hit. All positions are taken about the
// scene's centre, and a ray enters at the scene's bounding sphere of radius r (both in double), so every
// coordinate in play is at most 2 r. Per axis, in units of 2^-24 r: rounding the origin costs 2 (|o| <= 2r,
// half an ulp); rounding the direction bends the ray by 2^-24 of the way, 2 at the far side; Embree's slab
// test, one subtraction and one product with a reciprocal good to 3 ulp, misplaces a plane by at most 5 2^-24
// of the distance along the ray, 10. Boxes are padded by 2^-19 r, 32 of these units, and then rounded
// outward. Entry and exit are compared with tfar rounded up by the same relative amount.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/bezier/box.h"

namespace rondure {

// A leaf of a surface. `whole`: all of the surface, which has a hierarchy of its own; `cluster`: all of it,
// as a cluster of leaves; `sphere`: all of it, being a sphere.
struct LeafName {
  static constexpr unsigned whole = ~0u, sphere = ~1u, cluster = ~2u;
  unsigned surface, leaf;
};

class EmbreeScene {
 public:
  // Called for each leaf whose box the ray may meet. Sees `query` as it was given, and lowers `far`
  // (single-precision t, same units as the traversal's direction) to narrow the search. Returning true ends
  // an occlusion query.
  using Visitor = bool (*)(void* query, unsigned surface, unsigned leaf, float& far) noexcept;

  // Rays that are met together; valid[k] is -1, or 0 where there is none. As for one ray otherwise.
  static constexpr std::size_t packet_width = 16;
  struct Packet {
    alignas(64) float origin[3][packet_width], direction[3][packet_width], far[packet_width];
    alignas(64) int valid[packet_width];
  };
  // `valid` and `far` are of `count` rays from the packet's ray `first` on.
  using PacketVisitor = void (*)(void* query, unsigned surface, unsigned leaf, std::size_t first,
                                 std::size_t count, const int* valid, float* far) noexcept;

  // boxes[k] bounds the leaf names[k], in double, about the scene's centre; every corner is within `radius`
  // of it. `settings` are Embree's own, such as "isa=avx2". Throws std::runtime_error when it cannot.
  EmbreeScene(const std::vector<Box>& boxes, std::vector<LeafName> names, double radius, Visitor visitor,
              const char* settings = "");
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Origin within twice the radius of the centre; far >= 0. Never throws; non-finite rays must not come here
  // (Embree aborts the process on them).
  void visit_all(const dvec3& origin, const dvec3& direction, double far, void* query) const noexcept;
  bool visit_any(const dvec3& origin, const dvec3& direction, double far, void* query) const noexcept;

  // How many of a packet's rays the machine traverses together: 16, 8, 4, or 0 where it cannot.
  std::size_t width() const;
  // The closest hits; `far` is rounded up already.
  void visit_packet(const Packet& packet, PacketVisitor visitor, void* query) const noexcept;

  std::size_t bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// The smallest float that is not below `t`, plus the traversal's own error.
float round_far(double t);

}  // namespace rondure
