// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/panorama_describer.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/vision/grey.hpp"
#include "panvo/vision/intensity_histogram.hpp"

namespace panvo::landmarks {
namespace {

/// The band of a panorama, prepared for either description.
struct Band {
  cv::Mat grey;
  vision::CyclicIntegralImages images;
  vision::BandNormalisation normalisation;

  Band(const cv::Mat& panorama, const DescriptionBasis& basis) {
    if (const auto fault = find_fault(panorama)) throw std::invalid_argument("the panorama " + *fault);
    const int last_row = basis.first_row + basis.large.band().height;
    const bool is_of_size = panorama.cols == DescriptionBasis::kColumns;  // only the band needs conversion to grey
    const cv::Mat all = is_of_size ? panorama.rowRange(basis.first_row, last_row) : to_described_size(panorama);
    grey = is_of_size ? vision::to_grey(all) : all.rowRange(basis.first_row, last_row);
    grey = vision::prepare_band(grey);
    images = vision::CyclicIntegralImages(grey, std::max(basis.large.widest(), basis.small.widest()));
    normalisation = vision::BandNormalisation::of(grey, images);
  }
};

std::vector<AdaptiveFeature> to_adaptive(const std::vector<vision::SelectedFeature>& selected) {
  std::vector<AdaptiveFeature> features;
  features.reserve(selected.size());
  for (const vision::SelectedFeature& feature : selected) {
    features.push_back({static_cast<std::uint16_t>(feature.row), feature.value, feature.spread, feature.weight});
  }
  return features;
}

vision::SelectionParameters selection_of(const DescriptionParameters& parameters, double radii) {
  const double columns_per_degree = radii * DescriptionBasis::kColumns / 360.0;
  vision::SelectionParameters selection;
  selection.kept = parameters.features;
  selection.alpha_px = parameters.alpha_deg * columns_per_degree;
  selection.beta_px = parameters.beta_deg * columns_per_degree;
  selection.gamma_px = parameters.gamma_deg * columns_per_degree;
  selection.upright = parameters.upright;
  selection.sectors = parameters.sectors;
  return selection;
}

}  // namespace

DescriptionParameters DescriptionParameters::paper() {
  DescriptionParameters parameters;
  parameters.top_deg = 35.0;
  parameters.bottom_deg = 15.0;
  parameters.patches = 200;
  parameters.features = 100;
  parameters.rectangles = 4;
  parameters.balanced = false;
  parameters.spread = 1.0;
  parameters.widest = 1.0;
  parameters.headings = 12;
  parameters.upright = 1.0;
  parameters.sectors = 1;
  return parameters;
}

cv::Mat to_described_size(const cv::Mat& panorama) {
  const cv::Size size(DescriptionBasis::kColumns, DescriptionBasis::kRows);
  cv::Mat grey = vision::to_grey(panorama);
  if (grey.size() != size) {
    cv::Mat resized;
    cv::resize(grey, resized, size, 0.0, 0.0, cv::INTER_AREA);
    grey = resized;
  }
  return grey;
}

PanoramaDescriber::PanoramaDescriber(const DescriptionParameters& parameters, std::uint64_t seed) {
  if (parameters.headings < 1 || DescriptionBasis::kColumns % parameters.headings != 0) {
    throw std::invalid_argument("headings: must divide 1080");
  }
  if (parameters.features > 2 * parameters.patches) {
    throw std::invalid_argument("features: must not exceed twice the patches");
  }
  auto basis = std::make_shared<DescriptionBasis>();
  basis->parameters = parameters;
  basis->seed = seed;
  const double rows_per_deg = DescriptionBasis::kRows / 180.0;
  basis->first_row = static_cast<int>(std::lround((90.0 - parameters.top_deg) * rows_per_deg));
  const int last_row = static_cast<int>(std::lround((90.0 + parameters.bottom_deg) * rows_per_deg));
  const cv::Size band(DescriptionBasis::kColumns, last_row - basis->first_row);
  const vision::MatrixParameters matrix{parameters.patches, parameters.rectangles, parameters.balanced,
                                        parameters.spread};
  basis->large = vision::MeasurementMatrix(band, vision::large_scale(band, parameters.widest), matrix, seed);
  basis->small = vision::MeasurementMatrix(band, vision::small_scale(band), matrix, seed + 1);
  basis->select_large = selection_of(parameters, 1.0);
  basis->select_small = selection_of(parameters, parameters.small_radii);
  basis_ = std::move(basis);
}

PanoramaDescription PanoramaDescriber::describe(const cv::Mat& panorama) const {
  const Band band(panorama, *basis_);
  PanoramaDescription description;
  description.histogram = vision::intensity_histogram(band.grey, band.normalisation, basis_->parameters.histogram_bins);
  description.large = to_adaptive(
      vision::select_features(band.images, basis_->large, band.normalisation, basis_->select_large, basis_->seed));
  description.small = to_adaptive(
      vision::select_features(band.images, basis_->small, band.normalisation, basis_->select_small, basis_->seed));
  return description;
}

QueryDescription PanoramaDescriber::query(const cv::Mat& panorama) const {
  Band band(panorama, *basis_);
  QueryDescription query;
  query.basis = basis_;
  query.histogram = vision::intensity_histogram(band.grey, band.normalisation, basis_->parameters.histogram_bins);
  query.images = std::move(band.images);
  query.normalisation = band.normalisation;

  const vision::MeasurementMatrix& matrix = basis_->large;
  const int headings = basis_->parameters.headings;
  const int step = DescriptionBasis::kColumns / headings;
  const vision::ResponseReader reader(query.images, matrix, query.normalisation);
  const auto rows = static_cast<std::size_t>(matrix.rows());
  query.large_responses.resize(2 * rows * static_cast<std::size_t>(headings));
  float* intensity = query.large_responses.data();
  float* gradient = intensity + rows * static_cast<std::size_t>(headings);
  for (int row = 0; row < matrix.rows(); ++row) {
    for (int i = 0; i < headings; ++i) {
      const vision::CompressiveFeature feature = reader.read(row, i * step);
      *intensity++ = feature.intensity;
      *gradient++ = feature.gradient;
    }
  }
  return query;
}

}  // namespace panvo::landmarks
