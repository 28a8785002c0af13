#include "renderer/commands/info_continuity.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/continuity/continuity.h"
#include "renderer/continuity/exact_regularity.h"
#include "renderer/continuity/regularity.h"

namespace rondure {
namespace {

using Json = nlohmann::ordered_json;

Json point_of(const dvec3& p) { return {p.x, p.y, p.z}; }

Json worst_of(const WorstAt& worst) {
  if (worst.patch < 0) return nullptr;
  return {{"worst", worst.value}, {"patches", {worst.patch, worst.other}}, {"at", point_of(worst.point)}};
}

Json singular_of(const SingularPoint& s) {
  return {{"patch", s.patch}, {"uv", {s.u, s.v}}, {"at", point_of(s.point)}};
}

Json continuity_json(const Continuity& c) {
  Json out = {{"seams", c.seams},
              {"open_sides", c.open_sides},
              {"collapsed_sides", c.collapsed_sides},
              {"orientable", c.orientable},
              {"complete", c.complete},
              {"places_on_a_seam", c.places},
              {"gap", worst_of(c.gap)},
              {"tangent_degrees", worst_of(c.tangent)},
              {"mean_curvature_jump", worst_of(c.mean)},
              {"gaussian_curvature_jump", worst_of(c.gaussian)},
              {"vertices", c.vertices},
              {"closed_vertices", c.closed_vertices}};
  out["vertex_degrees"] = worst_of(c.vertex);
  out["vertex_angle_sum_off"] = worst_of(c.vertex_sum);
  return out;
}

const char* name_of(Regularity::Verdict verdict) {
  static constexpr const char* names[] = {"regular", "singular", "undecided"};
  return names[static_cast<int>(verdict)];
}

Json regularity_json(const Regularity& r) {
  Json out = {{"verdict", name_of(r.verdict)}, {"pieces", r.pieces}};
  out["patches_with_collapsed_sides"] = r.collapsed;
  const bool bounded = r.verdict == Regularity::Verdict::regular && r.collapsed == 0;
  out["least_certified"] = bounded ? Json(r.least) : Json(nullptr);
  out["least_found"] = r.least_found;
  out["least_at"] = singular_of(r.least_at);
  out["largest_found"] = r.largest_found;
  out["singular"] = Json::array();
  static constexpr const char* proofs[] = {"none", "exact", "unique"};
  for (const SingularPoint& s : r.singular) {
    out["singular"].push_back(singular_of(s));
    out["singular"].back()["proof"] = proofs[static_cast<int>(s.proof)];
    out["singular"].back()["within"] = s.proof == SingularPoint::Proof::none ? Json(nullptr) : Json(s.within);
  }
  out["complete"] = r.complete;
  out["work_spent"] = r.spent;
  return out;
}

Json certificate_json(const ExactRegularity& r) {
  Json out = {{"verdict", name_of(r.verdict)}, {"pieces", r.pieces}, {"deepest", r.deepest}};
  out["patches_with_collapsed_sides"] = r.collapsed;
  out["least"] = r.least > 0.0 ? Json(r.least) : Json(nullptr);
  out["singular"] = Json::array();
  for (const ProvedZero& s : r.singular) {
    out["singular"].push_back(singular_of(s.at));
    out["singular"].back()["within"] = s.within;
  }
  out["undecided"] = Json::array();
  for (const SingularPoint& s : r.undecided) out["undecided"].push_back(singular_of(s));
  out["work_spent"] = r.spent;
  return out;
}

std::string where(const Json& worst) {
  const Json& at = worst["at"];
  return fmt::format("patches {} and {} at ({:.6g}, {:.6g}, {:.6g})", worst["patches"][0].get<int>(),
                     worst["patches"][1].get<int>(), at[0].get<double>(), at[1].get<double>(),
                     at[2].get<double>());
}

std::string seams_text(const Json& c) {
  std::string out = fmt::format("    {} seams, {} open sides", c["seams"].get<std::size_t>(),
                                c["open_sides"].get<std::size_t>());
  if (c["collapsed_sides"].get<std::size_t>() > 0)
    out += fmt::format(", {} sides collapsed to a point", c["collapsed_sides"].get<std::size_t>());
  if (!c["orientable"].get<bool>()) out += ", not orientable";
  if (!c["complete"].get<bool>())
    out += ", seams perhaps not all found: too many sides run between the same points";
  if (c["seams"].get<std::size_t>() > 0)
    out += fmt::format("; the worst of {} places on each seam and of peaks between:",
                       c["places_on_a_seam"].get<int>());
  out += "\n";
  const auto line = [&](const char* key, const char* what, const char* unit) {
    if (c[key].is_null()) return;
    out +=
        fmt::format("      {} by {:.2g}{}: {}\n", what, c[key]["worst"].get<double>(), unit, where(c[key]));
  };
  line("tangent_degrees", "tangent planes differ", " degrees");
  line("mean_curvature_jump", "mean curvature jumps", "");
  line("gaussian_curvature_jump", "Gaussian curvature jumps", "");
  if (!c["vertex_degrees"].is_null()) {
    out += fmt::format(
        "      at {} closed vertices normals differ by up to {:.2g} degrees, angles are off a full turn by "
        "up to "
        "{}\n",
        c["closed_vertices"].get<std::size_t>(), c["vertex_degrees"]["worst"].get<double>(),
        c["vertex_angle_sum_off"].is_null()
            ? "what is not known"
            : fmt::format("{:.2g} degrees", c["vertex_angle_sum_off"]["worst"].get<double>()));
  }
  return out;
}

std::string place_text(const Json& s) {
  const Json& at = s["at"];
  return fmt::format("patch {} at (u, v) = ({:.12g}, {:.12g}), ({:.6g}, {:.6g}, {:.6g})",
                     s["patch"].get<int>(), s["uv"][0].get<double>(), s["uv"][1].get<double>(),
                     at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
}

std::string certificate_text(const Json& c) {
  const std::string verdict = c["verdict"].get<std::string>();
  std::string out;
  if (verdict == "regular") {
    out = fmt::format("    in exact arithmetic: regular, {} on {} pieces after up to {} halvings\n",
                      c["least"].is_null()
                          ? fmt::format("but for the sides where all normals vanish, of {} patches: proved",
                                        c["patches_with_collapsed_sides"].get<int>())
                          : fmt::format("|Su x Sv| is at least {:.3g}, proved", c["least"].get<double>()),
                      c["pieces"].get<long>(), c["deepest"].get<int>());
  } else if (verdict == "singular") {
    const std::size_t count = c["singular"].size();
    out = fmt::format("    in exact arithmetic: singular, proved at {} point{}\n", count,
                      count == 1 ? "" : "s");
    for (const Json& s : c["singular"]) {
      const double within = s["within"].get<double>();
      out +=
          fmt::format("      {}\n",
                      place_text(s) + (within > 0.0 ? fmt::format(", within {:.1e} of these u and v", within)
                                                    : ", exactly"));
    }
  } else {
    out = fmt::format("    in exact arithmetic: undecided{}\n",
                      c["work_spent"].get<bool>() ? ", since it would take too much work" : "");
  }
  for (const Json& s : c["undecided"]) out += fmt::format("      not proved: {}\n", place_text(s));
  return out;
}

std::string regularity_text(const Json& r) {
  const std::string verdict = r["verdict"].get<std::string>();
  std::string out;
  if (verdict == "regular" && !r["least_certified"].is_null()) {
    out = fmt::format(
        "    regular: |Su x Sv| is at least {:.3g}, proved on {} pieces; least found {:.3g} in "
        "patch {}, largest found {:.3g}\n",
        r["least_certified"].get<double>(), r["pieces"].get<long>(), r["least_found"].get<double>(),
        r["least_at"]["patch"].get<int>(), r["largest_found"].get<double>());
  } else if (verdict == "regular") {
    out = fmt::format(
        "    regular but for the sides where all normals vanish, of {} patches: proved on {} "
        "pieces\n",
        r["patches_with_collapsed_sides"].get<int>(), r["pieces"].get<long>());
  } else if (verdict == "singular") {
    const std::size_t count = r["singular"].size();
    const bool proved = std::all_of(r["singular"].begin(), r["singular"].end(),
                                    [](const Json& s) { return s["proof"] != "none"; });
    out = fmt::format("    singular: Su x Sv vanishes{} at {} point{}{}{}\n", proved ? "" : " to rounding",
                      count, count == 1 ? "" : "s", count == 16 ? " or more" : "",
                      !r["complete"].get<bool>() ? ""
                      : r["patches_with_collapsed_sides"].get<int>() > 0
                          ? ", and nowhere else but on collapsed sides"
                          : ", and nowhere else");
    for (const Json& s : r["singular"]) out += fmt::format("      {}\n", place_text(s));
  } else {
    out = fmt::format(
        "    regular or not is undecided{}: |Su x Sv| falls to {:.3g} in patch {}, largest found {:.3g}\n",
        r["work_spent"].get<bool>() ? ", since it would take too much work" : "",
        r["least_found"].get<double>(), r["least_at"]["patch"].get<int>(), r["largest_found"].get<double>());
  }
  return out;
}

}  // namespace

void add_continuity(nlohmann::ordered_json& object, const Surface& surface, bool certify) {
  if (surface.patches.empty()) return;
  object["continuity"] = continuity_json(continuity_of(surface));
  const Regularity regularity = regularity_of(surface);
  object["regularity"] = regularity_json(regularity);
  if (certify) object["certificate"] = certificate_json(exact_regularity(surface, regularity));
}

std::string continuity_text(const nlohmann::ordered_json& object) {
  if (!object.contains("continuity")) return {};
  std::string out = seams_text(object["continuity"]) + regularity_text(object["regularity"]);
  if (object.contains("certificate")) out += certificate_text(object["certificate"]);
  return out;
}

}  // namespace rondure
