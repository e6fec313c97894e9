// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "poses_message.hpp"
#include "store_fixture.hpp"

namespace panvo::landmarks::test {

inline PanoramicLandmark with_id(std::uint32_t id, PanoramicLandmark landmark) {
  landmark.id = id;
  return landmark;
}

inline PanoramicLandmark moved_by(double by_m, PanoramicLandmark landmark) {
  landmark.map_from_base.translation().x() += by_m;
  return landmark;
}

/// The component from a start until its end, in a run.
struct Life {
  runtime::ComponentHarness harness;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& published =
      harness.collect(topics::kLandmarks);

  Life(const StoreLocation& location, const std::string& run,
       const std::map<std::string, std::string>& more = {{"forget_after", "0"}})
      : harness({.replay = true, .run_id = run}) {
    std::map<std::string, std::string> parameters{{"file", location.text()}};
    parameters.insert(more.begin(), more.end());
    harness.load("panvo_landmarks", "LandmarkStoreComponent", parameters);
  }
  void publish(const PanoramicLandmark& landmark) {
    harness.publish(topics::kLandmarks, to_message(landmark, made_up_settings(), "map"));
  }
  void publish_poses(const std::vector<PanoramicLandmark>& landmarks) {
    harness.publish(topics::kLandmarkPoses, to_poses_message(landmarks));
  }
  /// From far away, drives past a landmark, recognises it, and drives away from all.
  void pass(const PanoramicLandmark& landmark) {
    panvo_msgs::msg::CorrectionOutcome outcome;
    outcome.landmark_id(landmark.id);
    outcome.outcome(panvo_msgs::msg::CorrectionOutcome_Constants::APPLIED);
    outcome.before().orientation().w(1.0);
    outcome.after().orientation().w(1.0);
    drive_to({1e5, 1e5, 0.0});
    drive_to(landmark.map_from_base.translation());
    harness.publish(topics::kCorrectionOutcome, outcome);
    drive_to({1e5, 1e5, 0.0});
  }
  /// Until nobody has more to say than was said before.
  void wait() {
    for (const int s : {0, 10}) drive_to({1e5, 1e5, 0.0}, 1'800'000'000 + s);
  }
  void drive_to(const Eigen::Vector3d& position, int stamp_s = 0) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp().sec(stamp_s);
    odometry.header().frame_id("map");
    odometry.pose().pose().position().x(position.x());
    odometry.pose().pose().position().y(position.y());
    odometry.pose().pose().orientation().w(1.0);
    for (int i = 0; i < 6; ++i) odometry.pose().covariance()[static_cast<std::size_t>(7 * i)] = 0.01;
    harness.publish(topics::kOdometryEnhanced, odometry);
  }
  /// Of what was published: ids, and the stamps that tell which landmarks they are.
  std::vector<std::pair<std::uint32_t, std::int64_t>> ids() const {
    std::vector<std::pair<std::uint32_t, std::int64_t>> ids;
    for (const auto& message : published) {
      const auto landmark = to_landmark(*message, made_up_settings());
      ids.emplace_back(message->id(), landmark ? landmark->stamp_ns : 0);
    }
    return ids;
  }
  std::set<std::pair<std::uint32_t, std::int64_t>> distinct_ids() const {
    const auto all = ids();
    return {all.begin(), all.end()};
  }
};

inline std::int64_t stamp_of(std::uint32_t made_up) { return made_up_landmark(made_up).stamp_ns; }

/// With a store in a file, or on a server.
class StoreLivesOfEachKind : public ServerTest, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    if (GetParam()) ServerTest::SetUp();
  }
  StoreLocation where() const { return GetParam() ? StoreLocation(location()) : StoreLocation(folder_ / "store"); }
  /// Those who number landmarks have not heard of the third one, as it is damaged: their third one gets another number.
  void write_two_and_a_damaged_one() {
    LandmarkStore store(where(), made_up_settings());
    for (const std::uint32_t id : {1U, 2U, 3U}) store.add(made_up_landmark(id));
    if (GetParam()) {
      sql("UPDATE panvo.keypoints SET data = '\\x00' WHERE landmark_id = 3");
    } else {
      sqlite::Database(folder_ / "store", sqlite::Database::Mode::kReadWrite)
          .execute("UPDATE keypoints SET data = x'00' WHERE landmark_id = 3");
    }
  }
  /// The third and the fourth one were moved by 2 and 7 m, and a fifth one was added, all by the ids of the run.
  void expect_moved_and_added() const {
    const LandmarkStore store(where());
    ASSERT_EQ(store.size(), 6U);
    EXPECT_EQ(x_of(3), made_up_landmark(3).map_from_base.translation().x());
    EXPECT_EQ(difference(whole(store, 4), with_id(4, moved_by(2.0, third_))), "");
    EXPECT_EQ(difference(whole(store, 5), with_id(5, moved_by(7.0, fourth_))), "");
    EXPECT_EQ(difference(whole(store, 6), with_id(6, made_up_landmark(50))), "");
  }
  double x_of(std::uint32_t stored) const {
    for (const auto& landmark : LandmarkStore(where()).landmarks()) {
      if (landmark.id == stored) return landmark.map_from_base.translation().x();
    }
    return std::nan("");
  }

  TemporaryFolder folder_;
  const PanoramicLandmark third_ = with_id(3, made_up_landmark(30));
  const PanoramicLandmark fourth_ = with_id(4, made_up_landmark(40));
};

}  // namespace panvo::landmarks::test
