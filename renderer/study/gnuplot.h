// Plots by gnuplot, as SVG.
#pragma once

#include <string>
#include <vector>

#include "renderer/study/folder.h"

namespace rondure {

struct Curve {
  std::string name;
  std::vector<double> x, y;  // points whose numbers are not finite or not positive are left out
};

// On logarithmic axes.
struct Plot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
};

// Throws std::runtime_error, naming the package, when there is no gnuplot to be found.
void require_gnuplot();

// Writes NAME.svg, and what made it: NAME.gp and NAME.dat, for gnuplot in that folder. Returns the SVG.
// Throws std::runtime_error with gnuplot's own words when it fails.
std::string plot_svg(const StudyFolder& folder, const std::string& name, const Plot& plot);

}  // namespace rondure
