#include <fmt/format.h>

#include <algorithm>

#include "renderer/study/corner_normals.h"
#include "renderer/study/page.h"

namespace rondure {
namespace {

// The sites of a group that are alike.
struct Line {
  std::string family, group, order, limit, proof, first;
  int count = 0;
  double spread = 0.0, within = 0.0;
};

std::vector<Line> lines_of(const Table& sites) {
  std::vector<Line> lines;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const std::string order =
        sites.at(k, "side_order") == "0"
            ? sites.at(k, "order")
            : fmt::format("{} (side), {} (rest)", sites.at(k, "side_order"), sites.at(k, "order"));
    const std::string limit = sites.at(k, "limit") == "1" ? "exists" : "does not exist";
    const auto same = [&](const Line& l) {
      return l.family == sites.at(k, "family") && l.group == sites.at(k, "group") && l.order == order &&
             l.limit == limit && l.proof == sites.at(k, "proof");
    };
    auto line = std::find_if(lines.begin(), lines.end(), same);
    if (line == lines.end()) {
      const std::string first =
          fmt::format("patch {}, ({}, {})", sites.at(k, "patch"), number_text(sites.number(k, "u"), 12),
                      number_text(sites.number(k, "v"), 12));
      line = lines.insert(lines.end(), Line{sites.at(k, "family"), sites.at(k, "group"), order, limit,
                                            sites.at(k, "proof"), first});
    }
    ++line->count;
    line->within = std::max(line->within, sites.number(k, "within"));
    line->spread = std::max(line->spread, sites.number(k, "spread"));
  }
  return lines;
}

std::string proof_text(const Line& line) {
  if (line.proof == "exact") return "exact";
  if (line.proof == "unique") return fmt::format("one within {}", number_text(line.within, 2));
  return "none";
}

// How the search ended, family by family.
std::string families_table(const Table& families) {
  std::vector<std::vector<std::string>> rows = {{"family", "patches", "default solver",
                                                 "singular points and places on collapsed sides",
                                                 "that there are no others"}};
  for (std::size_t k = 0; k < families.size(); ++k) {
    const std::string& undecided = families.at(k, "undecided");
    rows.push_back({families.at(k, "family"), families.at(k, "patches"), families.at(k, "solver"),
                    families.at(k, "sites"),
                    undecided == "0" ? fmt::format("proved on {} pieces", families.at(k, "pieces"))
                                     : fmt::format("given up on {} patches", undecided)});
  }
  return html_table(rows);
}

}  // namespace

std::string sites_section(const Table& families, const Table& sites) {
  std::string out =
      "<h2>Singular points</h2>\n<p>Zeros of the normal polynomial N = w<sup>3</sup> Su &times; Sv, patch by "
      "patch. A piece of a patch has none where N's Bernstein coefficients lie on one side of a plane "
      "through "
      "0, further away than rounding of the control points and since can have moved them; pieces are halved "
      "until "
      "they do. Collapsed sides are factors of N: its coefficients along them are zero, and are divided out; "
      "their middle and ends are listed. At a corner N vanishes exactly, as far as rounding lets control "
      "points tell, where its coefficient does; there is no other zero beside it where the rest are on one "
      "side of "
      "a plane. Inside, Newton's method goes on to rounding and Kantorovich's theorem proves that there is "
      "one "
      "zero within the radius given, in parameters, whatever rounding did.</p>\n" +
      families_table(families);
  std::vector<std::vector<std::string>> rows = {
      {"family", "kind (place)", "count", "order of the zero of Su &times; Sv", "proof of it", "limit normal",
       "spread of the limits by way in (rad)", "first: patch, (u, v)"}};
  for (const Line& l : lines_of(sites))
    rows.push_back({html_escaped(l.family), html_escaped(l.group), fmt::format("{}", l.count), l.order,
                    proof_text(l), l.limit, number_text(l.spread), l.first});
  return out + html_table(rows);
}

}  // namespace rondure
