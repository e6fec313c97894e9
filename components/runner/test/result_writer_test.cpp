// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/result_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <vector>

#include "panvo/test/temporary_folder.hpp"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "run_samples.hpp"

namespace panvo::runner {
namespace {

using panvo::test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void ignore(const std::string&) {}

TEST(ResultWriter, WritesAllMessagesInTheirOrder) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  ResultWriter writer(&files, ignore);
  const int count = 3 * static_cast<int>(ResultWriter::kCapacity);
  std::string expected;
  for (int second = 1; second <= count; ++second) {
    writer.add(kBinocular, sample_of(odometry_at(second, 0, second)));
    expected += std::to_string(second) + ".000000000 " + std::to_string(second) + " 0 0 0 0 0 1\n";
  }
  writer.finish();
  EXPECT_EQ(folder.read("odometry_binocular.tum"), expected);
}

TEST(ResultWriter, CountsFramesAlsoWithoutFiles) {
  ResultWriter writer(nullptr, ignore);
  panvo_msgs::msg::OdometryQuality quality;
  const auto qualities = topic_of<panvo_msgs::msg::OdometryQuality>("/odometry/quality");
  writer.add(qualities, sample_of(quality));
  quality.reliable(true);
  writer.add(qualities, sample_of(quality));
  writer.add(kBinocular, sample_of(odometry_at(1, 0, 0)));
  writer.add(odometry_topic("/robot/stereo/left/image_rect"), nullptr);
  EXPECT_EQ(writer.frames_in(), 1U);
  EXPECT_EQ(writer.frames_out(), 1U);
  EXPECT_EQ(writer.frames_unreliable(), 1U);
}

TEST(ResultWriter, ReportsAFailureOnceAndReleasesThePublishers) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  std::filesystem::remove_all(folder.path());  // no file can be created in it
  std::vector<std::string> problems;
  std::promise<void> is_full;
  ResultWriter writer(&files, [&](const std::string& problem) {
    problems.push_back(problem);
    is_full.get_future().wait();  // the queue fills behind the failed message
  });
  for (std::size_t i = 0; i <= ResultWriter::kCapacity; ++i) writer.add(kBinocular, sample_of(odometry_at(1, 0, 0)));
  auto blocked = std::async(std::launch::async, [&] { writer.add(kBinocular, sample_of(odometry_at(2, 0, 0))); });
  is_full.set_value();
  blocked.get();
  writer.finish();
  EXPECT_THAT(problems, ElementsAre(HasSubstr("cannot write " + (folder.path() / "odometry_binocular.tum").string())));
}

TEST(ResultWriter, DiscardsWhatComesAfterTheEnd) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  ResultWriter writer(&files, ignore);
  writer.finish();
  writer.add(kBinocular, sample_of(odometry_at(1, 0, 0)));
  writer.finish();
  EXPECT_EQ(files.lines(), 0U);
}

}  // namespace
}  // namespace panvo::runner
