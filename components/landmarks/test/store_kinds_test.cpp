// SPDX-License-Identifier: Apache-2.0
// What holds for a store in a file and for one on a server.
#include "panvo/interfaces/place_rules.hpp"
#include "store_fixture.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

enum class Kind { kFile, kServer };

class StoreOfEachKind : public ServerTest, public testing::WithParamInterface<Kind> {
 protected:
  bool is_server() const { return GetParam() == Kind::kServer; }
  void SetUp() override {
    if (is_server()) ServerTest::SetUp();
  }
  StoreLocation where() const { return is_server() ? StoreLocation(location()) : StoreLocation(folder_ / "store"); }
  /// Another empty one.
  StoreLocation other(Kind kind, const std::string& name = "other") const {
    return kind == Kind::kServer ? StoreLocation(server_->location(new_database())) : StoreLocation(folder_ / name);
  }
  void write(std::uint32_t count) {
    LandmarkStore store(where(), made_up_settings());
    for (std::uint32_t id = 1; id <= count; ++id) store.add(made_up_landmark(id));
  }
  /// Changes the store like another program would. In SQL for a server, names are those of the schema panvo.
  void tamper(const std::string& for_file, const std::string& for_server) {
    if (is_server()) {
      sql("SET search_path = panvo; " + for_server);
    } else {
      sqlite::Database(folder_ / "store", sqlite::Database::Mode::kCreate).execute(for_file);
    }
  }
  void tamper(const std::string& statements) { tamper(statements, statements); }
  std::string error_of_reading() {
    return error_of<StoreError>([&] { LandmarkStore(where()).landmarks(); });
  }

  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Each, StoreOfEachKind, testing::Values(Kind::kFile, Kind::kServer),
                         [](const auto& of) { return of.param == Kind::kFile ? "File" : "Server"; });

TEST_P(StoreOfEachKind, GivesBackWhatWasAdded) {
  EXPECT_FALSE(LandmarkStore::exists(where()));
  write(5);
  EXPECT_TRUE(LandmarkStore::exists(where()));
  const LandmarkStore store(where());
  EXPECT_EQ(store.size(), 5U);
  EXPECT_EQ(store.settings(), made_up_settings());
  for (std::uint32_t id = 1; id <= 5; ++id) EXPECT_EQ(difference(whole(store, id), made_up_landmark(id)), "");
  EXPECT_TRUE(store.keypoints(6).empty());
  EXPECT_TRUE(store.thumbnail(6).empty());
  EXPECT_EQ(store.keypoint_count(), 100U);
  EXPECT_EQ(store.find_damage(), std::nullopt);
}

TEST_P(StoreOfEachKind, KeepsALandmarkWithoutKeypointsAndThumbnail) {
  auto landmark = made_up_landmark(1, 0);
  landmark.thumbnail.clear();
  LandmarkStore(where(), made_up_settings()).add(landmark);
  EXPECT_EQ(difference(whole(LandmarkStore(where()), 1), landmark), "");
}

TEST_P(StoreOfEachKind, GivesEachLandmarkItsNumbers) {
  write(3);
  LandmarkStore store(where(), made_up_settings());
  auto next = made_up_landmark(9);
  next.id = 0;
  EXPECT_EQ(store.add(next), 4U);
  EXPECT_THAT(error_of<StoreError>([&] { store.add(made_up_landmark(1)); }), HasSubstr("already contains landmark 1"));
  EXPECT_EQ(store.add(made_up_landmark(1), IfTaken::kNextId), 5U);
  EXPECT_EQ(store.add(made_up_landmark(9), IfTaken::kNextId), is_server() ? 6U : 9U);
  EXPECT_EQ(store.size(), 6U);
}

TEST_P(StoreOfEachKind, AddsALandmarkWholeOrNotAtAll) {
  write(1);
  tamper("CREATE TRIGGER no BEFORE INSERT ON thumbnail BEGIN SELECT RAISE(ABORT, 'no thumbnails'); END",
         "CREATE FUNCTION no() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN RAISE 'no thumbnails'; END $$; "
         "CREATE TRIGGER no BEFORE INSERT ON thumbnail FOR EACH ROW EXECUTE FUNCTION no()");
  LandmarkStore store(where(), made_up_settings());
  EXPECT_THAT(error_of<StoreError>([&] { store.add(made_up_landmark(2)); }), HasSubstr("no thumbnails"));
  EXPECT_EQ(store.size(), 1U);
  EXPECT_EQ(store.keypoint_count(), 20U);
  tamper("DROP TRIGGER no", "DROP TRIGGER no ON thumbnail");
  EXPECT_EQ(store.add(made_up_landmark(2), IfTaken::kRefuse, LandmarkUse{1, 2, 3, 4, 5}), 2U);
  EXPECT_EQ(store.uses().at(2), (LandmarkUse{1, 2, 3, 4, 5}));
}

TEST_P(StoreOfEachKind, MovesLandmarksAllOrNone) {
  write(3);
  LandmarkStore store(where(), made_up_settings());
  std::vector<LandmarkPose> poses(2);
  poses[0] = {2, made_up_landmark(20).map_from_base, made_up_landmark(20).covariance};
  poses[1].id = 99;
  store.set_poses(poses);
  auto expected = made_up_landmark(2);
  expected.map_from_base = made_up_landmark(20).map_from_base;
  expected.covariance = made_up_landmark(20).covariance;
  EXPECT_EQ(difference(whole(store, 2), expected), "");
  EXPECT_EQ(difference(whole(store, 1), made_up_landmark(1)), "");
  EXPECT_EQ(store.size(), 3U);

  poses[1].map_from_base.translation().x() = std::nan("");
  poses[0].map_from_base = Eigen::Isometry3d::Identity();
  EXPECT_THROW(store.set_poses(poses), std::invalid_argument);
  EXPECT_EQ(difference(whole(store, 2), expected), "");
}

TEST_P(StoreOfEachKind, MovesNothingIfOnePoseIsRefused) {
  write(3);
  tamper("CREATE TRIGGER no BEFORE UPDATE ON landmark WHEN old.id = 3 BEGIN SELECT RAISE(ABORT, 'fixed'); END",
         "CREATE FUNCTION no() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN RAISE 'fixed'; END $$; "
         "CREATE TRIGGER no BEFORE UPDATE ON landmark FOR EACH ROW WHEN (old.id = 3) EXECUTE FUNCTION no()");
  LandmarkStore store(where(), made_up_settings());
  std::vector<LandmarkPose> poses;
  for (const std::uint32_t id : {1U, 3U}) {
    poses.push_back({id, made_up_landmark(20).map_from_base, made_up_landmark(20).covariance});
  }
  EXPECT_THAT(error_of<StoreError>([&] { store.set_poses(poses); }), HasSubstr("fixed"));
  EXPECT_EQ(difference(whole(store, 1), made_up_landmark(1)), "");
}

TEST_P(StoreOfEachKind, RemovesLandmarksWithAllThatBelongsToThem) {
  write(3);
  LandmarkStore store(where(), made_up_settings());
  store.set_uses({{2, {1, 9, 8, 7, 6}}, {3, {1, 1, 1, 0, 0}}});
  const std::vector<std::uint32_t> ids{2, 77};
  store.remove(ids);
  EXPECT_EQ(store.size(), 2U);
  EXPECT_TRUE(store.keypoints(2).empty());
  EXPECT_TRUE(store.thumbnail(2).empty());
  EXPECT_THAT(store.uses(), ElementsAre(testing::Pair(3U, LandmarkUse{1, 1, 1, 0, 0})));
}

TEST_P(StoreOfEachKind, CountsPasses) {
  write(2);
  LandmarkStore store(where(), made_up_settings());
  store.set_uses({{1, {3, 5, 4, 1, 1}}, {99, {}}});
  store.count(std::vector<LandmarkPass>{{1, false, true}, {2, true, false}, {1, false, false}, {99, true, true}});
  EXPECT_THAT(store.uses(), ElementsAre(testing::Pair(1U, LandmarkUse{3, 7, 4, 3, 2}),
                                        testing::Pair(2U, LandmarkUse{0, 1, 1, 0, 0})));
  EXPECT_EQ(store.next_session(), 4U);
}

TEST_P(StoreOfEachKind, OfOtherSettingsIsRefusedWithWhatDiffers) {
  write(1);
  const auto error = error_of<StoreError>([&] {
    LandmarkStore(where(), {{"band_rows", "150"}, {"seed", "2"}, {"kind", "cf"}});
  });
  EXPECT_THAT(error, HasSubstr("its landmarks were described with other settings: "
                               "kind is not set there, cf here; seed is 1 there, 2 here. Use the settings"));
  EXPECT_EQ(LandmarkStore(where()).size(), 1U);
}

TEST_P(StoreOfEachKind, OfANewerVersionIsRefusedWithBothVersions) {
  write(1);
  tamper("PRAGMA user_version=7", "UPDATE store SET layout = 7");
  for (const auto& error :
       {error_of_reading(), error_of<StoreError>([&] { LandmarkStore(where(), made_up_settings()); })}) {
    EXPECT_THAT(error, HasSubstr("has layout 7; this version of panvo reads 1. Use the version that wrote it"));
  }
}

TEST_P(StoreOfEachKind, ThatIsMissingIsToldToReadersAndMadeByWriters) {
  EXPECT_THAT(error_of_reading(), HasSubstr(is_server() ? "contains no landmarks; a run" : "does not exist; a run"));
  { const LandmarkStore made(where(), made_up_settings()); }
  EXPECT_EQ(error_of_reading(), "");
  EXPECT_EQ(LandmarkStore(where()).size(), 0U);
}

TEST_P(StoreOfEachKind, LeavesOutDamagedLandmarksAndSaysWhich) {
  write(5);
  tamper(
      "UPDATE landmark SET covariance = x'00' WHERE id = 2; UPDATE landmark SET x = 1e200 WHERE id = 3;"
      "UPDATE landmark SET small_features = x'ffff0000000000003f000000003f' WHERE id = 4;"
      "DELETE FROM keypoints WHERE landmark_id = 5; DELETE FROM thumbnail WHERE landmark_id = 5;"
      "UPDATE landmark SET id = 4294967298 WHERE id = 5;",
      "UPDATE landmark SET covariance = '\\x00' WHERE id = 2; UPDATE landmark SET x = 1e200 WHERE id = 3;"
      "UPDATE landmark SET small_features = '\\xffff0000000000003f000000003f' WHERE id = 4;"
      "DELETE FROM keypoints WHERE landmark_id = 5; DELETE FROM thumbnail WHERE landmark_id = 5;"
      "UPDATE landmark SET id = 4294967298 WHERE id = 5;");
  const LandmarkStore store(where());
  std::vector<std::string> told;
  const auto landmarks = store.landmarks([&](const std::string& problem) { told.push_back(problem); });
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_EQ(landmarks.front().id, 1U);
  EXPECT_THAT(
      told,
      ElementsAre("landmark 2: contains invalid values", "landmark 3: pose.pose.position is beyond +-1e+08",
                  HasSubstr("landmark 4: small_features"), "landmark 4294967298: its id is not in 1 to 4000000000"));
  EXPECT_THAT(store.find_damage().value_or(""), HasSubstr("landmark 2: contains invalid values; landmark 3"));
  EXPECT_EQ(store.last_id(), 4U) << "beyond is none, but invalid records have theirs";
  auto next = made_up_landmark(9);
  next.id = 0;
  EXPECT_EQ(LandmarkStore(where(), made_up_settings()).add(next), 5U);
}

TEST_P(StoreOfEachKind, RefusesDamagedKeypoints) {
  write(2);
  tamper("UPDATE keypoints SET data = x'00' WHERE landmark_id = 2",
         "UPDATE keypoints SET data = '\\x00' WHERE landmark_id = 2");
  const LandmarkStore store(where());
  EXPECT_THAT(error_of<StoreError>([&] { store.keypoints(2); }),
              HasSubstr("is damaged: landmark 2: keypoints are truncated or not finite"));
  EXPECT_THAT(store.find_damage().value_or(""), HasSubstr("landmark 2: keypoints are truncated"));
}

TEST_P(StoreOfEachKind, TellsWhatTakesItsRoom) {
  write(10);
  const auto bytes = LandmarkStore(where()).stored_bytes();
  EXPECT_EQ(bytes.histogram, 10U * 64U * 4U);
  EXPECT_EQ(bytes.large, 10U * 1400U);
  EXPECT_EQ(bytes.keypoints, 10U * 10U * (145U + 161U));
  EXPECT_EQ(bytes.thumbnail, 10U * 1000U);
  EXPECT_GT(bytes.file, bytes.keypoints + bytes.thumbnail);
}

TEST_P(StoreOfEachKind, TakesAnotherStoresLandmarksWithNewIds) {
  write(3);
  for (const auto kind : is_server() ? std::vector{Kind::kFile, Kind::kServer} : std::vector{Kind::kFile}) {
    const auto there = other(kind);
    LandmarkStore source(there, made_up_settings());
    for (const std::uint32_t id : {12U, 15U}) source.add(made_up_landmark(id));
    source.set_uses({{15, {2, 7, 4, 3, 1}}});
    LandmarkStore store(where(), made_up_settings());
    const auto first = store.append(source);
    auto expected = made_up_landmark(15);
    expected.id = first + 1;
    EXPECT_EQ(difference(whole(store, first + 1), expected), "");
    EXPECT_EQ(store.uses().at(first + 1).passes, 7U);
    EXPECT_EQ(store.uses().at(first + 1).session, store.uses().at(first).session + 2);
  }
}

/// A store with gaps in its ids, uses, and values that are hard to keep.
void fill(LandmarkStore& store) {
  for (const std::uint32_t id : {2U, 3U, 90U, interfaces::kMaxLandmarkId}) {
    auto landmark = made_up_landmark(id, id == 3 ? 0 : 300);
    landmark.map_from_base.translation().y() = id == 2 ? 1e-300 : 0.1;
    landmark.stamp_ns = id == 2 ? std::numeric_limits<std::int64_t>::max() : 0;
    if (id == 3) landmark.thumbnail.clear();
    store.add(landmark);
  }
  store.set_uses({{2, {3, 9, 5, 1, 0}}, {90, {1, 1, 0, 1, 1}}});
}

TEST_P(StoreOfEachKind, IsCopiedExactlyToEachKindAndBack) {
  if (is_server() == false && (!postgres::is_available() || !PostgresServer::programs())) GTEST_SKIP() << "no server";
  if (!is_server()) ServerTest::SetUp();
  {
    LandmarkStore original(where(), made_up_settings());
    fill(original);
  }
  const LandmarkStore original(where());
  for (const auto kind : {Kind::kFile, Kind::kServer}) {
    const auto there = other(kind, "copy"), back = other(GetParam(), "back");
    LandmarkStore copy(there, made_up_settings());
    EXPECT_EQ(copy.become_copy_of(original, false), 4U);
    LandmarkStore again(back, made_up_settings());
    EXPECT_EQ(again.become_copy_of(copy, false), 4U);
    for (const auto* store : {&copy, &again}) {
      EXPECT_EQ(store->uses(), original.uses());
      EXPECT_EQ(store->size(), 4U);
      for (const std::uint32_t id : {2U, 3U, 90U, interfaces::kMaxLandmarkId}) {
        const auto expected = whole(original, id), found = whole(*store, id);
        EXPECT_EQ(difference(found, expected), "");
        EXPECT_EQ(found.map_from_base.matrix(), expected.map_from_base.matrix()) << "bit for bit";
      }
    }
    if (kind == Kind::kFile) std::filesystem::remove(folder_ / "copy");
    if (!is_server()) std::filesystem::remove(folder_ / "back");
  }
}

TEST_P(StoreOfEachKind, IsReplacedByACopyOnlyIfThatIsWanted) {
  write(3);
  LandmarkStore source(other(Kind::kFile), made_up_settings());
  source.add(made_up_landmark(7));
  LandmarkStore store(where(), made_up_settings());
  EXPECT_THAT(error_of<StoreError>([&] { store.become_copy_of(source, false); }),
              HasSubstr("already contains 3 landmarks; name an empty one or pass --overwrite"));
  EXPECT_EQ(store.size(), 3U);
  EXPECT_EQ(store.become_copy_of(source, true), 1U);
  EXPECT_EQ(store.size(), 1U);
  EXPECT_EQ(difference(whole(store, 7), made_up_landmark(7)), "");
}

TEST_P(StoreOfEachKind, IsNotCopiedIfItIsDamagedUnlessThatIsLeftOut) {
  write(3);
  tamper("UPDATE landmark SET x = 1e200 WHERE id = 2; UPDATE keypoints SET data = x'00' WHERE landmark_id = 3",
         "UPDATE landmark SET x = 1e200 WHERE id = 2; UPDATE keypoints SET data = '\\x00' WHERE landmark_id = 3");
  const LandmarkStore store(where());
  LandmarkStore copy(other(Kind::kFile), made_up_settings());
  EXPECT_THAT(error_of<StoreError>([&] { copy.become_copy_of(store, false); }),
              HasSubstr("is damaged: landmark 2: pose.pose.position is beyond +-1e+08; nothing was copied"));
  EXPECT_EQ(copy.size(), 0U);
  std::vector<std::string> told;
  EXPECT_EQ(copy.become_copy_of(store, false, [&](const std::string& problem) { told.push_back(problem); }), 1U);
  EXPECT_THAT(told, ElementsAre(HasSubstr("landmark 2: "), HasSubstr("landmark 3: keypoints are truncated")));
}

TEST_P(StoreOfEachKind, IsNotTakenForACopyIfItChangesWhatItIsGiven) {
  LandmarkStore source(other(Kind::kFile), made_up_settings());
  fill(source);
  LandmarkStore store(where(), made_up_settings());
  tamper(
      "CREATE TRIGGER worse AFTER INSERT ON thumbnail WHEN new.landmark_id = 90 BEGIN "
      "UPDATE thumbnail SET jpeg = x'00' WHERE landmark_id = 90; END",
      "CREATE FUNCTION worse() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN new.jpeg = '\\x00'; RETURN new; END $$; "
      "CREATE TRIGGER worse BEFORE INSERT ON thumbnail FOR EACH ROW WHEN (new.landmark_id = 90) "
      "EXECUTE FUNCTION worse()");
  EXPECT_THAT(error_of<StoreError>([&] { store.become_copy_of(source, false); }),
              HasSubstr("landmark 90: differs from the original; nothing was copied"));
  EXPECT_EQ(store.size(), 0U);
}

}  // namespace
}  // namespace panvo::landmarks
