// Boxes in space, and a ray's way from double precision into the single-precision traversal of them.
#pragma once

#include "renderer/intersect/embree_scene.h"
#include "renderer/intersect/local_ray.h"

namespace rondure {

// Where a ray enters a hierarchy, and how the traversal's t are the ray's: far = (t - far_origin) far_rate.
struct Entry {
  dvec3 origin{0.0};
  double far = 0.0;
  double far_origin = 0.0, far_rate = 1.0;

  // The traversal's t from the ray's, rounded up.
  float round_far(double t) const { return rondure::round_far((t - far_origin) * far_rate); }
};

class Hierarchy {
 public:
  // The boxes, about `center` (in a frame), of the leaves that `names` names. Throws std::runtime_error when
  // they are together too small or too large for products of coordinates to be doubles.
  Hierarchy(const dvec3& center, std::vector<Box> boxes, std::vector<LeafName> names,
            EmbreeScene::Visitor visitor);

  // Where the ray, `local` in the frame, enters the bounding sphere. False when it misses it within [t_min,
  // t_max].
  bool enter(const LocalRay& local, double t_min, double t_max, Entry& entry) const;
  // The same of a ray that is local about the centre.
  bool enter_at_center(const LocalRay& local, double t_min, double t_max, Entry& entry) const {
    return enter(local, local.base * unit_, local.slide * unit_, t_min, t_max, entry);
  }
  void visit_all(const LocalRay& local, const Entry& entry, void* query) const noexcept {
    embree_->visit_all(entry.origin, local.direction, entry.far, query);
  }
  bool visit_any(const LocalRay& local, const Entry& entry, void* query) const noexcept {
    return embree_->visit_any(entry.origin, local.direction, entry.far, query);
  }

  std::size_t packet_width() const { return embree_->width(); }
  void visit_packet(const EmbreeScene::Packet& packet, EmbreeScene::PacketVisitor visitor,
                    void* query) const noexcept {
    embree_->visit_packet(packet, visitor, query);
  }

  dvec3 center() const { return center_; }
  double radius() const { return radius_; }
  // What the traversal's lengths are multiplied by.
  double unit() const { return unit_; }
  std::size_t bytes() const { return embree_->bytes(); }

 private:
  dvec3 center_{0.0};
  double radius_ = 0.0;
  // Power of two that brings the radius to [1, 2): what the traversal sees.
  double unit_ = 1.0, inverse_unit_ = 1.0;
  std::unique_ptr<EmbreeScene> embree_;

  // `base`: the point of the ray nearest to the centre, and `slide` its t, in units of the traversal.
  bool enter(const LocalRay& local, dvec3 base, double slide, double t_min, double t_max, Entry& entry) const;
};

}  // namespace rondure
