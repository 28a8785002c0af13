#include "tests/bench/rows.h"

#include <fmt/core.h>

#include <cstdio>
#include <stdexcept>

#include "tests/bench/ray_sets.h"
#include "tests/bench/stopwatch.h"

namespace rondure::bench {

void measure(std::vector<Row>& rows, const References& references, int rounds) {
  const std::vector<Ray> sets[2] = {coherent_rays(400), incoherent_rays(160'000)};
  std::vector<std::vector<Ray>> parts[2];
  for (int set = 0; set < 2; ++set) {
    for (const Row& row : rows) {
      std::vector<Ray> part;
      if (row.part > 1)
        for (std::size_t k = 0; k < sets[set].size(); ++k)
          if (k / static_cast<std::size_t>(row.width) % row.part == 0) part.push_back(sets[set][k]);
      parts[set].push_back(std::move(part));
    }
  }
  std::size_t sink = 0;
  for (int round = 0; round < rounds; ++round) {
    for (int set = 0; set < 2; ++set) {
      double single = 1.0, packets = 1.0;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        Row& row = rows[k];
        const std::vector<Ray>& rays = row.part > 1 ? parts[set][k] : sets[set];
        const double time = seconds([&] { sink += row.trace(rays); });
        const double rate = static_cast<double>(rays.size()) / time * 1e-6;
        row.rate[set].push_back(rate);
        if (row.name == references.single && row.width == 1) single = rate;
        if (row.name == references.packets && row.width > 1) packets = rate;
      }
      for (Row& row : rows)
        row.ratio[set].push_back(row.rate[set].back() / (row.width > 1 ? packets : single));
    }
  }
  fmt::print("one thread, its own time, {} rounds ({} hits)\n", rounds, sink);
}

void print_rows(const std::vector<Row>& rows) {
  fmt::print("  {:<28} {:>5} {:>10} {:>10} {:>12} {:>12} {:>10} {:>12}\n", "", "rays", "coherent",
             "incoherent", "Mray/s coh.", "Mray/s inc.", "error", "memory");
  for (const Row& row : rows)
    fmt::print("  {:<28} {:>5} {:>9.4g}x {:>9.4g}x {:>12.4g} {:>12.4g} {:>10.1e} {:>9.2f} MB\n", row.name,
               row.width, median(row.ratio[0]), median(row.ratio[1]), median(row.rate[0]),
               median(row.rate[1]), row.error, static_cast<double>(row.bytes) * 1e-6);
}

void write_json(const std::vector<Row>& rows, const std::string& path) {
  std::string text = "{\"rows\": [";
  for (const Row& row : rows)
    text += fmt::format(
        "{}\n  {{\"name\": \"{}\", \"width\": {}, \"coherent\": {:.4g}, \"incoherent\": {:.4g}, "
        "\"coherent_mrays\": {:.4g}, \"incoherent_mrays\": {:.4g}, \"error\": {:.3g}, \"bytes\": {}}}",
        &row == rows.data() ? "" : ",", row.name, row.width, median(row.ratio[0]), median(row.ratio[1]),
        median(row.rate[0]), median(row.rate[1]), row.error, row.bytes);
  text += "\n]}\n";
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file || std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fclose(file) != 0)
    throw std::runtime_error("cannot write " + path);
}

}  // namespace rondure::bench
