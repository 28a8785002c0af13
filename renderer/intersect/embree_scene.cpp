#include "renderer/intersect/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

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
};

struct GeometryData {
  Handover there, back;           // around the commit
  const std::vector<Box>* boxes;  // the caller's, and read during the commit only
  std::vector<LeafName> names;  // none where leaf k is surface k, a sphere: one place in memory less to go to
  double pad;
  EmbreeScene::Visitor visitor;

  LeafName name_of(unsigned leaf) const {
    return names.empty() ? LeafName{leaf, LeafName::sphere} : names[leaf];
  }
};

bool are_all_spheres(const std::vector<LeafName>& names) {
  for (unsigned k = 0; k < names.size(); ++k)
    if (names[k].surface != k || names[k].leaf != LeafName::sphere) return false;
  return true;
}

float down(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float up(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

void bounds_of_leaf(const RTCBoundsFunctionArguments* args) {
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
  if (args->valid[0] == 0) return;
  const auto& data = *static_cast<const GeometryData*>(args->geometryUserPtr);
  void* query = reinterpret_cast<QueryContext*>(args->context)->query;
  const LeafName name = data.name_of(args->primID);
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

QueryContext make_context(void* query) {
  QueryContext context;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&context.base);
#else
  rtcInitIntersectContext(&context.base);
#endif
  context.query = query;
  return context;
}

struct Memory {
  Handover there, back;  // around all that Embree does
  std::atomic<std::ptrdiff_t> bytes{0};
};

bool count_memory(void* total, ssize_t bytes, bool) {
  auto& memory = *static_cast<Memory*>(total);
  memory.there.take();
  memory.bytes.fetch_add(bytes, std::memory_order_relaxed);
  memory.back.give();
  return true;
}

}  // namespace

float round_far(double t) {
  if (!(t < 1e30)) return std::numeric_limits<float>::infinity();
  // Rounded to nearest, which is half of this margin at most.
  return static_cast<float>(std::max(t, 0.0) * (1.0 + 0x1p-19)) + 0x1p-100f;
}

struct EmbreeScene::Implementation {
  Memory memory;
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
  self.memory.there.give();
  rtcSetDeviceMemoryMonitorFunction(self.device, count_memory, &self.memory);
  self.scene = rtcNewScene(self.device);
  if (are_all_spheres(names)) names = {};
  self.data = {{}, {}, &boxes, std::move(names), 0x1p-19 * radius, visitor};
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

std::size_t EmbreeScene::bytes() const {
  return static_cast<std::size_t>(implementation_->memory.bytes.load()) +
         implementation_->data.names.size() * sizeof(LeafName);
}

}  // namespace rondure
