#include "renderer/shading/fresnel.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace rondure {

double fresnel_dielectric(double cosine, double eta) {
  const double sine2_far = (1.0 - cosine * cosine) / (eta * eta);
  if (sine2_far >= 1.0) return 1.0;
  const double far = std::sqrt(1.0 - sine2_far);
  const double s = (cosine - eta * far) / (cosine + eta * far);
  const double p = (eta * cosine - far) / (eta * cosine + far);
  return 0.5 * (s * s + p * p);
}

dvec3 fresnel_conductor(double cosine, const dvec3& eta, const dvec3& k) {
  dvec3 result;
  for (int c = 0; c < 3; ++c) {
    const std::complex<double> n(eta[c], k[c]);
    const std::complex<double> far = std::sqrt(n * n - (1.0 - cosine * cosine));  // n times the far cosine
    const std::complex<double> s = (cosine - far) / (cosine + far);
    const std::complex<double> p = (n * n * cosine - far) / (n * n * cosine + far);
    result[c] = std::min(1.0, 0.5 * (std::norm(s) + std::norm(p)));
  }
  return result;
}

}  // namespace rondure
