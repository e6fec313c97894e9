// SPDX-License-Identifier: Apache-2.0
// Faults of cameras and cables.
#include <opencv2/imgproc.hpp>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

/// The images of one or both cameras freeze at the start of the fault; stamps continue.
Passage<StereoPair> frozen(bool left, bool right) {
  return [left, right, held = StereoPair{}](const StereoPair& pair, const Moment& moment) mutable {
    StereoPair passed = pair;
    if (!moment.is_on || held.left.empty()) {
      held = pair;
    } else {
      if (left) passed.left = held.left;
      if (right) passed.right = held.right;
    }
    return std::vector<StereoPair>{passed};
  };
}

Fault both_frozen(Draw&, const FaultWindow&) { return {.pairs = frozen(true, true)}; }
Fault left_frozen(Draw&, const FaultWindow&) { return {.pairs = frozen(true, false)}; }
Fault right_frozen(Draw&, const FaultWindow&) { return {.pairs = frozen(false, true)}; }

Passage<StereoPair> plain(int value) {
  return both_eyes([value](cv::Mat& image, const Moment&, int) { image.setTo(cv::Scalar::all(value)); });
}

Fault both_black(Draw&, const FaultWindow&) { return {.pairs = plain(0)}; }
Fault both_saturated(Draw&, const FaultWindow&) { return {.pairs = plain(255)}; }
Fault one_black(Draw& draw, const FaultWindow&) {
  const int dark_eye = draw.chance(0.5) ? 0 : 1;
  return {.pairs = both_eyes([dark_eye](cv::Mat& image, const Moment&, int eye) {
            if (eye == dark_eye) image.setTo(cv::Scalar::all(0));
          })};
}

/// Little light, so that sensor noise dominates.
Fault dark_noise(Draw& draw, const FaultWindow&) {
  return {.pairs = both_eyes([rng = draw.image_noise()](cv::Mat& image, const Moment&, int) mutable {
            cv::Mat noise(image.size(), CV_MAKETYPE(CV_16S, image.channels()));
            rng.fill(noise, cv::RNG::NORMAL, 8.0, 6.0);
            cv::Mat dark;
            image.convertTo(dark, noise.type(), 0.03);
            cv::Mat(dark + noise).convertTo(image, image.type());
          })};
}

Fault salt_and_pepper(Draw& draw, const FaultWindow&) {
  const double share = draw.uniform(0.05, 0.15);
  return {.pairs = both_eyes([rng = draw.image_noise(), share](cv::Mat& image, const Moment&, int) mutable {
            cv::Mat chance(image.size(), CV_32F);
            rng.fill(chance, cv::RNG::UNIFORM, 0.0, 1.0);
            image.setTo(cv::Scalar::all(0), chance < 0.5 * share);
            image.setTo(cv::Scalar::all(255), chance > 1.0 - 0.5 * share);
          })};
}

/// Random brightness in each frame.
Fault flicker(Draw& draw, const FaultWindow&) {
  return {.pairs = altered<StereoPair>([draw](StereoPair& pair, const Moment&) mutable {
            const double gain = draw.uniform(0.3, 1.8);
            StereoPair bright{pair.left_ns, pair.right_ns, {}, {}};
            pair.left.convertTo(bright.left, -1, gain);
            pair.right.convertTo(bright.right, -1, gain);
            pair = bright;
          })};
}

Fault eyes_swapped(Draw&, const FaultWindow&) {
  return {.pairs = altered<StereoPair>([](StereoPair& pair, const Moment&) { std::swap(pair.left, pair.right); })};
}

/// The images of one camera are late by a frame, with the stamps of the other camera.
Fault eye_delayed(Draw& draw, const FaultWindow&) {
  const bool is_left = draw.chance(0.5);
  return {.pairs = [is_left, before = cv::Mat()](const StereoPair& pair, const Moment& moment) mutable {
    StereoPair passed = pair;
    cv::Mat& late = is_left ? passed.left : passed.right;
    const cv::Mat now = late;
    if (moment.is_on && !before.empty()) late = before;
    before = now;
    return std::vector<StereoPair>{passed};
  }};
}

}  // namespace

std::vector<FaultKind> image_kinds() {
  return {
      {"both_frozen", "both cameras repeat the same image", Lasting::kWhile, both_frozen},
      {"left_frozen", "the left camera repeats the same image", Lasting::kWhile, left_frozen},
      {"right_frozen", "the right camera repeats the same image", Lasting::kWhile, right_frozen},
      {"both_black", "both images are black", Lasting::kWhile, both_black},
      {"one_black", "one image is black", Lasting::kWhile, one_black},
      {"saturated", "both images are white", Lasting::kWhile, both_saturated},
      {"dark_noise", "dark images dominated by noise", Lasting::kWhile, dark_noise},
      {"salt_and_pepper", "single pixels are black or white", Lasting::kWhile, salt_and_pepper},
      {"flicker", "random brightness in each frame", Lasting::kWhile, flicker},
      {"eyes_swapped", "left and right are swapped", Lasting::kWhile, eyes_swapped},
      {"eye_delayed", "one camera is late by a frame", Lasting::kWhile, eye_delayed},
  };
}

}  // namespace panvo::test
