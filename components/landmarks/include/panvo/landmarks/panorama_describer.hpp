// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/adaptive_selection.hpp"
#include "panvo/vision/compressive_features.hpp"
#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::landmarks {

/// How a panorama is described. Two descriptions can be compared when these and the seed are the same for both. The defaults
/// are what recognises a place best from some metres aside; paper() are those of the paper, where it gives any.
struct DescriptionParameters {
  double top_deg = 30.0;
  double bottom_deg = 8.0;
  int patches = 400;
  int features = 200;
  int rectangles = 2;
  bool balanced = true;
  double spread = 0.05;
  double widest = 0.2;
  int headings = 36;
  int histogram_bins = 64;
  double alpha_deg = 10.0;
  double beta_deg = 20.0;
  double gamma_deg = 60.0;
  double small_radii = 0.3;
  double upright = 0.2;
  int sectors = 24;

  static DescriptionParameters paper();

  template <class Field>
  static void describe(Field&& field) {
    using P = DescriptionParameters;
    field(&P::top_deg, "top_deg", "deg", "upper border of the band that is described, above the horizon", 5.0, 90.0);
    field(&P::bottom_deg, "bottom_deg", "deg", "lower border of the band, below the horizon", 0.0, 90.0);
    field(&P::patches, "patches", "1", "patches drawn at each scale", 10, 10000);
    field(&P::features, "features", "1", "features kept of them at each scale, n'", 5, 10000);
    field(&P::rectangles, "rectangles", "1", "rectangles that a patch is made of", 1, 16);
    field(&P::balanced, "balanced", "", "as many rectangles with a plus as with a minus, so that brightness cancels");
    field(&P::spread, "spread", "1", "how far a patch's rectangles lie apart, of a full turn", 0.0, 1.0);
    field(&P::widest, "widest", "1", "bound of the width of large-scale rectangles, of a full turn", 0.06, 1.0);
    field(&P::headings, "headings", "1", "headings tried over the full turn at the large scale; a divisor of 1080", 4,
          1080);
    field(&P::histogram_bins, "histogram_bins", "1", "bins of the intensity histogram", 4, 256);
    field(&P::alpha_deg, "alpha_deg", "deg", "a patch is to look the same nearer than this", 0.5, 90.0);
    field(&P::beta_deg, "beta_deg", "deg", "and different farther than this ...", 0.5, 90.0);
    field(&P::gamma_deg, "gamma_deg", "deg", "... and nearer than this", 0.5, 180.0);
    field(&P::small_radii, "small_radii", "1",
          "the same radii at the small scale, which is to find the heading, of these", 0.05, 1.0);
    field(&P::upright, "upright", "1", "vertical share of these radii: a vehicle's view moves sideways", 0.0, 1.0);
    field(&P::sectors, "sectors", "1", "sectors of the full turn that share the kept features equally; 1: anywhere", 1,
          90);
  }

  bool operator==(const DescriptionParameters&) const = default;
};

/// What all descriptions of a describer have in common: where the band lies, and the two measurement matrices.
struct DescriptionBasis {
  static constexpr int kColumns = 1080;  ///< px, of every panorama when it is described
  static constexpr int kRows = 540;

  DescriptionParameters parameters;
  std::uint64_t seed = 0;
  int first_row = 0;  ///< of the band
  vision::MeasurementMatrix large, small;
  vision::SelectionParameters select_large, select_small;

  /// Of the landmarks that can be compared with what is described so.
  DescriptionLimits limits() const {
    return {2 * static_cast<std::size_t>(large.rows()), static_cast<std::size_t>(parameters.histogram_bins)};
  }
};

/// A panorama to be recognised: its histogram, its responses at every heading of the grid, and its integral images, from which
/// any heading between them is read.
struct QueryDescription {
  std::shared_ptr<const DescriptionBasis> basis;
  std::vector<float> histogram;
  vision::CyclicIntegralImages images;
  vision::BandNormalisation normalisation;
  std::vector<float>
      large_responses;  ///< 2 rows x headings: heading i is i full turns / headings; first intensity, then SURF
};

/// Describes panoramas: those that become landmarks, and those that are looked for. One matrix, drawn from the seed, for all.
class PanoramaDescriber {
 public:
  /// Throws std::invalid_argument for parameters that contradict each other.
  PanoramaDescriber(const DescriptionParameters& parameters, std::uint64_t seed);

  /// Histogram and adaptive compressive features at both scales [Lu2015 4.2], of a panorama (CV_8UC1 or CV_8UC3, 2:1; other
  /// sizes than 1080x540 are resized). Throws std::invalid_argument with the reason for one that find_fault() rejects.
  PanoramaDescription describe(const cv::Mat& panorama) const;

  /// The same panoramas, prepared to be compared with any number of landmarks at all headings [Lu2015 5.1].
  QueryDescription query(const cv::Mat& panorama) const;

  const DescriptionBasis& basis() const { return *basis_; }

 private:
  std::shared_ptr<const DescriptionBasis> basis_;
};

/// The panorama as it is described: grey, 1080x540 (shares the pixels where it is that already).
cv::Mat to_described_size(const cv::Mat& panorama);

}  // namespace panvo::landmarks
