// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/compressive_places.hpp"

#include <numbers>
#include <string>

#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

struct QueryPanorama final : PlaceDescriptor {
  landmarks::QueryDescription query;
};
struct LandmarkPanorama final : PlaceDescriptor {
  landmarks::PanoramaDescription description;
};

class CompressivePlaces final : public PlaceMethod {
 public:
  CompressivePlaces(FeatureScale scale, FeatureSelection selection, const landmarks::DescriptionParameters& parameters,
                    std::uint64_t seed)
      : scale_(scale), selection_(selection), describer_(parameters, seed) {}

  std::string name() const override {
    return std::string(scale_ == FeatureScale::kLarge ? "Large-scale " : "Small-scale ") +
           (selection_ == FeatureSelection::kPlain ? "CF" : "ACF");
  }

  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    auto kept = std::make_unique<LandmarkPanorama>();
    if (selection_ == FeatureSelection::kAdaptive) {
      kept->description = describer_.describe(panorama);
      return kept;
    }
    const auto query = describer_.query(panorama);
    kept->description.large = plain(query, query.basis->large);
    kept->description.small = plain(query, query.basis->small);
    return kept;
  }

  std::unique_ptr<PlaceDescriptor> describe_query(const cv::Mat& panorama) const override {
    auto kept = std::make_unique<QueryPanorama>();
    kept->query = describer_.query(panorama);
    return kept;
  }

  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    const auto& seen = static_cast<const QueryPanorama&>(query).query;
    const auto& known = static_cast<const LandmarkPanorama&>(landmark).description;
    if (scale_ == FeatureScale::kLarge) {
      const auto match = match_large_scale(seen, known);
      return {match.distance, match.heading_rad};
    }
    PlaceDistance best{2.0, 0.0};
    const int headings = seen.basis->parameters.headings;
    for (int i = 0; i < headings; ++i) {
      const double heading_rad = vision::wrap(2.0 * std::numbers::pi * i / headings, 2.0 * std::numbers::pi);
      const double distance = small_scale_distance(seen, known, heading_rad);
      if (distance < best.distance) best = {distance, heading_rad};
    }
    return best;
  }

 private:
  static std::vector<landmarks::AdaptiveFeature> plain(const landmarks::QueryDescription& query,
                                                       const vision::MeasurementMatrix& matrix) {
    const vision::ResponseReader reader(query.images, matrix, query.normalisation);
    std::vector<landmarks::AdaptiveFeature> features;
    for (int row = 0; row < matrix.rows(); ++row) {
      features.push_back({static_cast<std::uint16_t>(row), reader.read_intensity(row), 1.0F, 1.0F});
    }
    return features;
  }

  FeatureScale scale_;
  FeatureSelection selection_;
  landmarks::PanoramaDescriber describer_;
};

}  // namespace

std::unique_ptr<PlaceMethod> compressive_places(FeatureScale scale, FeatureSelection selection,
                                                const landmarks::DescriptionParameters& parameters,
                                                std::uint64_t seed) {
  return std::make_unique<CompressivePlaces>(scale, selection, parameters, seed);
}

}  // namespace panvo::evaluation
