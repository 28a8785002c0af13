// Degree elevation: the same polynomial with one degree more. `out` must not overlap `net`.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// (m, n) to (m + 1, n).
template <class T>
void tensor_elevate_u(const T* net, int m, int n, T* out) {
  const int stride = n + 1;
  for (int i = 0; i <= m + 1; ++i) {
    const double t = static_cast<double>(i) / (m + 1);
    for (int j = 0; j <= n; ++j) {
      const T below = i > 0 ? net[(i - 1) * stride + j] : T(0.0);
      const T above = i <= m ? net[i * stride + j] : T(0.0);
      out[i * stride + j] = t * below + (1.0 - t) * above;
    }
  }
}

// (m, n) to (m, n + 1).
template <class T>
void tensor_elevate_v(const T* net, int m, int n, T* out) {
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n + 1; ++j) {
      const double t = static_cast<double>(j) / (n + 1);
      const T below = j > 0 ? net[i * (n + 1) + j - 1] : T(0.0);
      const T above = j <= n ? net[i * (n + 1) + j] : T(0.0);
      out[i * (n + 2) + j] = t * below + (1.0 - t) * above;
    }
  }
}

// n to n + 1.
template <class T>
void triangle_elevate(const T* net, int n, T* out) {
  const double scale = n + 1;
  for (int i = 0; i <= n + 1; ++i) {
    for (int j = 0; j <= n + 1 - i; ++j) {
      const int k = n + 1 - i - j;
      T sum(0.0);
      if (i > 0) sum += static_cast<double>(i) * net[triangle_index(n, i - 1, j)];
      if (j > 0) sum += static_cast<double>(j) * net[triangle_index(n, i, j - 1)];
      if (k > 0) sum += static_cast<double>(k) * net[triangle_index(n, i, j)];
      out[triangle_index(n + 1, i, j)] = sum / scale;
    }
  }
}

}  // namespace rondure
