// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::panoramic_compass {

/// The patches that are described by adaptive compressive features and found again by the smallest distance [Lu2015 6].
struct PatchParameters {
  int drawn = 100;
  int kept = 50;
  double elevation_deg = 30.0;
  double width_deg = 40.0;
  double height_deg = 24.0;
  double largest_distance = 0.75;
  double alpha_deg = 2.0;
  double beta_deg = 4.0;
  double gamma_deg = 15.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PatchParameters;
    field(&P::drawn, "drawn", "1", "rows of the measurement matrix of a patch; half the landmarks' number [Lu2015 7.1]",
          4, 1000);
    field(&P::kept, "kept", "1", "features kept of them, n' [Lu2015 7.1]", 2, 1000);
    field(&P::elevation_deg, "elevation_deg", "deg",
          "middle of the paper's patches above the horizon: moving things stay below [Lu2015 6]", -20.0, 70.0);
    field(&P::width_deg, "width_deg", "deg", "of the paper's patches", 5.0, 120.0);
    field(&P::height_deg, "height_deg", "deg", "of the paper's patches", 5.0, 80.0);
    field(
        &P::largest_distance, "largest_distance", "1",
        "a minimum of D above this share of its mean over the search range is not clear: 1 is what a wrong place gives",
        0.05, 1.0);
    field(&P::alpha_deg, "alpha_deg", "deg", "a patch is to look the same nearer than this [Lu2015 3.2]", 0.2, 45.0);
    field(&P::beta_deg, "beta_deg", "deg", "and different farther than this ...", 0.2, 45.0);
    field(&P::gamma_deg, "gamma_deg", "deg", "... and nearer than this", 0.2, 90.0);
  }
};

/// The points all round that are found again on the pixels.
struct PointParameters {
  double top_deg = 40.0;
  double bottom_deg = 8.0;
  int spacing_px = 20;
  double smallest_gradient = 2.0;
  double smallest_correlation = 0.8;

  template <class Field>
  static void describe(Field&& field) {
    using P = PointParameters;
    field(&P::top_deg, "top_deg", "deg", "upper border of the band, above the horizon: higher there is mostly sky",
          10.0, 80.0);
    field(&P::bottom_deg, "bottom_deg", "deg",
          "lower border of the band, below the horizon: lower there is the vehicle itself", -5.0, 45.0);
    field(&P::spacing_px, "spacing_px", "px", "one point in each cell of this size, of 1080 columns of a full turn", 8,
          90);
    field(&P::smallest_gradient, "smallest_gradient", "grey levels/px",
          "of a point, along its weakest direction: above the noise of an 8-bit image", 0.5, 50.0);
    field(&P::smallest_correlation, "smallest_correlation", "1",
          "a point found again looks at least this much the same", 0.3, 1.0);
  }
};

/// When the turn that the points agree on is good enough, and how long a reference panorama is kept.
struct AgreementParameters {
  int fewest_points = 20;
  double smallest_share = 0.5;
  double largest_sigma_deg = 0.5;
  double systematic_deg = 0.01;
  double parallax_share = 0.004;
  double kept_share = 0.3;
  double largest_parallax_deg = 9.0;
  int longest_reference = 25;

  template <class Field>
  static void describe(Field&& field) {
    using P = AgreementParameters;
    field(&P::fewest_points, "fewest_points", "1", "that agree on one turn: fewer agree by chance", 6, 1000);
    field(&P::smallest_share, "smallest_share", "1", "of the points found that agree: else they contradict each other",
          0.1, 1.0);
    field(&P::largest_sigma_deg, "largest_sigma_deg", "deg", "a turn less certain than this is not valid", 0.01, 30.0);
    field(&P::systematic_deg, "systematic_deg", "deg",
          "standard deviation of what no number of points averages out: stitching, lens, shutter", 0.0, 5.0);
    field(&P::parallax_share, "parallax_share", "1",
          "standard deviation of what goes with the parallax: things look different from elsewhere", 0.0, 0.1);
    field(&P::kept_share, "kept_share", "1", "a new reference is taken when fewer of the reference's points are left",
          0.05, 1.0);
    field(&P::largest_parallax_deg, "largest_parallax_deg", "deg",
          "and when the points have moved by this, median, beside their turn: near things look different then", 0.1,
          45.0);
    field(&P::longest_reference, "longest_reference", "1", "panoramas measured against one reference, at most", 1,
          1000);
  }
};

/// How the compass looks for the turn. The defaults are what measures best; method "two_patches" is the paper's own.
struct CompassParameters {
  std::string method = "all_round";
  double largest_turn_deg = 30.0;
  PatchParameters patches;
  PointParameters points;
  AgreementParameters agreement;

  template <class Field>
  static void describe(Field&& field) {
    using P = CompassParameters;
    field(&P::method, "method", "",
          "all_round: points all round, rotation and direction of motion fitted together, against a reference kept "
          "over several "
          "panoramas; two_patches: the paper's front and rear patch, from one panorama to the next [Lu2015 6]",
          {"all_round", "two_patches"});
    field(&P::largest_turn_deg, "largest_turn_deg", "deg",
          "searched to either side of the expected turn, from one panorama to the next: 150 deg/s at 5 Hz", 1.0, 180.0);
    field.group(&P::patches, "patches");
    field.group(&P::points, "points");
    field.group(&P::agreement, "agreement");
  }
};

}  // namespace panvo::panoramic_compass
