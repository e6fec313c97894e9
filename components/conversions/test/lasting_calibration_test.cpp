// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/lasting_calibration.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace panvo::conversions {
namespace {

struct SizedCalibration {
  int width_px = 640;
  double focal_px = 400.0;
  bool operator==(const SizedCalibration&) const = default;
};

constexpr SizedCalibration kFirstOne{640, 400.0}, kOfSameSize{640, 410.0}, kSmaller{320, 200.0};

class LastingCalibrationTest : public testing::Test {
 protected:
  bool image(int width_px = 640) {
    return camera.add_image([&](const SizedCalibration& one) { return one.width_px == width_px; });
  }

  LastingCalibration<SizedCalibration> camera;
};

TEST_F(LastingCalibrationTest, IsTheLastOneBeforeTheFirstImage) {
  EXPECT_FALSE(image());
  EXPECT_FALSE(camera.used());
  EXPECT_FALSE(camera.add(kFirstOne));
  EXPECT_FALSE(camera.add(kOfSameSize));
  EXPECT_FALSE(image());
  EXPECT_EQ(camera.used(), kOfSameSize);
}

TEST_F(LastingCalibrationTest, IsAnotherOneThatComesWithEachImageOrOnce) {
  for (const bool comes_once : {false, true}) {
    camera = {};
    camera.add(kFirstOne);
    image();
    for (int i = 1; i < camera.kLasting; ++i) {
      const bool comes = i == 1 || !comes_once;
      EXPECT_FALSE(comes && camera.add(kOfSameSize));
      EXPECT_FALSE(image()) << i;
      EXPECT_EQ(camera.used(), kFirstOne);
    }
    EXPECT_TRUE(image());
    EXPECT_EQ(camera.used(), kOfSameSize);
  }
}

TEST_F(LastingCalibrationTest, StaysIfTwoPublishersDisagree) {
  int told = 0;
  for (int i = 0; i < 40; ++i) {
    told += camera.add(kFirstOne) ? 1 : 0;
    EXPECT_FALSE(image());
    told += camera.add(kOfSameSize) ? 1 : 0;
    EXPECT_FALSE(image());
    EXPECT_FALSE(i % 2 == 0 && camera.add(kOfSameSize));
  }
  EXPECT_EQ(camera.used(), kFirstOne);
  EXPECT_EQ(told, 1);
}

TEST_F(LastingCalibrationTest, IsThatOfImagesOfAnotherSizeAtOnce) {
  camera.add(kFirstOne);
  image();
  camera.add(kSmaller);
  EXPECT_FALSE(image(640)) << "one that was on its way";
  EXPECT_TRUE(image(320));
  EXPECT_EQ(camera.used(), kSmaller);
}

TEST_F(LastingCalibrationTest, ChangesAtMostOnceIfTwoPublishersOfOtherSizesDisagree) {
  int changes = 0, told = 0;
  for (int i = 0; i < 40; ++i) {
    for (const auto& one : {kFirstOne, kSmaller}) {
      told += camera.add(one) ? 1 : 0;
      changes += image(one.width_px) ? 1 : 0;
    }
  }
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(told, 1);
}

class LastingCalibrationOfAPair : public testing::Test {
 protected:
  LastingCalibrationOfAPair() {
    left.add(kFirstOne);
    right.add(kFirstOne);
    pair();
  }

  bool pair(int width_px = 640) {
    const auto fits = [&](const SizedCalibration& one) { return one.width_px == width_px; };
    return LastingCalibration<SizedCalibration>::add_images(left, fits, right, fits);
  }

  static constexpr int kLasting = LastingCalibration<SizedCalibration>::kLasting;
  LastingCalibration<SizedCalibration> left, right;
};

TEST_F(LastingCalibrationOfAPair, ChangesOnceIfTheOtherCamerasComesSomePairsLater) {
  for (auto [first, second] : {std::pair(&left, &right), std::pair(&right, &left)}) {
    for (int later = 0; later < kLasting; ++later) {
      left = right = {};
      for (auto* camera : {&left, &right}) camera->add(kFirstOne);
      pair();
      for (int i = 1; i <= 3 * kLasting; ++i) {
        first->add(kOfSameSize);
        if (i > later) second->add(kOfSameSize);
        EXPECT_EQ(pair(), i == kLasting + later) << later << " later, " << i;
        EXPECT_EQ(left.used(), right.used()) << later << " later, " << i;
      }
      EXPECT_EQ(left.used(), kOfSameSize);
    }
  }
}

TEST_F(LastingCalibrationOfAPair, ChangesAsSoonIfOnlyOneDoes) {
  for (int i = 1; i <= 3 * kLasting; ++i) {
    right.add(kOfSameSize);
    EXPECT_EQ(pair(), i == kLasting) << i;
  }
  EXPECT_EQ(left.used(), kFirstOne);
  EXPECT_EQ(right.used(), kOfSameSize);
}

TEST_F(LastingCalibrationOfAPair, DoesNotWaitForEverForPublishersThatDisagreeOnTheOther) {
  for (int i = 1; i <= 3 * kLasting; ++i) {
    left.add(kOfSameSize);
    right.add(kFirstOne);
    right.add(kOfSameSize);
    EXPECT_EQ(pair(), i == 2 * kLasting) << i;
  }
  EXPECT_EQ(left.used(), kOfSameSize);
  EXPECT_EQ(right.used(), kFirstOne);
}

TEST_F(LastingCalibrationOfAPair, OfAnotherSizeIsUsedAtOnce) {
  left.add(kSmaller);
  EXPECT_TRUE(pair(320));
  EXPECT_EQ(left.used(), kSmaller);
  right.add(kSmaller);
  EXPECT_TRUE(pair(320));
  EXPECT_EQ(right.used(), kSmaller);
}

}  // namespace
}  // namespace panvo::conversions
