// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/lasting_calibration.hpp"
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

  enum class Info { kKnown, kTaken, kDisputed };
  /// Adds a camera_info; its header is ignored. kTaken: it is used from now on. kDisputed, once: two publishers disagree.
  Info add_info(const sensor_msgs::msg::CameraInfo& info);
  /// To be called with each raw image, before rectify(). Whether another camera_info is used from this image on.
  bool add_image(const sensor_msgs::msg::Image& raw);

  /// The camera, or why its camera_info is invalid; nullopt before the first camera_info.
  const std::optional<conversions::Result<conversions::PairedCamera>>& camera() const noexcept { return camera_; }

  /// Returns the rectified image, or `raw` itself if it is already rectified and has the output encoding; else the
  /// reason: no camera_info yet, or an invalid image or camera_info.
  conversions::Result<ImagePtr> rectify(const ImagePtr& raw);

 private:
  conversions::Result<ImagePtr> remap(const sensor_msgs::msg::Image& raw, const conversions::PairedCamera& camera);

  void use_info();

  Output output_;
  conversions::LastingCalibration<sensor_msgs::msg::CameraInfo> infos_;  // without headers
  std::optional<conversions::Result<conversions::PairedCamera>> camera_;
  std::optional<vision::RectificationMap> map_;  ///< created with the first image that needs it
};

}  // namespace panvo::stereo_rectifier
