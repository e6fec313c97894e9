// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "panvo/vision/lens.hpp"

/// A camera with each lens model, distorted as real lenses are. A model without one does not compile.
namespace panvo::vision::test {

inline LensCamera example(const PlumbBobLens& /*formula*/) {
  return {{400, 402, 318, 243, 640, 480}, LensModel::kPlumbBob, {-0.3, 0.11, 0.001, -0.0007, -0.01}};
}
inline LensCamera example(const RationalLens& /*formula*/) {
  return {{330, 331, 322, 238, 640, 480}, LensModel::kRational, {0.9, 0.2, 0.0004, -0.0003, 0.004, 1.25, 0.45, 0.03}};
}
inline LensCamera example(const EquidistantLens& /*formula*/) {
  return {{290, 291, 540, 545, 1088, 1088}, LensModel::kEquidistant, {-0.012, 0.004, -0.002, 0.0002}};
}
inline LensCamera example(const MeiLens& /*formula*/) {
  return {{380, 381, 512, 515, 1024, 1024}, LensModel::kMei, {-0.1, 0.05, 0.0005, -0.0004, 1.2}};
}

inline LensCamera example(LensModel model) {
  return visit_lens(model, [](const auto& formula) { return example(formula); });
}

inline std::vector<LensCamera> example_lenses() {
  std::vector<LensCamera> cameras(kLensModels.size());
  std::transform(kLensModels.begin(), kLensModels.end(), cameras.begin(),
                 [](LensModel model) { return example(model); });
  return cameras;
}

}  // namespace panvo::vision::test
