// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/histogram_places.hpp"

#include "panvo/vision/intensity_histogram.hpp"

namespace panvo::evaluation {
namespace {

struct Histogram final : PlaceDescriptor {
  std::vector<float> shares;
};

class HistogramPlaces final : public PlaceMethod {
 public:
  explicit HistogramPlaces(const landmarks::DescriptionParameters& parameters) : describer_(parameters, 1) {}

  std::string name() const override { return "Intensity histogram"; }

  std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const override {
    auto histogram = std::make_unique<Histogram>();
    histogram->shares = describer_.query(panorama).histogram;
    return histogram;
  }

  PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const override {
    return {vision::histogram_distance(static_cast<const Histogram&>(query).shares,
                                       static_cast<const Histogram&>(landmark).shares),
            0.0};
  }

 private:
  landmarks::PanoramaDescriber describer_;
};

}  // namespace

std::unique_ptr<PlaceMethod> histogram_places(const landmarks::DescriptionParameters& parameters) {
  return std::make_unique<HistogramPlaces>(parameters);
}

}  // namespace panvo::evaluation
