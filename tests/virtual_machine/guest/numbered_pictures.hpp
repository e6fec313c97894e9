// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "descriptors.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::test {

/// JPEG files of both eyes side by side, in which a number can be read again: as stripes of black and white below, with the eye above.
class NumberedPictures {
 public:
  static constexpr std::uint32_t kCount = 64;  ///< then they repeat

  /// `width` of both eyes, px.
  NumberedPictures(int width, int height);

  const Bytes& file(std::uint32_t number) const { return files_.at(number % kCount); }

 private:
  std::vector<Bytes> files_;
};

/// What a picture of one eye shows.
struct NumberedPicture {
  std::uint32_t number = 0;
  bool is_right = false;
};

/// nullopt: it is none.
std::optional<NumberedPicture> read_number(const sensor_msgs::msg::Image& eye);

}  // namespace panvo::test
