// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stage_observer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace panvo::vision {
namespace {

class Recorder final : public StageObserver {
 public:
  void enter(std::string_view stage) override { events.emplace_back(stage); }
  void leave() override { events.emplace_back("leave"); }
  std::vector<std::string> events;
};

TEST(Stage, TellsItsNameAndItsEnd) {
  Recorder recorder;
  {
    const Stage outer(&recorder, "track");
    const Stage inner(&recorder, "detect");
  }
  EXPECT_THAT(recorder.events, ::testing::ElementsAre("track", "detect", "leave", "leave"));
}

TEST(Stage, NeedsNoObserver) { const Stage stage(nullptr, "match"); }

}  // namespace
}  // namespace panvo::vision
