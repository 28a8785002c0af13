#include <algorithm>
#include <cmath>

#include "tests/oracle/oracle.h"

namespace rondure::oracle {

std::vector<Crossing> crossings(const Meeting& meeting, double resolution, double across) {
  std::vector<Crossing> out;
  for (const Root& root : meeting.roots) {
    // Two simple roots of one patch are two crossings however near.
    const auto near = [&](const Crossing& c) {
      // Near touching a root moves by the square root of rounding, and no more.
      const double apart = root.t - c.high, cosine = std::fmax(std::fmin(root.cosine, c.cosine), 0x1p-25);
      return apart <= resolution || (root.way == c.way && apart * cosine <= across);
    };
    const bool joins = !out.empty() && near(out.back()) &&
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
