#include "renderer/intersect/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "renderer/parallel/handover.h"

namespace rondure {
namespace {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
#else
using EmbreeContext = RTCIntersectContext;
#endif

// Embree hands the context to the callbacks; what follows it in memory is ours.
struct QueryContext {
  EmbreeContext base;
  void* query;
  EmbreeScene::PacketVisitor packet_visitor;
  std::size_t first;  // of the rays that are traversed
};

struct GeometryData {
  Handover there, back;           // around the commit
  const std::vector<Box>* boxes;  // the caller's, and read during the commit only
  std::vector<LeafName> names;    // none where leaf k is all of surface k: one place in memory less to go to
  unsigned all_of_each;           // what it is then called
  double pad;
  EmbreeScene::Visitor visitor;

  LeafName name_of(unsigned leaf) const { return names.empty() ? LeafName{leaf, all_of_each} : names[leaf]; }
};

// Whether they are all of surfaces 0, 1, ..., by one name.
bool are_whole_surfaces(const std::vector<LeafName>& names) {
  for (unsigned k = 0; k < names.size(); ++k)
    if (names[k].surface != k || names[k].leaf < LeafName::cluster || names[k].leaf != names[0].leaf)
      return false;
  return true;
}

float down(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float up(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

void bounds_of_leaf(const RTCBoundsFunctionArguments* args) noexcept {
  auto& data = *static_cast<GeometryData*>(args->geometryUserPtr);
  data.there.take();
  const Box& box = (*data.boxes)[args->primID];
  RTCBounds& out = *args->bounds_o;
  out.lower_x = down(box.low.x - data.pad), out.upper_x = up(box.high.x + data.pad);
  out.lower_y = down(box.low.y - data.pad), out.upper_y = up(box.high.y + data.pad);
  out.lower_z = down(box.low.z - data.pad), out.upper_z = up(box.high.z + data.pad);
  data.back.give();
}

void intersect_leaf(const RTCIntersectFunctionNArguments* args) noexcept {
  const auto& data = *static_cast<const GeometryData*>(args->geometryUserPtr);
  const auto& context = *reinterpret_cast<const QueryContext*>(args->context);
  void* query = context.query;
  const LeafName name = data.name_of(args->primID);
  if (args->N > 1) {
    context.packet_visitor(query, name.surface, name.leaf, context.first, args->N, args->valid,
                           &RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, args->N), args->N, 0));
    return;
  }
  if (args->valid[0] == 0) return;
  data.visitor(query, name.surface, name.leaf,
               RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, args->N), args->N, 0));
}

void occlude_leaf(const RTCOccludedFunctionNArguments* args) noexcept {
  if (args->valid[0] == 0) return;
  const auto& data = *static_cast<const GeometryData*>(args->geometryUserPtr);
  void* query = reinterpret_cast<QueryContext*>(args->context)->query;
  float& far = RTCRayN_tfar(args->ray, args->N, 0);
  const LeafName name = data.name_of(args->primID);
  if (data.visitor(query, name.surface, name.leaf, far)) far = -std::numeric_limits<float>::infinity();
}

template <class EmbreeRay>
void set_ray(EmbreeRay& ray, const dvec3& origin, const dvec3& direction, double far) {
  ray.org_x = static_cast<float>(origin.x), ray.org_y = static_cast<float>(origin.y),
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x), ray.dir_y = static_cast<float>(direction.y),
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 0.0f, ray.tfar = round_far(far);
  ray.time = 0.0f, ray.mask = 0xffffffffu, ray.id = 0, ray.flags = 0;
}

QueryContext make_context(void* query, EmbreeScene::PacketVisitor packet_visitor = nullptr) {
  QueryContext context;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&context.base);
#else
  rtcInitIntersectContext(&context.base);
#endif
  context.query = query, context.packet_visitor = packet_visitor, context.first = 0;
  return context;
}

struct Memory {
  Handover there, back;  // around all that Embree does
  std::atomic<std::ptrdiff_t> bytes{0};
};

bool count_memory(void* total, ssize_t bytes, bool) noexcept {
  auto& memory = *static_cast<Memory*>(total);
  memory.there.take();
  memory.bytes.fetch_add(bytes, std::memory_order_relaxed);
  memory.back.give();
  return true;
}

}  // namespace

float round_far(double t) {
  if (!(t < 1e30)) return std::numeric_limits<float>::infinity();
  // Rounding to nearest takes a 32nd of this margin at most.
  return static_cast<float>(std::max(t, 0.0) * (1.0 + 0x1p-19)) + 0x1p-100f;
}

namespace {

std::size_t width_of(RTCDevice device) {
  const auto has = [&](RTCDeviceProperty p) { return rtcGetDeviceProperty(device, p) != 0; };
  return has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)  ? 16
         : has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? 8
         : has(RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) ? 4
                                                          : 0;
}

// Embree takes the inverse of a component below 1e-18 for that of +1e-18, but sorts the rays of a packet by
// the component's own sign; a group in which these differ may lose all. So small, it is no different from 0:
// it moves a ray by 2^-58 of the scene, far less than the rounding that the boxes are padded for.
float without_trifles(float direction) { return std::fabs(direction) < 0x1p-59f ? 0.0f : direction; }

// As many of the packet's rays as `Rays` holds, from `first` on.
template <class Rays, std::size_t count, class Intersect>
void visit_part(const EmbreeScene::Packet& packet, std::size_t first, const Intersect& intersect) {
  alignas(64) int valid[count];
  const auto copy = [&](const auto& from, auto* to) { std::copy(from + first, from + first + count, to); };
  copy(packet.valid, valid);
  if (std::find(valid, valid + count, -1) == valid + count) return;
  Rays rays;
  copy(packet.origin[0], rays.ray.org_x), copy(packet.origin[1], rays.ray.org_y);
  copy(packet.origin[2], rays.ray.org_z), copy(packet.far, rays.ray.tfar);
  float* const directions[] = {rays.ray.dir_x, rays.ray.dir_y, rays.ray.dir_z};
  for (std::size_t c = 0; c < 3; ++c)
    std::transform(packet.direction[c] + first, packet.direction[c] + first + count, directions[c],
                   without_trifles);
  for (std::size_t k = 0; k < count; ++k) {
    rays.ray.tnear[k] = rays.ray.time[k] = 0.0f;
    rays.ray.mask[k] = 0xffffffffu, rays.ray.id[k] = rays.ray.flags[k] = 0;
    rays.hit.geomID[k] = rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect(valid, rays);
}

}  // namespace

struct EmbreeScene::Implementation {
  Memory memory;
  std::size_t width = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  GeometryData data;

  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
    memory.back.take();
  }
};

EmbreeScene::EmbreeScene(const std::vector<Box>& boxes, std::vector<LeafName> names, double radius,
                         Visitor visitor, const char* settings)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.device = rtcNewDevice(settings);
  if (!self.device)
    throw std::runtime_error("Embree: no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
  self.width = width_of(self.device);
  self.memory.there.give();
  rtcSetDeviceMemoryMonitorFunction(self.device, count_memory, &self.memory);
  self.scene = rtcNewScene(self.device);
  const unsigned all_of_each = names.empty() ? LeafName::whole : names[0].leaf;
  if (are_whole_surfaces(names)) names = {};
  self.data = {{}, {}, &boxes, std::move(names), all_of_each, 0x1p-19 * radius, visitor};
  RTCGeometry geometry = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, &self.data);
  rtcSetGeometryBoundsFunction(geometry, bounds_of_leaf, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_leaf);
  rtcSetGeometryOccludedFunction(geometry, occlude_leaf);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(self.scene, geometry);
  rtcReleaseGeometry(geometry);
  self.data.there.give();
  rtcCommitScene(self.scene);
  self.data.back.take();
  self.data.boxes = nullptr;
  if (const RTCError error = rtcGetDeviceError(self.device); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: building the hierarchy failed, error " + std::to_string(error));
}

EmbreeScene::~EmbreeScene() = default;

void EmbreeScene::visit_all(const dvec3& origin, const dvec3& direction, double far,
                            void* query) const noexcept {
  RTCRayHit ray;
  set_ray(ray.ray, origin, direction, far);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  QueryContext context = make_context(query);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.base;
  rtcIntersect1(implementation_->scene, &ray, &arguments);
#else
  rtcIntersect1(implementation_->scene, &context.base, &ray);
#endif
}

bool EmbreeScene::visit_any(const dvec3& origin, const dvec3& direction, double far,
                            void* query) const noexcept {
  RTCRay ray;
  set_ray(ray, origin, direction, far);
  QueryContext context = make_context(query);
#if RTC_VERSION_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context.base;
  rtcOccluded1(implementation_->scene, &ray, &arguments);
#else
  rtcOccluded1(implementation_->scene, &context.base, &ray);
#endif
  return ray.tfar < 0.0f;
}

std::size_t EmbreeScene::width() const { return implementation_->width; }

void EmbreeScene::visit_packet(const Packet& packet, PacketVisitor visitor, void* query) const noexcept {
  QueryContext context = make_context(query, visitor);
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context.base;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  const auto with = [&](auto call) {
    return
        [&, call](const int* valid, auto& rays) { call(valid, implementation_->scene, &rays, &arguments); };
  };
#else
  context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const auto with = [&](auto call) {
    return [&, call](const int* valid, auto& rays) {
      call(valid, implementation_->scene, &context.base, &rays);
    };
  };
#endif
  const std::size_t step = width();
  for (context.first = 0; step > 0 && context.first < packet_width; context.first += step)
    if (step == 16)
      visit_part<RTCRayHit16, 16>(packet, context.first, with(rtcIntersect16));
    else if (step == 8)
      visit_part<RTCRayHit8, 8>(packet, context.first, with(rtcIntersect8));
    else
      visit_part<RTCRayHit4, 4>(packet, context.first, with(rtcIntersect4));
}

std::size_t EmbreeScene::bytes() const {
  return static_cast<std::size_t>(implementation_->memory.bytes.load()) +
         implementation_->data.names.size() * sizeof(LeafName);
}

}  // namespace rondure
