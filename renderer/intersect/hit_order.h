// In which order a ray meets what it meets.
#pragma once

#include "renderer/intersect/contact.h"

namespace rondure {

// Total, so that which hit is reported does not depend on the order in which leaves are visited.
bool nearer(const Hit& a, const Hit& b);

// What doubt_at comes to at most at hits of a surface, if `widest` is the extent of the scene's largest one.
double most_doubt(const PlacedSurface& surface, double widest);
// Roundings of t by which hits may be apart that are tied, beside their other errors.
inline constexpr double own_roundings = 8.0;
// How far from a hit, in t, others may be that are tied with it.
double tie_reach(const Query& query, const Hit& hit);

// Whether rounding does not tell which comes first: a path that has gone on from either of them would know
// the other as one at its start (is_at_start).
bool are_tied(const Query& query, const Hit& a, const Hit& b);

// Whether they are two walls of one surface, as their points tell, from so far away that t does not.
bool are_walls_of_one_t(const Query& query, const Hit& a, const Hit& b);

// Which of two hits of the query's ray comes first: the nearer one, but where surfaces touch the one whose
// wall is. Of surfaces side by side one is left before the other is entered; of nested ones the outer is
// entered first and the inner left first.
bool comes_first(const Query& query, const Hit& a, const Hit& b);

// Hits of one ray in the order in which they come, each once. `signs`: which way each crosses (crossing.h).
std::vector<Hit> in_order(const Query& query, const std::vector<Hit>& hits, const std::vector<int>& signs);

}  // namespace rondure
