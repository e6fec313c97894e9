// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace panvo::evaluation {

/// How different two panoramas are, and how the vehicle is turned between them.
struct PlaceDistance {
  double distance = 0.0;  ///< in the method's own unit; smaller: more alike
  double heading_rad =
      0.0;  ///< yaw at the query minus yaw at the landmark, left positive; 0 where the method knows none
};

/// What a method keeps of a panorama.
class PlaceDescriptor {
 public:
  PlaceDescriptor() = default;
  PlaceDescriptor(const PlaceDescriptor&) = delete;
  PlaceDescriptor& operator=(const PlaceDescriptor&) = delete;
  virtual ~PlaceDescriptor() = default;
};

/// A way to tell places apart by their panoramas: ours, or one to compare it with. Pure, and the same for the same input.
class PlaceMethod {
 public:
  PlaceMethod() = default;
  PlaceMethod(const PlaceMethod&) = delete;
  PlaceMethod& operator=(const PlaceMethod&) = delete;
  virtual ~PlaceMethod() = default;

  virtual std::string name() const = 0;
  /// Of a panorama CV_8UC1, 1080x540, as a landmark and as a query; some keep different things of the two.
  virtual std::unique_ptr<PlaceDescriptor> describe_landmark(const cv::Mat& panorama) const = 0;
  virtual std::unique_ptr<PlaceDescriptor> describe_query(const cv::Mat& panorama) const {
    return describe_landmark(panorama);
  }
  /// Of descriptors of this method only.
  virtual PlaceDistance distance(const PlaceDescriptor& query, const PlaceDescriptor& landmark) const = 0;
};

}  // namespace panvo::evaluation
