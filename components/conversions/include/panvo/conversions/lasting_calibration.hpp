// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

namespace panvo::conversions {

/// Which calibration of a camera_info topic is used. Another one than the first is used when it lasts: when the one in
/// use did not come again with the next `kLasting` images, which also holds if it is sent only once. Two publishers of
/// one topic that disagree thus change nothing, if the one in use comes at least every fifth image. Of a camera that
/// restarts with other images, it is used from the first of them that only it fits.
/// `Calibration`: can be compared.
template <class Calibration>
class LastingCalibration {
 public:
  static constexpr int kLasting = 5;

  /// Of a camera_info. True, once, if the one in use came again after another: two publishers disagree.
  bool add(Calibration received) {
    if (used_ && has_images_ && !(received == *used_)) {
      if (!other_ || !(*other_ == received)) images_of_other_ = 0;
      other_ = std::move(received);
      return false;
    }
    used_ = std::move(received);
    const bool is_back = std::exchange(other_, std::nullopt).has_value();
    return is_back && !std::exchange(is_disputed_, true);
  }

  /// Uses it from now on.
  void set(Calibration calibration) {
    used_ = std::move(calibration);
    other_.reset();
  }

  /// To be called with each image. `fits(calibration)`: whether it is for images of that size. Returns whether another
  /// calibration is used from this image on.
  template <class Fits>
  bool add_image(const Fits& fits) {
    has_images_ |= used_.has_value();
    if (!other_) return false;
    const bool was_used = former_ && *former_ == *other_;  // publishers with other sizes would take turns
    const bool is_only_fit = fits(*other_) && !fits(*used_) && !was_used;
    if (++images_of_other_ < kLasting && !is_only_fit) return false;
    former_ = std::exchange(used_, std::exchange(other_, std::nullopt));
    return true;
  }

  /// nullopt before the first one.
  const std::optional<Calibration>& used() const noexcept { return used_; }

 private:
  std::optional<Calibration> used_, former_;
  std::optional<Calibration> other_;  // since the last image with the one in use
  int images_of_other_ = 0;
  bool has_images_ = false, is_disputed_ = false;
};

}  // namespace panvo::conversions
