// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "panvo/camera_group/group_image.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::camera_group {

/// Publishes an image and its calibration. Not thread-safe.
class ImagePublisher {
 public:
  ImagePublisher(runtime::Context& context, GroupImage description);

  /// Publishes the calibration with the image's stamp and frame, unless the image has another size.
  void publish_calibration_of(const sensor_msgs::msg::Image& image);
  void publish(std::shared_ptr<sensor_msgs::msg::Image> image) { images_.publish(std::move(image)); }

  const std::string& name() const { return description_.role.name; }
  /// Why the calibration is not published; empty if it is, or if there is none.
  const std::string& size_problem() const { return size_problem_; }

 private:
  runtime::Context& context_;
  GroupImage description_;
  runtime::Output<sensor_msgs::msg::Image> images_;
  runtime::Output<sensor_msgs::msg::CameraInfo> infos_;
  std::string size_problem_;
};

}  // namespace panvo::camera_group
