// What an object draws of its surface: the patches themselves, or their nets and lines as wires.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/surface.h"

namespace rondure {

struct Show {
  std::vector<std::string> parts = {"surface"};
  double wire = 0.01;  // radius of the wires, in scene units
  int isolines = 8;    // strips between parameter lines
};

// "show", "wire" and "isolines". The parts that can be named are "surface", "control_surface", "net",
// "boundary", "isolines" and the surface's guides.
Show read_show(Params& params, const Surface& surface);

// One of them at least is there.
struct ShownParts {
  std::optional<Surface> surface;  // the patches, the control surface, or both
  std::optional<Surface> wires;
};

// The surface must stand where it will be rendered: wires are round there.
ShownParts shown_parts(const Params& params, const Show& show, const Surface& surface);

}  // namespace rondure
