// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace panvo::vision {

/// Cauchy loss of a squared, whitened residual s = r^2 (in units of its standard deviation).
/// Redescending: the influence of far outliers, such as tracks on moving objects, tends to zero.
class CauchyLoss {
 public:
  explicit CauchyLoss(double scale) : scale2_(scale * scale) {}
  double cost(double s) const { return scale2_ * std::log1p(s / scale2_); }
  double weight(double s) const { return 1.0 / (1.0 + s / scale2_); }  ///< d cost / d s

 private:
  double scale2_;
};

}  // namespace panvo::vision
