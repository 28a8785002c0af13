// The rows of the speed table: who traces, how many rays at a time, and what came out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/intersect/ray.h"

namespace rondure::bench {

struct Row {
  std::string name;
  int width = 1;                                              // rays at a time
  std::function<std::size_t(const std::vector<Ray>&)> trace;  // number of hits
  double error = 0.0;                                         // worst distance of a hit from the unit sphere
  std::size_t bytes = 0;
  std::size_t part = 1;  // traces every part-th ray or packet only: of rows that are slow
  // By ray set (coherent, incoherent), a round each: million rays a second, and that over the rate of the
  // reference of the same width in the same round.
  std::vector<double> rate[2] = {}, ratio[2] = {};
};

// Every row takes its turn in every round. `references`: names of the rows of one ray and of packets that
// others are measured by.
struct References {
  std::string single, packets;
};
void measure(std::vector<Row>& rows, const References& references, int rounds);
void print_rows(const std::vector<Row>& rows);
// {"rows": [{"name", "width", "coherent", "incoherent", "coherent_mrays", "incoherent_mrays", "error",
// "bytes"}]}
void write_json(const std::vector<Row>& rows, const std::string& path);

// Of OpenCASCADE and SISL, where this program was built with them.
std::vector<Row> cad_rows();

}  // namespace rondure::bench
