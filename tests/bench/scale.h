// Many surfaces: how fast they are built, what they take, and how much slower rays become, beside as many of
// Embree's own spheres in the same places.
#pragma once

namespace rondure::bench {

// Prints two tables for each of two solvers, up to `most` tilings of six patches each: 10^5 by default, which
// take 2 GB where they are distinct; 10^6, whose nets alone take 5 GB, are met as copies only.
void print_scale(int rounds, int most = 100'000);

}  // namespace rondure::bench
