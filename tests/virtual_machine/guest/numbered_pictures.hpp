// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "descriptors.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::test {

/// JPEG files of both views side by side that encode a number, as black and white stripes in the lower half, and the
/// eye in the upper half.
class NumberedPictures {
 public:
  static constexpr std::uint32_t kCount = 64;  ///< numbers repeat after these

  /// `width` of the whole image with both views, px.
  NumberedPictures(int width, int height);

  const Bytes& file(std::uint32_t number) const { return files_.at(number % kCount); }

 private:
  std::vector<Bytes> files_;
};

/// Decoded contents of the image of one eye.
struct NumberedPicture {
  std::uint32_t number = 0;
  bool is_right = false;
};

/// nullopt if the image is not a numbered picture.
std::optional<NumberedPicture> read_number(const sensor_msgs::msg::Image& eye);

}  // namespace panvo::test
