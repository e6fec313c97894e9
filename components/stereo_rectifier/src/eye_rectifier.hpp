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
  kMono8,  ///< grey, turned grey before it is rectified: a third of the work of rectifying colour
  kSame,   ///< the encoding of the raw image
};

/// Rectifies the images of one eye of a stereo camera as its camera_info says.
class EyeRectifier {
 public:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;

  explicit EyeRectifier(Output output) : output_(output) {}

  enum class Change { kNone, kFirst, kChanged };
  /// Takes in the camera_info that comes with each image; its header does not matter.
  Change set_camera(const sensor_msgs::msg::CameraInfo& info);

  /// The camera, or why its camera_info cannot be used; nullopt before the first camera_info.
  const std::optional<conversions::Result<conversions::PairedCamera>>& camera() const noexcept { return camera_; }

  /// The rectified image: `raw` itself if it is that already. To be called when camera() has a value; the reason says
  /// what is wrong with the image or camera_info.
  conversions::Result<ImagePtr> rectify(const ImagePtr& raw);

 private:
  conversions::Result<ImagePtr> remap(const sensor_msgs::msg::Image& raw, const conversions::PairedCamera& camera);

  Output output_;
  sensor_msgs::msg::CameraInfo info_;
  std::optional<conversions::Result<conversions::PairedCamera>> camera_;
  std::optional<vision::RectificationMap> map_;  ///< made when the first image needs it
};

}  // namespace panvo::stereo_rectifier
