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
    count_image(fits);
    return use_lasting();
  }

  /// The same for each pair of images of two cameras. Both are calibrated at once, but two drivers tell it one after the
  /// other: one that lasts waits for the other, up to as many images again, so that a pair of the two is not used.
  template <class FitsLeft, class FitsRight>
  static bool add_images(LastingCalibration& left, const FitsLeft& fits_left, LastingCalibration& right,
                         const FitsRight& fits_right) {
    left.count_image(fits_left);
    right.count_image(fits_right);
    const bool does_left_wait = left.waits_for(right), does_right_wait = right.waits_for(left);
    const bool is_left_new = !does_left_wait && left.use_lasting();
    const bool is_right_new = !does_right_wait && right.use_lasting();
    return is_left_new || is_right_new;
  }

  /// nullopt before the first one.
  const std::optional<Calibration>& used() const noexcept { return used_; }

 private:
  template <class Fits>
  void count_image(const Fits& fits) {
    has_images_ |= used_.has_value();
    is_only_fit_ = false;
    if (!other_) return;
    const bool was_used = former_ && *former_ == *other_;  // publishers with other sizes would take turns
    is_only_fit_ = fits(*other_) && !fits(*used_) && !was_used;
    ++images_of_other_;
  }

  bool lasts() const { return other_ && (images_of_other_ >= kLasting || is_only_fit_); }

  /// For the sake of two publishers that disagree on the other, not for ever.
  bool waits_for(const LastingCalibration& other) const {
    return lasts() && !is_only_fit_ && images_of_other_ < 2 * kLasting && other.other_ && !other.lasts();
  }

  bool use_lasting() {
    if (!lasts()) return false;
    former_ = std::exchange(used_, std::exchange(other_, std::nullopt));
    return true;
  }

  std::optional<Calibration> used_, former_;
  std::optional<Calibration> other_;  // since the last image with the one in use
  int images_of_other_ = 0;
  bool has_images_ = false, is_disputed_ = false;
  bool is_only_fit_ = false;  // the other one, of the last image
};

}  // namespace panvo::conversions
