// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_msgs/msg/Image.h"
#include "transport.hpp"

namespace panvo::bench {

inline sensor_msgs::msg::Image make_image(const ImageFormat& format) {
  sensor_msgs::msg::Image image;
  image.encoding(format.encoding);
  image.width(format.width);
  image.height(format.height);
  image.step(format.step());
  image.data().resize(format.bytes());
  return image;
}

}  // namespace panvo::bench
