// SPDX-License-Identifier: Apache-2.0
// The store is saved while it is in use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "made_up_landmark.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/file_size_limit.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "save_caller.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// "/landmarks/save" of a component, in a replay: the played time is in the name of the copy.
class SaveService : public testing::Test {
 protected:
  void load(const std::string& file, const std::string& read_only = "false") {
    harness_.load("panvo_landmarks", "LandmarkStoreComponent",
                  {{"file", file}, {"read_only", read_only}, {"forget_after", "0"}});
  }
  void publish(const PanoramicLandmark& landmark) {
    harness_.publish(topics::kLandmarks, to_message(landmark, made_up_settings(), "map"));
  }
  SaveCaller::Response save() { return caller_.save(); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / ".")) {
      names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "campus.landmarks";
  const std::string copy_ = "campus_20231114T221340Z.landmarks";  // the stamp of the second made-up landmark
  runtime::ComponentHarness harness_;
  SaveCaller caller_{harness_};
};

TEST_F(SaveService, CopiesTheStoreWhileItIsInUse) {
  load(file_);
  publish(made_up_landmark(1));
  publish(made_up_landmark(2));
  const auto answer = save();
  EXPECT_TRUE(answer.success());
  EXPECT_EQ(answer.message(), "2 landmarks saved as " + copy_);
  EXPECT_THAT(files(), ElementsAre("campus.landmarks", copy_));
  publish(made_up_landmark(3));
  EXPECT_EQ(LandmarkStore(file_).size(), 3U) << "storing goes on";

  const LandmarkStore copy(folder_ / copy_);
  ASSERT_EQ(copy.size(), 2U);
  EXPECT_FALSE(copy.find_damage());
  EXPECT_EQ(copy.settings(), made_up_settings());
  EXPECT_EQ(copy.uses().size(), 2U);
  for (const std::uint32_t id : {1U, 2U}) {
    EXPECT_EQ(difference(copy.landmarks()[id - 1], made_up_landmark(id), false), "");
    EXPECT_EQ(copy.keypoints(id), made_up_landmark(id).keypoints);
    EXPECT_EQ(copy.thumbnail(id), made_up_landmark(id).thumbnail);
  }
}

TEST_F(SaveService, CopiesAStoreThatIsOnlyRead) {
  LandmarkStore(file_, made_up_settings()).add(made_up_landmark(1));
  const auto before = folder_.read(file_);
  load(file_, "true");
  EXPECT_TRUE(save().success());
  EXPECT_EQ(folder_.read(file_), before);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(SaveService, ReplacesNoFile) {
  load(file_);
  publish(made_up_landmark(1));
  publish(made_up_landmark(2));
  folder_.write(folder_ / copy_, "mine");
  const auto answer = save();
  EXPECT_FALSE(answer.success());
  EXPECT_THAT(answer.message(), HasSubstr(copy_ + ": already exists; save again in a second"));
  EXPECT_EQ(folder_.read(folder_ / copy_), "mine");
  EXPECT_THAT(files(), ElementsAre("campus.landmarks", copy_));
}

TEST_F(SaveService, SaysWhatToSetIfNothingIsStored) {
  load("");
  const auto answer = save();
  EXPECT_FALSE(answer.success());
  EXPECT_THAT(answer.message(), HasSubstr("set landmark_store.file"));
  EXPECT_TRUE(harness_.log_contains("warning landmarks: the map was not saved: nothing is stored"));
}

TEST_F(SaveService, SaysSoWhileThereIsNoLandmark) {
  load(file_);
  const auto answer = save();
  EXPECT_FALSE(answer.success());
  EXPECT_THAT(answer.message(), HasSubstr("no landmarks are stored yet"));
  EXPECT_THAT(files(), IsEmpty()) << "no store was made for the copy";
}

TEST_F(SaveService, LeavesNothingBehindIfTheDiskIsFull) {
  load(file_);
  publish(made_up_landmark(1));
  publish(made_up_landmark(2));
  const auto answer = [&] {
    const panvo::test::FileSizeLimit limit(8192);
    return save();
  }();
  EXPECT_FALSE(answer.success());
  EXPECT_THAT(answer.message(), HasSubstr(copy_ + ": cannot be written ("));
  EXPECT_THAT(answer.message(), HasSubstr("free disk space"));
  EXPECT_THAT(files(), ElementsAre("campus.landmarks"));
  EXPECT_EQ(LandmarkStore(file_).size(), 2U);
}

TEST_F(SaveService, SaysWhatIsNotInTheCopyYet) {
  load(file_);
  publish(made_up_landmark(1));
  sqlite::Database reader(file_, sqlite::Database::Mode::kRead);  // as another process that reads for long
  reader.execute("BEGIN");
  sqlite::Statement(reader, "SELECT count(*) FROM landmark").step();
  publish(made_up_landmark(2));
  const auto answer = save();
  EXPECT_TRUE(answer.success());
  EXPECT_EQ(answer.message(),
            "1 landmarks saved as " + copy_ + ", without 1 changes that wait until another process has read the store");
}

}  // namespace
}  // namespace panvo::landmarks
