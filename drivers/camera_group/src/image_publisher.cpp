// SPDX-License-Identifier: Apache-2.0
#include "image_publisher.hpp"

#include <utility>

#include "panvo/camera_stream/camera_info_file.hpp"

namespace panvo::camera_group {

ImagePublisher::ImagePublisher(runtime::Context& context, GroupImage description)
    : context_(context),
      description_(std::move(description)),
      images_(context.output(description_.role.images)),
      infos_(context.output(description_.role.infos)) {}

void ImagePublisher::publish_calibration_of(const sensor_msgs::msg::Image& image) {
  const auto& calibration = description_.calibration;
  if (!calibration) return;
  auto problem =
      camera_stream::size_problem(*calibration, static_cast<int>(image.width()), static_cast<int>(image.height()));
  if (problem != size_problem_) {
    size_problem_ = problem;
    if (!problem.empty())
      context_.log().warn_throttled(name(), "{}: {}; images are published without camera_info", name(), problem);
  }
  if (!problem.empty()) return;
  auto info = *calibration;
  info.header() = image.header();
  infos_.publish(std::move(info));
}

}  // namespace panvo::camera_group
