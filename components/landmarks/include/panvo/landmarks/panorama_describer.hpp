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

/// Parameters of a panorama description. Two descriptions are comparable if these and the seed are equal. The defaults
/// give the best recognition from a few metres aside; paper() returns the values of the paper where it gives them.
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
    field(&P::top_deg, "top_deg", "deg", "upper limit of the described band, above the horizon", 5.0, 90.0);
    field(&P::bottom_deg, "bottom_deg", "deg", "lower limit of the band, below the horizon", 0.0, 90.0);
    field(&P::patches, "patches", "1", "patches drawn at each scale", 10, 10000);
    field(&P::features, "features", "1", "features kept per scale, n'", 5, 10000);
    field(&P::rectangles, "rectangles", "1", "rectangles per patch", 1, 16);
    field(&P::balanced, "balanced", "", "as many positive as negative rectangles, so that brightness cancels");
    field(&P::spread, "spread", "1", "spread of a patch's rectangles, fraction of a full turn", 0.0, 1.0);
    field(&P::widest, "widest", "1", "maximum width of large-scale rectangles, fraction of a full turn", 0.06, 1.0);
    field(&P::headings, "headings", "1", "headings tried over the full turn at the large scale; a divisor of 1080", 4,
          1080);
    field(&P::histogram_bins, "histogram_bins", "1", "bins of the intensity histogram", 4, 256);
    field(&P::alpha_deg, "alpha_deg", "deg", "radius within which a patch should look the same", 0.5, 90.0);
    field(&P::beta_deg, "beta_deg", "deg", "inner radius of the ring in which it should look different", 0.5, 90.0);
    field(&P::gamma_deg, "gamma_deg", "deg", "outer radius of that ring", 0.5, 180.0);
    field(&P::small_radii, "small_radii", "1", "factor on these radii at the small scale, which determines the heading",
          0.05, 1.0);
    field(&P::upright, "upright", "1", "vertical fraction of these radii: the view shifts sideways", 0.0, 1.0);
    field(&P::sectors, "sectors", "1", "sectors of the full turn that share the kept features equally; 1: none", 1, 90);
  }

  bool operator==(const DescriptionParameters&) const = default;
};

/// Common to all descriptions of a describer: the rows of the band and the two measurement matrices.
struct DescriptionBasis {
  static constexpr int kColumns = 1080;  ///< px, to which every panorama is resized
  static constexpr int kRows = 540;

  DescriptionParameters parameters;
  std::uint64_t seed = 0;
  int first_row = 0;  ///< of the band
  vision::MeasurementMatrix large, small;
  vision::SelectionParameters select_large, select_small;

  /// Sizes that landmarks must have to be compared with these descriptions.
  DescriptionLimits limits() const {
    return {2 * static_cast<std::size_t>(large.rows()), static_cast<std::size_t>(parameters.histogram_bins)};
  }
};

/// A panorama to recognise: its histogram, its responses at every heading of the grid, and its integral images, from
/// which the response at any other heading is read.
struct QueryDescription {
  std::shared_ptr<const DescriptionBasis> basis;
  std::vector<float> histogram;
  vision::CyclicIntegralImages images;
  vision::BandNormalisation normalisation;
  std::vector<float>
      large_responses;  ///< 2 rows x headings, heading i is i/headings of a turn; first intensity, then SURF
};

/// Describes panoramas as landmarks or as queries, with one measurement matrix per scale drawn from the seed.
class PanoramaDescriber {
 public:
  /// Throws std::invalid_argument for parameters that contradict each other.
  PanoramaDescriber(const DescriptionParameters& parameters, std::uint64_t seed);

  /// Histogram and adaptive compressive features at both scales [Lu2015 4.2] of a panorama (CV_8UC1 or CV_8UC3, 2:1;
  /// resized to 1080x540). Throws std::invalid_argument with the reason if find_fault() rejects it.
  PanoramaDescription describe(const cv::Mat& panorama) const;

  /// Prepares a panorama for comparison with any number of landmarks at all headings [Lu2015 5.1].
  QueryDescription query(const cv::Mat& panorama) const;

  const DescriptionBasis& basis() const { return *basis_; }

 private:
  std::shared_ptr<const DescriptionBasis> basis_;
};

/// Converts a panorama to grey, 1080x540 (shares the pixels if it already is).
cv::Mat to_described_size(const cv::Mat& panorama);

}  // namespace panvo::landmarks
