// From a degree known at run time to one known when compiling, for the degrees that are common: the one place
// that lists them.
//
// `call` takes std::integral_constant arguments whose values serve as template arguments of the evaluators;
// any other degree arrives as `dynamic`. The results have the same bits either way.
#pragma once

#include <type_traits>

#include "renderer/bezier/bernstein.h"

namespace rondure {

template <int D>
using Degree = std::integral_constant<int, D>;

// call(Degree<M>, Degree<N>) for a tensor-product net of degree (m, n).
template <class Call>
auto with_degrees(int m, int n, const Call& call) {
  switch (m * 100 + n) {
    case 202:
      return call(Degree<2>{}, Degree<2>{});
    case 204:
      return call(Degree<2>{}, Degree<4>{});
    case 303:
      return call(Degree<3>{}, Degree<3>{});
    case 402:
      return call(Degree<4>{}, Degree<2>{});
    case 404:
      return call(Degree<4>{}, Degree<4>{});
    default:
      return call(Degree<dynamic>{}, Degree<dynamic>{});
  }
}

// call(Degree<N>) for a triangular net of degree n.
template <class Call>
auto with_degree(int n, const Call& call) {
  switch (n) {
    case 1:
      return call(Degree<1>{});
    case 2:
      return call(Degree<2>{});
    case 3:
      return call(Degree<3>{});
    case 4:
      return call(Degree<4>{});
    case 5:
      return call(Degree<5>{});
    case 6:
      return call(Degree<6>{});
    default:
      return call(Degree<dynamic>{});
  }
}

}  // namespace rondure
