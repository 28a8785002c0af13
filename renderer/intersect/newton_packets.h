// Rays that go much the same way, met with the leaves of nets in lanes: the hits that `newton` finds for each
// alone, to the last bit.
#pragma once

#include <cstddef>

#include "renderer/intersect/query.h"

namespace rondure {

inline constexpr std::size_t most_in_packet = EmbreeScene::packet_width;

// What rays are met with.
struct PacketTarget {
  const PlacedSurface* surfaces;
  const Hierarchy* hierarchy;
  bool one_frame;  // the origins are all at the hierarchy's centre
  double spread;   // how far apart, in the scene's radii, rays may enter that still meet the same leaves
  double doubt;    // how many errors of t hits may be apart that are tied; 0 where there is one surface
};

// Whether the surface is one of nets with leaves of its own, as all must be that are met so.
bool can_meet_packets(const PlacedSurface& surface);

// A ray that is to be met alone, from where it enters the hierarchy.
struct PreparedRay {
  LocalRay local;  // about the hierarchy's centre; in a scene of several frames without its base
  Entry entry;
};

enum class PacketAnswer : unsigned char { unknown, prepared, done };

// Hits of up to `most_in_packet` rays, of those whose answer is `done`. The others are still to be found: of
// all rays where they go apart, and of such as graze a leaf, start on a surface or are otherwise out of the
// ordinary. Where the answer is `prepared`, so is what is needed to meet them alone.
void closest_in_packet(const PacketTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                       PreparedRay* prepared, PacketAnswer* answers) noexcept;

}  // namespace rondure
