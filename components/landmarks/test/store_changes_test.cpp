// SPDX-License-Identifier: Apache-2.0
#include "store_changes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "made_up_landmark.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "store_writer.hpp"

namespace panvo::landmarks {
namespace {

NewLandmark added(std::uint32_t id) { return {test::made_up_landmark(id), test::made_up_settings(), std::nullopt}; }

MovedLandmarks moved(std::vector<std::pair<std::uint32_t, double>> to_x) {
  MovedLandmarks change;
  for (const auto& [id, x] : to_x) {
    change.poses.push_back({id});
    change.poses.back().map_from_base.translation().x() = x;
  }
  return change;
}

TEST(PendingChanges, ComeInOrder) {
  PendingChanges pending(10);
  EXPECT_EQ(pending.take(), nullptr);
  pending.push(added(1));
  pending.push(RemovedLandmark{4});
  EXPECT_EQ(std::get<NewLandmark>(*pending.take()).landmark.id, 1U);
  EXPECT_EQ(pending.size(), 2U) << "the one that is being made counts";
  pending.done();
  EXPECT_EQ(std::get<RemovedLandmark>(*pending.take()).id, 4U);
  pending.done();
  EXPECT_EQ(pending.size(), 0U);
}

TEST(PendingChanges, DoNotCountARunThatHasBegun) {
  PendingChanges pending(10);
  pending.push(BegunRun{});
  pending.push(added(1));
  EXPECT_EQ(pending.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<BegunRun>(*pending.take()));
  EXPECT_EQ(pending.size(), 1U);
}

TEST(PendingChanges, AreRefusedAndCountedWithoutRoom) {
  PendingChanges pending(3);
  EXPECT_TRUE(pending.push(added(1)));
  EXPECT_TRUE(pending.push(PassedLandmarks{{{1}, {2}}}));
  EXPECT_FALSE(pending.push(PassedLandmarks{{{1}}}));
  EXPECT_FALSE(pending.push(added(2)));
  EXPECT_EQ(pending.refused(), 2U);
  EXPECT_TRUE(pending.push(moved({{1, 2.0}}))) << "poses take no room";
  pending.take();
  EXPECT_TRUE(pending.push(added(2)));
  EXPECT_EQ(pending.refused(), 2U);
}

TEST(PendingChanges, TakeOneThatIsLargerThanTheirRoomWhileNoneWaits) {
  PendingChanges pending(1);
  EXPECT_TRUE(pending.push(PassedLandmarks{{{1}, {2}}}));
  EXPECT_FALSE(pending.push(added(1)));
}

TEST(PendingChanges, MoveALandmarkOnceAndAfterItIsThere) {
  PendingChanges pending(10);
  pending.push(moved({{1, 1.0}, {2, 2.0}}));
  pending.push(added(5));
  pending.push(moved({{2, 3.0}, {5, 4.0}}));
  EXPECT_EQ(pending.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<NewLandmark>(*pending.take()));
  const auto poses = std::get<MovedLandmarks>(*pending.take()).poses;
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].map_from_base.translation().x(), 1.0);
  EXPECT_EQ(poses[1].map_from_base.translation().x(), 3.0);
  EXPECT_EQ(poses[2].map_from_base.translation().x(), 4.0);
}

TEST(PendingChanges, LeaveThoseThatAreBeingMadeAlone) {
  PendingChanges pending(10);
  pending.push(moved({{1, 1.0}}));
  pending.push(PassedLandmarks{{{1}}});
  const auto first = pending.take();
  pending.push(moved({{1, 2.0}}));
  EXPECT_EQ(std::get<MovedLandmarks>(*first).poses.front().map_from_base.translation().x(), 1.0);
  const auto second = pending.take();
  pending.push(PassedLandmarks{{{2}}});
  EXPECT_EQ(std::get<PassedLandmarks>(*second).passes.size(), 1U);
}

double stored_x(const LandmarkStore& store, std::uint32_t id) {
  for (const auto& landmark : store.landmarks()) {
    if (landmark.id == id) return landmark.map_from_base.translation().x();
  }
  return std::nan("");
}

TEST(StoreChanges, LeaveTheLandmarkAloneThatHasTheIdOfARemovedOne) {
  const panvo::test::TemporaryFolder folder;
  LandmarkStore store(folder / "store", test::made_up_settings());
  for (const std::uint32_t id : {1U, 2U}) store.add(test::made_up_landmark(id));
  StoredIds ids{.last_known = 2, .known = {}};
  apply(added(2), store, ids);
  EXPECT_EQ(ids.of(2), 3U);
  apply(RemovedLandmark{2}, store, ids);
  apply(added(3), store, ids);
  ASSERT_EQ(ids.of(3), 3U) << "the id is free again";
  apply(moved({{2, 50.0}}), store, ids);
  apply(PassedLandmarks{{{2}}}, store, ids);
  EXPECT_EQ(stored_x(store, 3), test::made_up_landmark(3).map_from_base.translation().x());
  EXPECT_FALSE(store.uses().contains(3));
}

TEST(StoreChanges, AreRefusedWhereASecondProcessWrites) {
  const panvo::test::TemporaryFolder folder;
  LandmarkStore store(folder / "store", test::made_up_settings()), second(folder / "store", test::made_up_settings());
  StoredIds ids;
  apply(added(1), store, ids);
  second.add(test::made_up_landmark(2));
  EXPECT_THROW(apply(added(2), store, ids), StoreError);
}

class FileWriter : public testing::Test {
 protected:
  FileWriter() {
    auto store = std::make_unique<LandmarkStore>(file_, test::made_up_settings());
    store->add(test::made_up_landmark(1));
    writer_ = write_to_file(file_, std::move(store), {}, 2, 0);
  }
  /// Begins to read, like another process. The lock lasts as long as the result.
  std::unique_ptr<sqlite::Database> reader() const {
    auto reading = std::make_unique<sqlite::Database>(file_, sqlite::Database::Mode::kRead);
    reading->execute("BEGIN; SELECT count(*) FROM landmark");
    return reading;
  }
  std::string told() {
    std::string text;
    for (const auto& notice : writer_->notices()) text += notice.text + "\n";
    return text;
  }

  const panvo::test::TemporaryFolder folder_;
  const std::string file_ = folder_ / "store";
  std::unique_ptr<StoreWriter> writer_;
};

TEST_F(FileWriter, KeepsChangesUntilAReaderHasEnded) {
  auto reading = reader();
  EXPECT_TRUE(writer_->write(added(2)));
  EXPECT_TRUE(writer_->write(moved({{1, 7.0}, {2, 3.0}})));
  EXPECT_THAT(told(), testing::HasSubstr("is locked by another process"));
  EXPECT_EQ(LandmarkStore(file_).size(), 1U);
  reading.reset();
  EXPECT_TRUE(writer_->write(added(3)));
  EXPECT_THAT(told(), testing::HasSubstr("is free again; all changes are stored"));
  const LandmarkStore store(file_);
  EXPECT_EQ(store.size(), 3U);
  EXPECT_EQ(stored_x(store, 1), 7.0);
  EXPECT_EQ(stored_x(store, 2), 3.0);
}

TEST_F(FileWriter, RefusesChangesWithoutRoomAndTellsThat) {
  auto reading = reader();
  for (const std::uint32_t id : {2U, 3U, 4U}) EXPECT_TRUE(writer_->write(added(id)));  // the first is being made
  EXPECT_FALSE(writer_->write(added(5)));
  EXPECT_THAT(told(), testing::HasSubstr("no room for more changes while it is locked"));
  reading.reset();
  EXPECT_TRUE(writer_->write(added(6)));
  EXPECT_EQ(LandmarkStore(file_).size(), 5U);
}

TEST_F(FileWriter, StoresAtTheEndWhatHadToWait) {
  auto reading = reader();
  writer_->write(added(2));
  reading.reset();
  writer_->finish();
  EXPECT_EQ(LandmarkStore(file_).size(), 2U);
}

TEST_F(FileWriter, KeepsARunWithTheFirstChangeThatItMakes) {
  writer_ =
      write_to_file(file_, std::make_unique<LandmarkStore>(file_, test::made_up_settings()), {"run", 4, 1, {}}, 2, 0);
  EXPECT_FALSE(LandmarkStore(file_).find_run("run")) << "none yet";
  auto reading = reader();
  EXPECT_TRUE(writer_->write(added(2)));
  reading.reset();
  EXPECT_TRUE(writer_->write(added(3)));
  const auto run = LandmarkStore(file_).find_run("run");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->session, 4U);
  EXPECT_EQ(run->last_id, 1U);
  EXPECT_EQ(run->ids, (std::map<std::uint32_t, std::uint32_t>{{2, 2}, {3, 3}}));
}

TEST_F(FileWriter, TellsWhatIsLostBecauseAReaderDoesNotEnd) {
  const auto reading = reader();
  writer_->write(added(2));
  writer_->write(added(3));
  writer_->finish();
  EXPECT_THAT(told(), testing::HasSubstr("2 changes are lost: it was locked until the end"));
}

}  // namespace
}  // namespace panvo::landmarks
