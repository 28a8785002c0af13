#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "renderer/commands/csv.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/scene/scene_reader.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/targets.h"

namespace rondure {
namespace {

// A file in memory; the reader knows only paths.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(memfd_create("table", MFD_CLOEXEC)) {
    if (descriptor_ < 0 ||
        write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      throw std::logic_error("no file in memory");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

const Tracer& cube() {
  static const Tracer tracer = [] {
    Scene scene = read_scene_text(
        "cube.json", R"({ "objects": [ { "type": "sphere_tiling", "topology": "cube" } ] })", builtins(), {});
    return tracer_of(scene);
  }();
  return tracer;
}

// As `trace` takes a row, but for its messages.
void trace(const std::vector<double>& row, std::size_t present) {
  Ray ray{{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
  if (present > 6) ray.t_min = row[6];
  if (present > 7) ray.t_max = row[7];
  const Hit hit = cube().closest(ray);
  if (hit) check_hit(hit);
  for (const Hit& each : cube().all(ray)) check_hit(each);
}

}  // namespace

void fuzz_tables(std::string_view bytes) {
  if (bytes.empty()) return;
  static const std::vector<std::string> columns[] = {{"ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"},
                                                     {"surface", "patch", "u", "v"},
                                                     {"surface", "dx", "dy", "dz"}};
  const auto kind = static_cast<unsigned char>(bytes[0]) % std::size(columns);
  const MemoryFile file(bytes.substr(1));
  const std::size_t required = kind == 0 ? 6 : columns[kind].size();
  accepted([&] {
    CsvReader reader(file.path(), columns[kind], required);
    std::vector<double> row;
    std::size_t present = 0;
    while (reader.next(row, present)) {
      if (row.size() != columns[kind].size() || present < required || present > row.size())
        throw std::logic_error("a row has another size");
      for (const double x : row) {
        if (std::isnan(x)) throw std::logic_error("a row has a NaN");
      }
      if (kind == 0) trace(row, present);
      if (kind == 1 && reader.index(row, 1, 6, "patch") > 5) throw std::logic_error("an index is too large");
    }
  });
}

}  // namespace rondure
