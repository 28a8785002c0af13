#include "tests/bench/rows.h"

namespace rondure::bench {

std::vector<Row> cad_rows() { return {}; }

}  // namespace rondure::bench
