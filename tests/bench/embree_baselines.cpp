#include "tests/bench/embree_baselines.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace rondure::bench {
namespace {

bool count_memory(void* total, ssize_t bytes, bool) {
  static_cast<std::atomic<std::ptrdiff_t>*>(total)->fetch_add(bytes);
  return true;
}

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  *args->bounds_o = {-1.001f, -1.001f, -1.001f, 0.0f, 1.001f, 1.001f, 1.001f, 0.0f};
}

// The double-precision quadratic, from the float ray that Embree hands over; lane by lane in packets.
void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  const unsigned n = args->N;
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned k = 0; k < n; ++k) {
    if (args->valid[k] == 0) continue;
    const dvec3 o(RTCRayN_org_x(ray, n, k), RTCRayN_org_y(ray, n, k), RTCRayN_org_z(ray, n, k));
    const dvec3 d(RTCRayN_dir_x(ray, n, k), RTCRayN_dir_y(ray, n, k), RTCRayN_dir_z(ray, n, k));
    const double dd = glm::dot(d, d), middle = -glm::dot(o, d) / dd;
    const dvec3 nearest = o + middle * d;
    const double rest = 1.0 - glm::dot(nearest, nearest);
    if (rest < 0.0) continue;
    const double half = std::sqrt(rest / dd);
    double t = middle - half;
    if (t < RTCRayN_tnear(ray, n, k)) t = middle + half;
    if (t < RTCRayN_tnear(ray, n, k) || t > RTCRayN_tfar(ray, n, k)) continue;
    RTCRayN_tfar(ray, n, k) = static_cast<float>(t);
    RTCHitN_geomID(hit, n, k) = args->geomID;
    RTCHitN_primID(hit, n, k) = args->primID;
  }
}

void add_mesh(RTCGeometry geometry, std::size_t triangles) {
  const auto rows = static_cast<unsigned>(std::sqrt(static_cast<double>(triangles) / 4.0)),
             columns = 2 * rows;
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               static_cast<std::size_t>(rows + 1) * columns));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                              static_cast<std::size_t>(2) * rows * columns));
  for (unsigned i = 0; i <= rows; ++i)
    for (unsigned j = 0; j < columns; ++j) {
      const double theta = std::numbers::pi * i / rows, phi = 2.0 * std::numbers::pi * j / columns;
      *vertices++ = static_cast<float>(std::sin(theta) * std::cos(phi));
      *vertices++ = static_cast<float>(std::sin(theta) * std::sin(phi));
      *vertices++ = static_cast<float>(std::cos(theta));
    }
  for (unsigned i = 0; i < rows; ++i)
    for (unsigned j = 0; j < columns; ++j) {
      const unsigned next = (j + 1) % columns, a = i * columns + j, b = i * columns + next, c = a + columns,
                     d = b + columns;
      for (const unsigned k : {a, c, b, b, c, d}) *indices++ = k;
    }
}

}  // namespace

struct EmbreeBaseline::Implementation {
  std::atomic<std::ptrdiff_t> bytes{0};
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

EmbreeBaseline::EmbreeBaseline(Kind kind, std::size_t triangles)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.device = rtcNewDevice(nullptr);
  rtcSetDeviceMemoryMonitorFunction(self.device, count_memory, &self.bytes);
  self.scene = rtcNewScene(self.device);
  constexpr RTCGeometryType types[] = {RTC_GEOMETRY_TYPE_SPHERE_POINT, RTC_GEOMETRY_TYPE_USER,
                                       RTC_GEOMETRY_TYPE_TRIANGLE};
  RTCGeometry geometry = rtcNewGeometry(self.device, types[static_cast<int>(kind)]);
  if (kind == Kind::sphere_point) {
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
    v[0] = v[1] = v[2] = 0.0f, v[3] = 1.0f;
  } else if (kind == Kind::user_sphere) {
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
  } else {
    add_mesh(geometry, triangles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(self.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(self.scene);
}

EmbreeBaseline::~EmbreeBaseline() {
  rtcReleaseScene(implementation_->scene);
  rtcReleaseDevice(implementation_->device);
}

std::size_t EmbreeBaseline::trace(const std::vector<Ray>& rays, double* worst_error) const {
  std::size_t hits = 0;
  for (const Ray& r : rays) {
    RTCRayHit q;
    q.ray.org_x = static_cast<float>(r.origin.x), q.ray.org_y = static_cast<float>(r.origin.y),
    q.ray.org_z = static_cast<float>(r.origin.z);
    q.ray.dir_x = static_cast<float>(r.direction.x), q.ray.dir_y = static_cast<float>(r.direction.y);
    q.ray.dir_z = static_cast<float>(r.direction.z);
    q.ray.tnear = 0.0f, q.ray.tfar = INFINITY, q.ray.time = 0.0f, q.ray.mask = ~0u, q.ray.id = 0,
    q.ray.flags = 0;
    q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    q.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(implementation_->scene, &q);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(implementation_->scene, &context, &q);
#endif
    if (q.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    ++hits;
    if (worst_error) {
      const dvec3 o(q.ray.org_x, q.ray.org_y, q.ray.org_z), d(q.ray.dir_x, q.ray.dir_y, q.ray.dir_z);
      *worst_error =
          std::fmax(*worst_error, std::fabs(glm::length(o + static_cast<double>(q.ray.tfar) * d) - 1.0));
    }
  }
  return hits;
}

std::size_t EmbreeBaseline::trace_packets(const std::vector<Ray>& rays) const {
  constexpr std::size_t width = 16;
  if (!rtcGetDeviceProperty(implementation_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 0;
  std::size_t hits = 0;
  alignas(64) RTCRayHit16 q;
  alignas(64) int valid[width];
  for (std::size_t first = 0; first < rays.size(); first += width) {
    for (std::size_t k = 0; k < width; ++k) {
      const Ray& r = rays[std::min(first + k, rays.size() - 1)];
      valid[k] = first + k < rays.size() ? -1 : 0;
      q.ray.org_x[k] = static_cast<float>(r.origin.x), q.ray.org_y[k] = static_cast<float>(r.origin.y),
      q.ray.org_z[k] = static_cast<float>(r.origin.z);
      q.ray.dir_x[k] = static_cast<float>(r.direction.x), q.ray.dir_y[k] = static_cast<float>(r.direction.y),
      q.ray.dir_z[k] = static_cast<float>(r.direction.z);
      q.ray.tnear[k] = 0.0f, q.ray.tfar[k] = INFINITY, q.ray.time[k] = 0.0f, q.ray.mask[k] = ~0u,
      q.ray.id[k] = 0, q.ray.flags[k] = 0;
      q.hit.geomID[k] = q.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid, implementation_->scene, &q);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid, implementation_->scene, &context, &q);
#endif
    for (std::size_t k = 0; k < width; ++k)
      hits += valid[k] != 0 && q.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

std::size_t EmbreeBaseline::bytes() const { return static_cast<std::size_t>(implementation_->bytes.load()); }

}  // namespace rondure::bench
