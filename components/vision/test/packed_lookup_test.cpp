// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/packed_lookup.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "packed_lookup_kernels.hpp"

namespace panvo::vision {
namespace {

constexpr int kWidth = 61, kHeight = 47;
constexpr int kCount = 203;  // not a multiple of eight

cv::Mat noise(int channels, std::uint64_t seed) {
  cv::Mat image(kHeight, kWidth, CV_8UC(channels));
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

/// Random valid look-ups, including the last valid position.
std::vector<std::uint32_t> lookups(std::uint64_t seed) {
  cv::RNG random(seed);
  std::vector<std::uint32_t> packed;
  while (packed.size() < kCount) {
    const int x = packed.empty() ? kWidth - 4 : random.uniform(0, kWidth);
    const int y = packed.empty() ? kHeight - 2 : random.uniform(0, kHeight);
    if (!may_be_looked_up(x, y, kWidth, kHeight)) continue;
    packed.push_back(pack_lookup(static_cast<std::uint32_t>(y * kWidth + x),
                                 static_cast<std::uint32_t>(random.uniform(0, 32)),
                                 static_cast<std::uint32_t>(random.uniform(0, 32))));
  }
  return packed;
}

LookupSource source(const cv::Mat& image, int factor = kUnitFactor) { return {image.data, image.cols, factor}; }

TEST(PackedLookup, GivesTheMeanOfFourNeighbours) {
  cv::Mat image(8, 8, CV_8UC1, cv::Scalar(0));
  image.at<uchar>(2, 3) = 10;
  image.at<uchar>(2, 4) = 50;
  image.at<uchar>(3, 3) = 110;
  image.at<uchar>(3, 4) = 250;
  const std::uint32_t quarter_across_half_down = pack_lookup(2 * 8 + 3, 8, 16);
  std::uint8_t value = 0;
  look_up({image.data, 8, kUnitFactor}, &quarter_across_half_down, 1, 1, &value);
  EXPECT_EQ(value, 83);  // 0.5 * (0.75 * 10 + 0.25 * 50) + 0.5 * (0.75 * 110 + 0.25 * 250) = 82.5
}

TEST(PackedLookup, MultipliesByTheFactorAndEndsAtWhite) {
  const cv::Mat image(8, 8, CV_8UC3, cv::Scalar(40, 100, 200));
  const std::vector<std::uint32_t> anywhere(8, pack_lookup(9, 3, 30));
  std::vector<std::uint8_t> values(24);
  look_up({image.data, 8, 384}, anywhere.data(), 8, 3, values.data());
  EXPECT_EQ(std::vector(values.begin(), values.begin() + 3), (std::vector<std::uint8_t>{60, 150, 255}));
  EXPECT_EQ(std::vector(values.end() - 3, values.end()), (std::vector<std::uint8_t>{60, 150, 255}));
}

TEST(PackedLookup, BlendsByWeight) {
  const cv::Mat dark(8, 8, CV_8UC1, cv::Scalar(100));
  const cv::Mat bright(8, 8, CV_8UC1, cv::Scalar(200));
  const std::vector<std::uint32_t> anywhere(9, pack_lookup(9, 3, 30));
  const std::vector<std::uint8_t> weights{0, 64, 128, 192, 255, 1, 10, 128, 128};
  std::vector<std::uint8_t> values(9);
  look_up_blended({dark.data, 8, kUnitFactor}, anywhere.data(), {bright.data, 8, kUnitFactor}, anywhere.data(),
                  weights.data(), 9, 1, values.data());
  EXPECT_EQ(values, (std::vector<std::uint8_t>{100, 125, 150, 175, 200, 100, 104, 150, 150}));
}

TEST(PackedLookup, GivesTheSameBytesByAnyInstructionSet) {
#if defined(__x86_64__) || defined(__aarch64__)
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "this processor has no AVX2: nothing to compare";
  const LookupKernels &grey = kGreyLookupAvx2, &colour = kColourLookupAvx2;
#else
  const LookupKernels &grey = kGreyLookupNeon, &colour = kColourLookupNeon;
#endif
  for (const int channels : {1, 3}) {
    const cv::Mat a = noise(channels, 1), b = noise(channels, 2);
    const auto lookups_a = lookups(3), lookups_b = lookups(4);
    std::vector<std::uint8_t> weights(kCount);
    cv::RNG(5).fill(weights, cv::RNG::UNIFORM, 0, 256);
    const auto& fast = channels == 1 ? grey : colour;
    const LookupKernels plain = channels == 1 ? LookupKernels{look_up_plain<1>, blend_plain<1>}
                                              : LookupKernels{look_up_plain<3>, blend_plain<3>};
    for (const int factor : {0, 131, kUnitFactor, 300, kMaxFactor}) {
      const auto bytes = static_cast<std::size_t>(kCount * channels);
      std::vector<std::uint8_t> expected(bytes), found(bytes + 1, 77);
      plain.one(source(a, factor), lookups_a.data(), kCount, expected.data());
      fast.one(source(a, factor), lookups_a.data(), kCount, found.data());
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin())) << channels << " channels, " << factor;
      plain.blended(source(a, factor), lookups_a.data(), source(b, 200), lookups_b.data(), weights.data(), kCount,
                    expected.data());
      fast.blended(source(a, factor), lookups_a.data(), source(b, 200), lookups_b.data(), weights.data(), kCount,
                   found.data());
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin())) << channels << " channels, " << factor;
      EXPECT_EQ(found.back(), 77) << "written beyond the end";
    }
  }
#else
  GTEST_SKIP() << "only one version for this processor";
#endif
}

TEST(PackedLookup, RefusesOtherChannels) {
  std::uint8_t value = 0;
  const std::uint32_t lookup = 0;
  EXPECT_THROW(look_up({&value, 1, kUnitFactor}, &lookup, 0, 4, &value), std::invalid_argument);
}

TEST(PackedLookup, KeepsAwayFromTheImagesEnd) {
  EXPECT_TRUE(may_be_looked_up(0, 0, 10, 10));
  EXPECT_TRUE(may_be_looked_up(8, 7, 10, 10));
  EXPECT_FALSE(may_be_looked_up(9, 7, 10, 10));
  EXPECT_FALSE(may_be_looked_up(8, 8, 10, 10));  // last row: four pixels or eight bytes are read from it
  EXPECT_TRUE(may_be_looked_up(6, 8, 10, 10));
  EXPECT_FALSE(may_be_looked_up(0, 9, 10, 10));
  EXPECT_FALSE(may_be_looked_up(-1, 0, 10, 10));
}

}  // namespace
}  // namespace panvo::vision
