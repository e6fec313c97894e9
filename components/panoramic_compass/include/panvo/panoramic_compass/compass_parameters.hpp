// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::panoramic_compass {

/// Patches, described by adaptive compressive features and tracked by the smallest distance [Lu2015 6].
struct PatchParameters {
  int drawn = 100;
  int kept = 50;
  double elevation_deg = 30.0;
  double width_deg = 40.0;
  double height_deg = 24.0;
  double max_distance = 0.75;
  double alpha_deg = 2.0;
  double beta_deg = 4.0;
  double gamma_deg = 15.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PatchParameters;
    field(&P::drawn, "drawn", "1",
          "rows of the measurement matrix per patch; half as many as for landmarks [Lu2015 7.1]", 4, 1000);
    field(&P::kept, "kept", "1", "number of selected features per patch, n' [Lu2015 7.1]", 2, 1000);
    field(&P::elevation_deg, "elevation_deg", "deg",
          "two_patches: elevation of the patch centres above the horizon; moving objects stay below [Lu2015 6]", -20.0,
          70.0);
    field(&P::width_deg, "width_deg", "deg", "two_patches: patch width", 5.0, 120.0);
    field(&P::height_deg, "height_deg", "deg", "two_patches: patch height", 5.0, 80.0);
    field(&P::max_distance, "max_distance", "1",
          "largest accepted minimum of D, relative to its mean over the search range; wrong positions give about 1",
          0.05, 1.0);
    field(&P::alpha_deg, "alpha_deg", "deg", "largest displacement of positive samples of a patch [Lu2015 3.2]", 0.2,
          45.0);
    field(&P::beta_deg, "beta_deg", "deg", "smallest displacement of negative samples", 0.2, 45.0);
    field(&P::gamma_deg, "gamma_deg", "deg", "largest displacement of negative samples", 0.2, 90.0);
  }
};

/// Points on all sides, tracked by patch alignment.
struct PointParameters {
  double top_deg = 40.0;
  double bottom_deg = 8.0;
  int spacing_px = 20;
  double min_gradient = 2.0;
  double min_correlation = 0.8;

  template <class Field>
  static void describe(Field&& field) {
    using P = PointParameters;
    field(&P::top_deg, "top_deg", "deg", "upper edge of the band, above the horizon; higher up is mostly sky", 10.0,
          80.0);
    field(&P::bottom_deg, "bottom_deg", "deg",
          "lower edge of the band, below the horizon; further down is the vehicle itself", -5.0, 45.0);
    field(&P::spacing_px, "spacing_px", "px", "cell size, with one point per cell; the panorama has 1080 columns", 8,
          90);
    field(&P::min_gradient, "min_gradient", "grey levels/px",
          "minimum gradient of a point along its weakest direction, above the noise of an 8-bit image", 0.5, 50.0);
    field(&P::min_correlation, "min_correlation", "1", "minimum normalised correlation of a tracked point", 0.3, 1.0);
  }
};

/// Acceptance of the estimated turn, and lifetime of a reference panorama.
struct AgreementParameters {
  int min_points = 20;
  double min_share = 0.5;
  double max_sigma_deg = 0.5;
  double systematic_deg = 0.01;
  double parallax_share = 0.004;
  double kept_share = 0.3;
  double max_parallax_deg = 9.0;
  int max_reference_panoramas = 25;

  template <class Field>
  static void describe(Field&& field) {
    using P = AgreementParameters;
    field(&P::min_points, "min_points", "1", "minimum number of points that agree on a turn; fewer may agree by chance",
          6, 1000);
    field(&P::min_share, "min_share", "1", "minimum share of tracked points that agree on the turn", 0.1, 1.0);
    field(&P::max_sigma_deg, "max_sigma_deg", "deg", "largest standard deviation of a valid turn", 0.01, 30.0);
    field(&P::systematic_deg, "systematic_deg", "deg",
          "standard deviation of systematic errors: stitching, lens, shutter", 0.0, 5.0);
    field(&P::parallax_share, "parallax_share", "1",
          "standard deviation of errors proportional to the parallax, due to changed appearance", 0.0, 0.1);
    field(&P::kept_share, "kept_share", "1", "share of the reference's points below which a new reference is taken",
          0.05, 1.0);
    field(&P::max_parallax_deg, "max_parallax_deg", "deg",
          "median parallax above which a new reference is taken, because near objects look different", 0.1, 45.0);
    field(&P::max_reference_panoramas, "max_reference_panoramas", "1",
          "maximum number of panoramas measured against one reference", 1, 1000);
  }
};

/// Parameters of the compass. The defaults are the most accurate; method "two_patches" is that of the paper.
struct CompassParameters {
  std::string method = "all_round";
  double max_turn_deg = 30.0;
  PatchParameters patches;
  PointParameters points;
  AgreementParameters agreement;

  template <class Field>
  static void describe(Field&& field) {
    using P = CompassParameters;
    field(&P::method, "method", "",
          "all_round: fits rotation and direction of motion to points on all sides, relative to a reference kept over "
          "several panoramas; two_patches: front and rear patch of the paper, between consecutive panoramas "
          "[Lu2015 6]",
          {"all_round", "two_patches"});
    field(&P::max_turn_deg, "max_turn_deg", "deg",
          "search range on each side of the expected turn between consecutive panoramas; 30: 150 deg/s at 5 Hz", 1.0,
          180.0);
    field.group(&P::patches, "patches");
    field.group(&P::points, "points");
    field.group(&P::agreement, "agreement");
  }
};

}  // namespace panvo::panoramic_compass
