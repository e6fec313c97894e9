// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/result.hpp"
#include "panvo/vision/rectification.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::stereo_rectifier {

enum class Output {
  kMono8,  ///< grey; converted before rectification, a third of the work of rectifying colour
  kSame,   ///< encoding of the raw image
};

/// Rectifies the images of one camera of a stereo pair according to its camera_info.
class EyeRectifier {
 public:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;

  explicit EyeRectifier(Output output) : output_(output) {}

  enum class Change { kNone, kFirst, kChanged };
  /// Sets the camera_info received with each image; its header is ignored. Returns whether it differs from the last
  /// one.
  Change set_camera(const sensor_msgs::msg::CameraInfo& info);

  /// The camera, or why its camera_info is invalid; nullopt before the first camera_info.
  const std::optional<conversions::Result<conversions::PairedCamera>>& camera() const noexcept { return camera_; }

  /// Returns the rectified image, or `raw` itself if it is already rectified and has the output encoding; else the
  /// reason: no camera_info yet, or an invalid image or camera_info.
  conversions::Result<ImagePtr> rectify(const ImagePtr& raw);

 private:
  conversions::Result<ImagePtr> remap(const sensor_msgs::msg::Image& raw, const conversions::PairedCamera& camera);

  Output output_;
  sensor_msgs::msg::CameraInfo info_;
  std::optional<conversions::Result<conversions::PairedCamera>> camera_;
  std::optional<vision::RectificationMap> map_;  ///< created with the first image that needs it
};

}  // namespace panvo::stereo_rectifier
