// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "panvo/position_corrector/curve_steepness.hpp"
#include "panvo/position_corrector/five_point_motion.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/position_corrector/position_correction.hpp"

namespace panvo::position_corrector {

struct PaperCorrectionParameters {
  FivePointParameters five_point;
  SteepnessParameters steepness;
  double position_sigma_m = 1.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PaperCorrectionParameters;
    field.group(&P::five_point, "five_point");
    field.group(&P::steepness, "steepness");
    field(&P::position_sigma_m, "position_sigma_m", "m",
          "standard deviation of the position if the curve is steep, i.e. within 2 m of the landmark", 0.01, 100.0);
  }
};

/// Variance of an undetermined position, m^2.
inline constexpr double kUnknownPosition_m2 = 1e6;

/// The paper's correction for a matched landmark [Lu2015 5.2], at the panorama with the minimum of D(f_s, f_ss): its
/// rotation by five-point motion, and, only if the curve is steep, the landmark's position. Rejected if the five-point
/// motion fails. `landmark`: its keypoints. Throws std::invalid_argument unless the state of the match is `kMatched`.
PositionCorrection paper_correction(const LandmarkMatch& match, std::span<const landmarks::Keypoint> landmark,
                                    const Mountings& mountings, const PaperCorrectionParameters& parameters);

}  // namespace panvo::position_corrector
