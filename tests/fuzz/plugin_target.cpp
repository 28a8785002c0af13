#include <cstring>
#include <stdexcept>
#include <string>

#include "renderer/api/abi.h"
#include "renderer/plugin/loader.h"
#include "renderer/scene/scene_reader.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/targets.h"

namespace rondure {
namespace {

// Takes values from the front, zeros beyond the end.
class Bytes {
 public:
  explicit Bytes(std::string_view left) : left_(left) {}

  bool empty() const { return left_.empty(); }
  std::string text() {
    const std::size_t end = std::min(left_.find('\0'), left_.size());
    const std::string text(left_.substr(0, end));
    left_.remove_prefix(std::min(end + 1, left_.size()));
    return text;
  }
  template <class T>
  T value() {
    T value{};
    const std::size_t count = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), count);
    left_.remove_prefix(count);
    return value;
  }
  dvec3 vector() {
    const auto x = value<double>(), y = value<double>(), z = value<double>();
    return {x, y, z};
  }
  dvec4 point() {
    const dvec3 p = vector();
    return {p, value<double>()};
  }

 private:
  std::string_view left_;
};

std::vector<dvec4> points(Bytes& bytes, std::size_t count) {
  std::vector<dvec4> result(count);
  for (dvec4& p : result) p = bytes.point();
  return result;
}

// Degrees and counts come as they are, and need not agree.
Surface surface_of(Bytes bytes) {
  Surface surface;
  while (!bytes.empty() && surface.patches.size() < 4) {
    const auto kind = bytes.value<unsigned char>();
    const int m = bytes.value<signed char>(), n = bytes.value<signed char>();
    const std::size_t count = bytes.value<unsigned char>() % 32;
    TensorNet tensor;
    tensor.m = m, tensor.n = n;
    TriangleNet triangle;
    triangle.n = m;
    if (kind % 4 == 0) {
      tensor.points = points(bytes, count);
      surface.patches.emplace_back(tensor);
    } else if (kind % 4 == 1) {
      triangle.points = points(bytes, count);
      surface.patches.emplace_back(triangle);
    } else if (kind % 4 == 2) {
      surface.origin = bytes.vector();
      surface.closed = n != 0;
      surface.guides["ribs"].push_back({points(bytes, count), bytes.value<double>()});
    } else {
      surface.ellipsoid = dmat3(bytes.vector(), bytes.vector(), bytes.vector());
    }
  }
  return surface;
}

}  // namespace

void fuzz_plugin(std::string_view given) {
  Bytes bytes(given);
  const std::string abi = bytes.text();
  const bool same = accepted([&] { check_abi("plugin.so", abi.c_str()); });
  constexpr AbiString host = abi_string();
  if (same != (abi == host.text)) throw std::logic_error("the wrong plugins are refused");
  SurfaceFamily family;
  family.name = bytes.text();
  family.summary = bytes.text();
  family.build = [&](Params&) { return surface_of(bytes); };
  accepted([&] {
    Registry registry = builtins();
    registry.add(family);
    Scene scene = read_scene_text("scene.json", R"({ "objects": [ { "type": ")" + family.name + R"(" } ] })",
                                  registry, {});
    exercise(scene);
  });
}

}  // namespace rondure
