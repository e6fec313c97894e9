// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "panvo/camera_group/group_image.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::camera_group {

/// An image's topic and that of its calibration. Not safe to use from several threads.
class ImagePublisher {
 public:
  ImagePublisher(runtime::Context& context, GroupImage description);

  /// With the image's stamp and frame; not where the image is of another size, to which it does not apply.
  void publish_calibration_of(const sensor_msgs::msg::Image& image);
  void publish(std::shared_ptr<sensor_msgs::msg::Image> image) { images_.publish(std::move(image)); }

  const std::string& name() const { return description_.role.name; }
  /// Why the calibration is not published; empty: it is, or there is none.
  const std::string& size_problem() const { return size_problem_; }

 private:
  runtime::Context& context_;
  GroupImage description_;
  runtime::Output<sensor_msgs::msg::Image> images_;
  runtime::Output<sensor_msgs::msg::CameraInfo> infos_;
  std::string size_problem_;
};

}  // namespace panvo::camera_group
