// An equirectangular image at infinity, with sampling in proportion to its luminance. Directions are in the
// image's own frame, as given in light.h; the world's rotation is not its business.
#pragma once

#include "renderer/film/image.h"
#include "renderer/sampling/piecewise_constant.h"

namespace rondure {

class Environment {
 public:
  explicit Environment(Image image);

  // Linear between the centres of texels.
  dvec3 radiance(const dvec3& direction) const;
  // Density per solid angle.
  double pdf(const dvec3& direction) const;

  struct Sample {
    dvec3 direction{0.0};
    double pdf = 0.0;
  };
  Sample sample(dvec2 uv) const;
  // Luminance averaged over all directions.
  double mean_luminance() const { return mean_luminance_; }

 private:
  Image image_;
  PiecewiseConstant2d distribution_;
  double mean_luminance_ = 0.0;
};

double luminance(const dvec3& rgb);  // of linear Rec. 709

}  // namespace rondure
