// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::binocular_odometry {

/// Spares the slow matching of descriptors while it is fruitless, so that a camera that stays out of order does not take
/// the processor from the others.
class DescriptorTries {
 public:
  bool are_allowed(std::int64_t stamp_ns) const {
    return fruitless_ < kMost || stamp_ns - last_ns_ >= kPause_ns || stamp_ns < last_ns_;
  }
  void tried(std::int64_t stamp_ns, bool is_fruitless) {
    fruitless_ = is_fruitless ? fruitless_ + 1 : 0;
    last_ns_ = stamp_ns;
  }

 private:
  static constexpr int kMost = 5;                         // fruitless ones in a row, before they are spared
  static constexpr std::int64_t kPause_ns = 500'000'000;  // then: each takes about 0.1 s

  int fruitless_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace panvo::binocular_odometry
