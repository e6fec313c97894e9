// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace panvo::evaluation {

/// Distance of two panoramas and the change of heading between them.
struct PlaceDistance {
  double distance = 0.0;  ///< unit depends on the method; smaller: more similar
  double heading_rad =
      0.0;  ///< yaw at the query minus yaw at the landmark, left positive; 0 if the method estimates none
};

/// Base class of the descriptors of a panorama.
class PlaceDescriptor {
 public:
  PlaceDescriptor() = default;
  PlaceDescriptor(const PlaceDescriptor&) = delete;
  PlaceDescriptor& operator=(const PlaceDescriptor&) = delete;
  virtual ~PlaceDescriptor() = default;
};

/// A place recognition method on panoramas: panvo's or a baseline. Pure and deterministic.
class PlaceMethod {
 public:
  PlaceMethod() = default;
  PlaceMethod(const PlaceMethod&) = delete;
  PlaceMethod& operator=(const PlaceMethod&) = delete;
  virtual ~PlaceMethod() = default;

  virtual std::string name() const = 0;
  /// Describes a panorama, CV_8UC1, 1080x540, as landmark or as query; some methods use different descriptors for the
  /// two.
  virtual std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const = 0;
  virtual std::unique_ptr<PlaceDescriptor> describe_query(const cv::Mat& panorama) const {
    return describe_landmark(panorama);
  }
  /// Both descriptors must come from this method.
  virtual PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const = 0;
};

}  // namespace panvo::evaluation
