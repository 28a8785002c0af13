#include "renderer/scene/show.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "renderer/bezier/control_surface.h"
#include "renderer/scene/wires.h"

namespace rondure {
namespace {

constexpr const char* general_parts[] = {"surface", "control_surface", "net", "boundary", "isolines"};

// Balls at control points, in radii of the wires between them.
constexpr double point_balls = 2.0;

// Of wires: each has a few leaves at least.
constexpr std::size_t most_patches = 300000;

struct Line {
  dvec2 from, to;
};

// Along each parameter at first, first + 1, ... of `count` equal steps.
std::vector<Line> lines_of(const Net& net, int count, int first, int last) {
  std::vector<Line> lines;
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  for (int k = first; k <= last; ++k) {
    const double t = static_cast<double>(k) / count, rest = triangle ? 1.0 - t : 1.0;
    lines.push_back({{t, 0.0}, {t, rest}});
    lines.push_back({{0.0, t}, {rest, t}});
    if (triangle) lines.push_back({{1.0 - t, 0.0}, {0.0, 1.0 - t}});
  }
  return lines;
}

std::vector<Line> boundary_of(const Net& net) {
  if (std::holds_alternative<TensorNet>(net)) return lines_of(net, 1, 0, 1);
  return {{{1, 0}, {0, 1}}, {{0, 1}, {0, 0}}, {{0, 0}, {1, 0}}};
}

// Points at infinity are left out, with what leads to them.
void add_leg(const dvec4& from, const dvec4& to, Wires& wires) {
  for (const dvec4& p : {from, to}) {
    if (p.w != 0.0) wires.add_ball(dvec3(p) / p.w, point_balls);
  }
  if (from.w == 0.0 || to.w == 0.0) return;
  wires.add({dvec4(dvec3(from) / from.w, 1.0), dvec4(dvec3(to) / to.w, 1.0)}, 0.0);
}

void add_net(const TensorNet& net, Wires& wires) {
  for (int i = 0; i <= net.m; ++i) {
    for (int j = 0; j <= net.n; ++j) {
      if (i < net.m) add_leg(net.at(i, j), net.at(i + 1, j), wires);
      if (j < net.n) add_leg(net.at(i, j), net.at(i, j + 1), wires);
    }
  }
}

void add_net(const TriangleNet& net, Wires& wires) {
  for (int i = 0; i < net.n; ++i) {
    for (int j = 0; j < net.n - i; ++j) {
      add_leg(net.at(i, j), net.at(i + 1, j), wires);
      add_leg(net.at(i, j), net.at(i, j + 1), wires);
      add_leg(net.at(i + 1, j), net.at(i, j + 1), wires);
    }
  }
}

class Shown {
 public:
  Shown(const Params& params, const Show& show, const Surface& surface)
      : params_(params), show_(show), surface_(surface), wires_(show.wire) {}

  ShownParts parts() {
    ShownParts out;
    if (named("surface")) out.surface = surface_;
    const bool has_own = surface_.guides.find("control_surface") != surface_.guides.end();
    if (named("control_surface") && !has_own) add_control_surface(out.surface);
    try {
      for (const std::string& part : show_.parts) add_wires(part);
    } catch (const std::invalid_argument& error) {  // of a tube
      params_.fail("wire", error.what());
    }
    std::vector<Net> nets = wires_.nets();
    if (!nets.empty()) {
      out.wires.emplace();
      out.wires->origin = surface_.origin;
      out.wires->patches = std::move(nets);
    }
    if (!out.surface && !out.wires)
      params_.fail("show",
                   fmt::format("there is nothing to show of \"{}\" here", fmt::join(show_.parts, "\", \"")));
    return out;
  }

 private:
  const Params& params_;
  const Show& show_;
  const Surface& surface_;
  Wires wires_;

  bool named(const char* part) const {
    return std::find(show_.parts.begin(), show_.parts.end(), part) != show_.parts.end();
  }

  void add_control_surface(std::optional<Surface>& out) const {
    std::vector<Net> flat;
    for (const Net& net : surface_.patches) {
      for (Net& piece : control_surface(net)) flat.push_back(std::move(piece));
    }
    if (flat.empty()) return;
    if (!out) {
      out.emplace();
      out->origin = surface_.origin;
    }
    out->closed = false;
    std::move(flat.begin(), flat.end(), std::back_inserter(out->patches));
  }

  void add_curve(const RationalCurve& curve, double end_balls, const std::string& part) {
    if (!is_finite(curve)) params_.fail("show", fmt::format("a line of \"{}\" reaches infinity", part));
    wires_.add(curve, end_balls);
    check_size();
  }

  void check_size() const {
    if (wires_.size() > most_patches)
      params_.fail(
          "show",
          fmt::format("the wires would be more than {} patches: show fewer parts or isolines", most_patches));
  }

  void add_lines(const Net& net, const std::vector<Line>& lines, double end_balls, const std::string& part) {
    for (const Line& line : lines) add_curve(curve_on(net, line.from, line.to), end_balls, part);
  }

  void add_wires(const std::string& part) {
    const auto guides = surface_.guides.find(part);
    if (guides != surface_.guides.end()) {
      for (const Guide& guide : guides->second) add_curve(guide.curve, guide.end_balls, part);
      return;
    }
    for (const Net& net : surface_.patches) {
      if (part == "net") {
        std::visit([&](const auto& n) { add_net(n, wires_); }, net);
        check_size();
      }
      if (part == "boundary") add_lines(net, boundary_of(net), 1.0, part);
      // Wires along the boundary close the ends of those that lead to it.
      if (part == "isolines")
        add_lines(net, lines_of(net, show_.isolines, 1, show_.isolines - 1), named("boundary") ? 0.0 : 1.0,
                  part);
    }
  }
};

std::vector<std::string> read_parts(Params& params, const Surface& surface) {
  std::vector<std::string> known(std::begin(general_parts), std::end(general_parts));
  for (const auto& [part, guides] : surface.guides) {
    if (std::find(known.begin(), known.end(), part) == known.end()) known.push_back(part);
  }
  const Value* list = params.raw("show");
  if (!list) return {"surface"};
  if (list->kind != Value::Kind::array || list->items.empty())
    params.fail(*list, "\"show\" must be an array of names, at least one");
  std::vector<std::string> parts;
  for (const Value& item : list->items) {
    const bool text = item.kind == Value::Kind::string;
    if (!text || std::find(known.begin(), known.end(), item.string) == known.end()) {
      const std::string near = text ? nearest_name(item.string, known) : "";
      params.fail(item, fmt::format("\"show\" names {}{}", fmt::join(known, ", "),
                                    near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
    if (std::find(parts.begin(), parts.end(), item.string) != parts.end())
      params.fail(item, fmt::format("\"{}\" is listed twice", item.string));
    parts.push_back(item.string);
  }
  return parts;
}

}  // namespace

Show read_show(Params& params, const Surface& surface) {
  Show show;
  show.parts = read_parts(params, surface);
  show.wire = params.number("wire", show.wire, Range::positive());
  show.isolines = static_cast<int>(params.integer("isolines", show.isolines, 1, 100));
  if (!surface.patches.empty()) return show;
  for (std::size_t k = 0; k < show.parts.size(); ++k) {
    if (show.parts[k] != "surface" && surface.guides.find(show.parts[k]) == surface.guides.end())
      params.fail(
          params.raw("show")->items[k],
          "this surface has no patches, and so no lines or nets; take a tiling, such as \"sphere_tiling\"");
  }
  return show;
}

ShownParts shown_parts(const Params& params, const Show& show, const Surface& surface) {
  return Shown(params, show, surface).parts();
}

}  // namespace rondure
