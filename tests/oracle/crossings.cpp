#include <algorithm>

#include "tests/oracle/oracle.h"

namespace rondure::oracle {

std::vector<Crossing> crossings(const Meeting& meeting, double resolution) {
  std::vector<Crossing> out;
  for (const Root& root : meeting.roots) {
    // Two simple roots of one patch are two crossings however near.
    const bool joins = !out.empty() && root.t - out.back().high <= resolution &&
                       std::find(out.back().patches.begin(), out.back().patches.end(), root.patch) ==
                           out.back().patches.end();
    if (!joins) {
      out.push_back({root.t,
                     root.cosine,
                     root.t,
                     root.t,
                     root.outside,
                     root.multiplicity,
                     root.certified,
                     root.way,
                     false,
                     {root.patch}});
      continue;
    }
    Crossing& c = out.back();
    if (root.outside < c.outside) c.t = root.t, c.outside = root.outside;
    c.cosine = std::min(c.cosine, root.cosine);
    c.high = std::max(c.high, root.t);
    if (root.multiplicity != 1) c.multiplicity = root.multiplicity;
    c.certified = c.certified && root.certified;
    c.touches = c.touches || root.way != c.way;
    c.patches.push_back(root.patch);
  }
  return out;
}

}  // namespace rondure::oracle
