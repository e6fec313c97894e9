// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/interfaces/place_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

/// Runs SQL on a file, like another program would.
void tamper(const std::filesystem::path& file, const std::string& sql) {
  sqlite::Database(file, sqlite::Database::Mode::kCreate).execute(sql);
}

class Store : public testing::Test {
 protected:
  void write(std::uint32_t count, std::size_t keypoints = 20) {
    LandmarkStore store(file_, made_up_settings());
    for (std::uint32_t id = 1; id <= count; ++id) store.add(made_up_landmark(id, keypoints));
  }
  std::string error_of_reading() {
    return error_of<StoreError>([&] {
      const LandmarkStore store(file_);
      for (const auto& landmark : store.landmarks()) {
        store.keypoints(landmark.id);
        store.thumbnail(landmark.id);
      }
    });
  }
  std::string error_of_writing(const DescriptionSettings& settings = made_up_settings()) {
    return error_of<StoreError>([&] { LandmarkStore(file_, settings).add(made_up_landmark(77)); });
  }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "places.landmarks";
};

TEST_F(Store, GivesBackWhatWasAdded) {
  write(5);
  const LandmarkStore store(file_);
  EXPECT_EQ(store.size(), 5u);
  EXPECT_EQ(store.settings(), made_up_settings());
  std::uint32_t id = 0;
  for (auto landmark : store.landmarks()) {
    EXPECT_TRUE(landmark.keypoints.empty());
    landmark.keypoints = store.keypoints(landmark.id);
    landmark.thumbnail = store.thumbnail(landmark.id);
    EXPECT_EQ(difference(landmark, made_up_landmark(++id)), "");
  }
  EXPECT_EQ(id, 5u);
  EXPECT_TRUE(store.keypoints(6).empty());
  EXPECT_TRUE(store.thumbnail(6).empty());
  EXPECT_EQ(store.find_damage(), std::nullopt);
}

TEST_F(Store, IsContinuedByASecondSession) {
  write(3);
  LandmarkStore store(file_, made_up_settings());
  auto next = made_up_landmark(9);
  next.id = 0;
  EXPECT_EQ(store.add(next), 4u);
  EXPECT_EQ(LandmarkStore(file_).size(), 4u);
}

TEST_F(Store, MovesLandmarksAllOrNone) {
  write(3);
  LandmarkStore store(file_, made_up_settings());
  std::vector<LandmarkPose> poses(2);
  poses[0] = {2, made_up_landmark(20).map_from_base, made_up_landmark(20).covariance};
  poses[1].id = 99;
  store.set_poses(poses);
  auto expected = made_up_landmark(2);
  expected.map_from_base = made_up_landmark(20).map_from_base;
  expected.covariance = made_up_landmark(20).covariance;
  EXPECT_EQ(difference(store.landmarks().at(1), expected, false), "");
  EXPECT_EQ(difference(store.landmarks().at(0), made_up_landmark(1), false), "");
  EXPECT_EQ(store.size(), 3u);

  poses[1].map_from_base.translation().x() = std::nan("");
  poses[0].map_from_base = Eigen::Isometry3d::Identity();
  EXPECT_THROW(store.set_poses(poses), std::invalid_argument);
  EXPECT_EQ(difference(store.landmarks().at(1), expected, false), "");
}

TEST_F(Store, KeepsTwoLandmarksAtOnePlace) {
  LandmarkStore store(file_, made_up_settings());
  auto landmark = made_up_landmark(1);
  store.add(landmark);
  landmark.id = 2;
  store.add(landmark);
  EXPECT_EQ(store.size(), 2u);
}

TEST_F(Store, RefusesATakenIdAndValuesThatAreNone) {
  LandmarkStore store(file_, made_up_settings());
  store.add(made_up_landmark(1));
  EXPECT_THAT(error_of<StoreError>([&] { store.add(made_up_landmark(1)); }),
              HasSubstr("already contains landmark 1; is another process writing to it?"));
  auto broken = made_up_landmark(2);
  broken.description.small[5].value = std::nanf("");
  EXPECT_THROW(store.add(broken), std::invalid_argument);
  broken = made_up_landmark(2);
  broken.covariance(3, 3) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(store.add(broken), std::invalid_argument);
  broken = made_up_landmark(2);
  broken.id = interfaces::kMaxLandmarkId + 1;
  EXPECT_THROW(store.add(broken), std::invalid_argument);
  EXPECT_EQ(store.size(), 1u);
}

TEST_F(Store, OfOtherSettingsIsRefusedWithWhatDiffers) {
  write(1);
  const auto error = error_of_writing({{"band_rows", "150"}, {"seed", "2"}, {"kind", "cf"}});
  EXPECT_THAT(error, HasSubstr("places.landmarks: its landmarks were described with other settings: "
                               "kind is not set there, cf here; seed is 1 there, 2 here."));
  EXPECT_THAT(error, HasSubstr("Use the settings of the store, or another file"));
  EXPECT_THAT(error, Not(HasSubstr("band_rows")));
  EXPECT_EQ(LandmarkStore(file_).size(), 1u);
}

TEST_F(Store, OfAnotherVersionIsRefused) {
  write(1);
  tamper(file_, "PRAGMA user_version=7");
  for (const auto& error : {error_of_reading(), error_of_writing()}) {
    EXPECT_THAT(error, HasSubstr("places.landmarks: has layout 7; this version of panvo reads 1. Use the version"));
  }
}

TEST_F(Store, ThatIsNoneIsRefusedAndLeftAlone) {
  tamper(file_, "CREATE TABLE messages(id INTEGER)");
  const auto before = folder_.read(file_);
  EXPECT_THAT(error_of_reading(), HasSubstr("is a database, but not a landmark store"));
  EXPECT_THAT(error_of_writing(), HasSubstr("is a database, but not a landmark store"));
  EXPECT_EQ(folder_.read(file_), before);
  folder_.write(file_, "a letter to somebody, longer than the header of a database would be, whatever that may be");
  EXPECT_THAT(error_of_reading(), HasSubstr("is not a landmark store"));
  EXPECT_THAT(error_of_writing(), HasSubstr("is not a landmark store"));
  EXPECT_THAT(folder_.read(file_), HasSubstr("a letter"));
}

TEST_F(Store, ThatIsMissingOrEmptyIsToldToReadersAndMadeByWriters) {
  EXPECT_THAT(error_of_reading(), HasSubstr("places.landmarks: does not exist"));
  folder_.write(file_, "");
  EXPECT_THAT(error_of_reading(), HasSubstr("places.landmarks: is empty"));
  EXPECT_EQ(error_of_writing(), "");
  EXPECT_EQ(error_of_reading(), "");
}

TEST_F(Store, InAPlaceThatIsNoneIsRefused) {
  EXPECT_THAT(error_of<StoreError>([&] { LandmarkStore(folder_.path(), made_up_settings()); }),
              HasSubstr("is a folder"));
  EXPECT_THAT(error_of<StoreError>([&] { LandmarkStore(folder_ / "no/such", made_up_settings()); }),
              HasSubstr("no/such: cannot be created: its folder does not exist; create it first"));
}

TEST_F(Store, CutOffAnywhereIsRefusedWithWhatIsLeftToDo) {
  write(5);
  const auto whole = folder_.read(file_);
  for (int part = 1; part < 40; ++part) {
    const auto size = whole.size() * static_cast<std::size_t>(part) / 40 + static_cast<std::size_t>(part % 3);
    folder_.write(file_, whole.substr(0, size));
    const auto expected = "is damaged: truncated after " + std::to_string(size) + " of " +
                          std::to_string(whole.size()) + " bytes; restore a copy, or start";
    EXPECT_THAT(error_of_reading(), HasSubstr(expected));
    EXPECT_THAT(error_of_writing(), HasSubstr(expected));
  }
}

TEST_F(Store, WithBytesFlippedNeverCrashesAndNamesTheFile) {
  write(5);
  const auto whole = folder_.read(file_);
  std::mt19937_64 random(1);
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    auto damaged = whole;
    for (int i = 0; i < 100; ++i) damaged[random() % whole.size()] = static_cast<char>(random() >> 56);
    folder_.write(file_, damaged);
    const auto error = error_of_reading();
    if (error.empty()) continue;
    ++refused;
    EXPECT_THAT(error, HasSubstr("places.landmarks: "));
  }
  EXPECT_GT(refused, 50);
}

TEST_F(Store, WithAHoleIsFoundDamagedByItsCheck) {
  write(20);
  auto damaged = folder_.read(file_);
  std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / 2), damaged.end() - 5000, '\0');
  folder_.write(file_, damaged);
  EXPECT_NE(LandmarkStore(file_).find_damage(), std::nullopt);
}

TEST_F(Store, LeavesOutALandmarkOfValuesThatAreNoneAndSaysWhich) {
  write(3);
  tamper(file_, "UPDATE landmark SET covariance = x'00' WHERE id = 2");
  tamper(file_, "UPDATE landmark SET x = 1e200 WHERE id = 3");
  const LandmarkStore store(file_);
  std::vector<std::string> told;
  const auto landmarks = store.landmarks([&](const std::string& problem) { told.push_back(problem); });
  ASSERT_EQ(landmarks.size(), 1u);
  EXPECT_EQ(landmarks.front().id, 1u);
  EXPECT_THAT(told, testing::ElementsAre("landmark 2: contains invalid values",
                                         "landmark 3: pose.pose.position is beyond +-1e+08"));
  EXPECT_THAT(store.find_damage().value_or(""), HasSubstr("landmark 2: contains invalid values; landmark 3"));
}

TEST_F(Store, LeavesOutALandmarkWhoseIdIsTooLarge) {
  write(3);
  tamper(file_, "UPDATE landmark SET id = 4294967298 WHERE id = 2");  // 2 once it is cut to 32 bits
  tamper(file_, "UPDATE landmark SET id = 0 WHERE id = 3");
  const LandmarkStore store(file_);
  std::vector<std::string> problems;
  EXPECT_EQ(store.landmarks([&](const std::string& problem) { problems.push_back(problem); }).size(), 1u);
  EXPECT_THAT(problems, testing::UnorderedElementsAre("landmark 4294967298: its id is not in 1 to 4000000000",
                                                      "landmark 0: its id is not in 1 to 4000000000"));
}

TEST_F(Store, LeavesOutALandmarkWithARowThatItsMatrixDoesNotHave) {
  const DescriptionSettings settings{{"patches", "400"}, {"seed", "1"}};
  {
    LandmarkStore store(file_, settings);
    for (const std::uint32_t id : {1u, 2u}) store.add(made_up_landmark(id));
    auto broken = made_up_landmark(3);
    broken.description.large[7].row = 800;
    EXPECT_THROW(store.add(broken), std::invalid_argument);
  }
  tamper(file_, "UPDATE landmark SET large_features = x'ffff0000000000003f000000003f' WHERE id = 2");
  const LandmarkStore store(file_);
  EXPECT_EQ(store.landmarks().size(), 1u);
  EXPECT_THAT(store.find_damage().value_or(""), HasSubstr("landmark 2: large_features"));
}

TEST_F(Store, TakesNoPoseThatNoVehicleHas) {
  LandmarkStore store(file_, made_up_settings());
  auto landmark = made_up_landmark(1);
  landmark.covariance(0, 1) = landmark.covariance(1, 0) = 10.0;
  EXPECT_THROW(store.add(landmark), std::invalid_argument) << "not positive semidefinite";
  store.add(made_up_landmark(1));
  const LandmarkPose moved{1, landmark.map_from_base, landmark.covariance};
  EXPECT_THROW(store.set_poses(std::span(&moved, 1)), std::invalid_argument);
}

/// Temporarily drops root privileges, as root may write to any file.
class AsNobody {
 public:
  AsNobody() { is_root_ = ::geteuid() == 0 && ::seteuid(65534) == 0; }
  ~AsNobody() {
    if (is_root_ && ::seteuid(0) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool is_root_ = false;
};

TEST_F(Store, ThatIsWriteProtectedCanBeReadAndSaysSoToWriters) {
  namespace fs = std::filesystem;
  write(2);
  for (const bool folder_too : {false, true}) {
    fs::permissions(file_, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
    fs::permissions(folder_.path(), folder_too ? fs::perms(0555) : fs::perms(0777));
    {
      const AsNobody nobody;
      EXPECT_EQ(error_of_reading(), "");
      EXPECT_EQ(LandmarkStore(file_).size(), 2u);
      EXPECT_THAT(error_of_writing(), HasSubstr("places.landmarks: is write-protected; make it writable"));
      if (folder_too) {
        EXPECT_THAT(error_of<StoreError>([&] { LandmarkStore(folder_ / "new", made_up_settings()); }),
                    HasSubstr("new: cannot be opened or created; check the permissions of the file and its folder"));
      }
    }
    fs::permissions(folder_.path(), fs::perms::owner_all);
  }
}

TEST_F(Store, TakesAnotherStoresLandmarksBitForBitWithNewIds) {
  write(3);
  LandmarkStore other(folder_ / "other", made_up_settings());
  for (const std::uint32_t id : {12u, 15u}) other.add(made_up_landmark(id));
  LandmarkStore store(file_, made_up_settings());
  EXPECT_EQ(store.append(other), 4u);
  EXPECT_EQ(store.size(), 5u);
  const auto landmarks = store.landmarks();
  for (const auto& [id, number] : {std::pair{4u, 12u}, std::pair{5u, 15u}}) {
    auto expected = made_up_landmark(number);
    expected.id = id;
    auto found = landmarks.at(id - 1);
    found.keypoints = store.keypoints(id);
    found.thumbnail = store.thumbnail(id);
    EXPECT_EQ(difference(found, expected), "");
    EXPECT_EQ(found.map_from_base.matrix(), other.landmarks().at(id - 4).map_from_base.matrix());
  }
  LandmarkStore third(folder_ / "third", {{"seed", "3"}});
  EXPECT_THAT(error_of<StoreError>([&] { store.append(third); }), HasSubstr("seed is 1 there, 3 here"));
}

TEST_F(Store, TakesOverHowAnotherStoresLandmarksServed) {
  LandmarkStore other(folder_ / "other", made_up_settings());
  for (const std::uint32_t id : {12u, 15u}) other.add(made_up_landmark(id));
  other.set_uses({{15, {2, 7, 4, 3, 1}}});
  write(3);
  LandmarkStore store(file_, made_up_settings());
  store.set_uses({{1, {3, 9, 9, 0, 0}}});
  store.append(other);
  EXPECT_EQ(store.uses(),
            (std::map<std::uint32_t, LandmarkUse>{{1, {3, 9, 9, 0, 0}}, {4, {4, 0, 0, 0, 0}}, {5, {6, 7, 4, 3, 1}}}));
  EXPECT_EQ(store.next_session(), 7u);
}

TEST_F(Store, TellsWhatTakesItsRoom) {
  write(10, 300);
  const LandmarkStore store(file_);
  const auto bytes = store.stored_bytes();
  EXPECT_EQ(bytes.histogram, 10u * 64u * 4u);
  EXPECT_EQ(bytes.large, 10u * 1400u);
  EXPECT_EQ(bytes.small, 10u * 1400u);
  EXPECT_EQ(bytes.keypoints, 10u * 150u * (145u + 161u));
  EXPECT_EQ(bytes.thumbnail, 10u * 1000u);
  EXPECT_EQ(bytes.file, std::filesystem::file_size(file_));
  EXPECT_EQ(store.keypoint_count(), 3000u);
  // With a thumbnail of 25 kB, a landmark takes less than 100 kB including the database structure.
  EXPECT_LT(bytes.file / 10 + 25'000, 100'000u);
}

}  // namespace
}  // namespace panvo::landmarks
