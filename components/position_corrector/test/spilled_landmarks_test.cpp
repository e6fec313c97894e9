// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/spilled_landmarks.hpp"

#include <gtest/gtest.h>

#include <random>

#include "panvo/test/file_size_limit.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::position_corrector {
namespace {

using panvo::test::TemporaryFolder;

std::vector<landmarks::Keypoint> some_keypoints(unsigned seed, std::size_t count) {
  std::mt19937_64 random(seed);
  const auto any = [&] { return static_cast<float>(random() % 100'000) * 1e-3F; };
  std::vector<landmarks::Keypoint> keypoints(count);
  for (auto& keypoint : keypoints) {
    keypoint.bearing = Eigen::Vector3f{any(), any(), any()}.normalized();
    keypoint.size_px = any();
    for (auto& byte : keypoint.descriptor) byte = static_cast<std::uint8_t>(random());
    keypoint.has_point = random() % 2 == 0;
    keypoint.point_in_panorama = Eigen::Vector3f{any(), -any(), any()};
    keypoint.inverse_range_sigma = any();
  }
  return keypoints;
}

TEST(SpilledLandmarks, ComeBackBitForBit) {
  const TemporaryFolder folder;
  SpilledLandmarks spilled(folder.path());
  ASSERT_EQ(spilled.problem(), "");
  for (unsigned id = 1; id <= 20; ++id) spilled.put(id, some_keypoints(id, 10 * id));
  for (unsigned id = 20; id >= 1; --id) EXPECT_EQ(spilled.keypoints(id), some_keypoints(id, 10 * id)) << id;
  EXPECT_EQ(spilled.bytes_in_file(), 2100U * 164U);
}

landmarks::PanoramaDescription some_description(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto any = [&] { return static_cast<float>(random() % 100'000) * 1e-3F; };
  landmarks::PanoramaDescription description;
  description.histogram = {any(), any(), any()};
  for (unsigned i = 0; i < 5 + seed; ++i) {
    description.large.push_back({static_cast<std::uint16_t>(random()), any(), any(), any()});
    if (i % 2 == 0) description.small.push_back({static_cast<std::uint16_t>(random()), -any(), any(), any()});
  }
  return description;
}

TEST(SpilledLandmarks, KeepDescriptionsBesideKeypoints) {
  const TemporaryFolder folder;
  for (const bool is_on_disk : {true, false}) {
    SpilledLandmarks spilled(is_on_disk ? folder.path() : "");
    for (unsigned id = 1; id <= 5; ++id) spilled.put(id, some_keypoints(id, 3 * id), some_description(id));
    for (unsigned id = 5; id >= 1; --id) {
      EXPECT_EQ(spilled.description(id), some_description(id)) << id;
      EXPECT_EQ(spilled.keypoints(id), some_keypoints(id, 3 * id)) << id;
    }
    EXPECT_EQ(spilled.description(6), landmarks::PanoramaDescription());
  }
}

TEST(SpilledLandmarks, AreThoseThatWerePutLast) {
  const TemporaryFolder folder;
  SpilledLandmarks spilled(folder.path());
  spilled.put(1, some_keypoints(1, 50));
  spilled.put(2, some_keypoints(2, 50));
  spilled.put(1, some_keypoints(3, 70));
  EXPECT_EQ(spilled.keypoints(1), some_keypoints(3, 70));
  EXPECT_EQ(spilled.keypoints(2), some_keypoints(2, 50));
}

TEST(SpilledLandmarks, AreNoneOfALandmarkThatHasNoneOrIsNotKnown) {
  const TemporaryFolder folder;
  SpilledLandmarks spilled(folder.path());
  spilled.put(1, {});
  EXPECT_TRUE(spilled.keypoints(1).empty());
  EXPECT_TRUE(spilled.keypoints(2).empty());
}

TEST(SpilledLandmarks, StayInMemoryWhereNoFileCanBeMadeAndSayWhy) {
  const TemporaryFolder folder;
  SpilledLandmarks spilled(folder / "no/such/folder");
  EXPECT_NE(spilled.problem().find("no/such/folder (No such file or directory)"), std::string::npos)
      << spilled.problem();
  spilled.put(1, some_keypoints(1, 50));
  EXPECT_EQ(spilled.keypoints(1), some_keypoints(1, 50));
  EXPECT_EQ(spilled.bytes_in_file(), 0U);
}

TEST(SpilledLandmarks, StayInMemoryWhenTheDiskIsFullAndThoseBeforeCanStillBeRead) {
  const TemporaryFolder folder;
  SpilledLandmarks spilled(folder.path());
  spilled.put(1, some_keypoints(1, 50));
  {
    const test::FileSizeLimit limit(50 * 164 + 1000);
    spilled.put(2, some_keypoints(2, 50));
  }
  EXPECT_NE(spilled.problem().find("cannot write"), std::string::npos) << spilled.problem();
  spilled.put(3, some_keypoints(3, 50));
  for (unsigned id = 1; id <= 3; ++id) EXPECT_EQ(spilled.keypoints(id), some_keypoints(id, 50)) << id;
}

TEST(SpilledLandmarks, StayInMemoryWhereNoFolderIsNamed) {
  SpilledLandmarks spilled("");
  spilled.put(1, some_keypoints(1, 5));
  EXPECT_EQ(spilled.keypoints(1), some_keypoints(1, 5));
  EXPECT_EQ(spilled.problem(), "");
}

}  // namespace
}  // namespace panvo::position_corrector
