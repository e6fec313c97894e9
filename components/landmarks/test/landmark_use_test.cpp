// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_use.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <map>

namespace panvo::landmarks {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

/// A straight road with a landmark every 50 m, all built on one day.
PassCounter road(int landmarks) {
  PassCounter counter;
  for (int i = 1; i <= landmarks; ++i) counter.set_landmark(static_cast<std::uint32_t>(i), {50.0 * i, 0.0}, kHour_ns);
  return counter;
}

/// Drives along the road; those for which `is_seen` are recognised 2 m before they are reached.
std::vector<LandmarkPass> drive(PassCounter& counter, double to_m, double beside_m,
                                const std::function<bool(std::uint32_t)>& is_seen) {
  std::vector<LandmarkPass> passes;
  std::uint32_t next = 1;
  for (double x = 0.0; x <= to_m; x += 0.2) {
    const auto ended = counter.move_to({x, beside_m});
    passes.insert(passes.end(), ended.begin(), ended.end());
    if (x >= 50.0 * next - 2.0) {
      if (is_seen(next)) counter.recognised(next);
      ++next;
    }
  }
  return passes;
}

TEST(PassCounter, TellsWhichLandmarksWereRecognisedAndWhichWereMissed) {
  auto counter = road(3);
  EXPECT_THAT(drive(counter, 200.0, 1.0, [](std::uint32_t id) { return id != 2; }),
              ElementsAre(LandmarkPass{1, true, false}, LandmarkPass{2, false, true}, LandmarkPass{3, true, true}));
}

TEST(PassCounter, CountsNoPassOnAnotherStreet) {
  auto counter = road(3);
  EXPECT_THAT(drive(counter, 200.0, 12.0, [](std::uint32_t) { return false; }), IsEmpty());
}

TEST(PassCounter, EndsAPassOnlyWhenTheLandmarkIsLeft) {
  auto counter = road(1);
  EXPECT_THAT(drive(counter, 70.0, 0.0, [](std::uint32_t) { return false; }), IsEmpty());
  EXPECT_THAT(counter.move_to({76.0, 0.0}), ElementsAre(LandmarkPass{1, false, false}));
  EXPECT_THAT(counter.move_to({80.0, 0.0}), IsEmpty());
}

TEST(PassCounter, FindsNoCompanyWhereOthersWereBuiltOnAnotherDay) {
  auto counter = road(3);
  counter.set_landmark(2, {100.0, 0.0}, 40 * kHour_ns);
  EXPECT_THAT(drive(counter, 140.0, 0.0, [](std::uint32_t id) { return id == 1; }),
              ElementsAre(LandmarkPass{1, true, false}, LandmarkPass{2, false, false}));
}

TEST(PassCounter, FindsNoCompanyALongWayBack) {
  auto counter = road(8);
  const auto passes = drive(counter, 430.0, 0.0, [](std::uint32_t id) { return id == 1; });
  ASSERT_EQ(passes.size(), 8U);
  EXPECT_TRUE(passes[4].in_company);   // 227 m after the recognition
  EXPECT_FALSE(passes[7].in_company);  // 377 m
}

TEST(LandmarkUse, CountsMissesSinceTheLastRecognition) {
  LandmarkUse use;
  add({1, false, true}, use);
  add({1, false, false}, use);
  EXPECT_EQ(use, (LandmarkUse{2, 0, 2, 1}));
  add({1, true, true}, use);
  EXPECT_EQ(use, (LandmarkUse{3, 1, 0, 0}));
}

/// A made-up map over many drives: which landmarks are recognised on a drive is given; a new appearance is built where
/// none of a place is.
class Map {
 public:
  explicit Map(int places) {
    for (int place = 1; place <= places; ++place) add_at(place, 0);
  }

  /// `looks(place)`: an appearance of that look is recognised today; `can_miss`: places that are missed nevertheless.
  void drive(int day, const std::function<int(int)>& looks, const std::function<bool(int)>& is_missed) {
    std::erase_if(landmarks_, [&](const auto& entry) { return rules_.forgets(entry.second.use); });
    PassCounter counter;
    std::map<int, std::vector<LandmarkUse>> beside;
    std::map<int, std::vector<std::uint32_t>> ids;
    for (const auto& [id, landmark] : landmarks_) {
      counter.set_landmark(id, {50.0 * landmark.place, 0.0}, landmark.built * 24 * kHour_ns);
      beside[landmark.place].push_back(landmark.use);
      ids[landmark.place].push_back(id);
    }
    for (double x = 0.0; x < 50.0 * (kPlaces + 1); x += 1.0) {
      for (const auto& pass : counter.move_to({x, 0.0})) {
        if (const auto passed = landmarks_.find(pass.id); passed != landmarks_.end()) add(pass, passed->second.use);
      }
      const int place = static_cast<int>(x / 50.0);
      if (place * 50.0 != x || place < 1) continue;
      const auto seen = std::find_if(landmarks_.begin(), landmarks_.end(), [&](const auto& entry) {
        return entry.second.place == place && entry.second.look == looks(place);
      });
      if (seen != landmarks_.end() && !is_missed(place)) {
        counter.recognised(seen->first);
      } else if (const auto admission = rules_.admit(beside[place]); admission.is_kept) {
        if (admission.instead_of) landmarks_.erase(ids[place][*admission.instead_of]);
        add_at(place, looks(place), day);
      }
    }
  }
  std::size_t size() const { return landmarks_.size(); }
  std::size_t of_look(int look) const {
    return static_cast<std::size_t>(std::count_if(landmarks_.begin(), landmarks_.end(),
                                                  [&](const auto& entry) { return entry.second.look == look; }));
  }

  static constexpr int kPlaces = 40;

 private:
  struct Landmark {
    int place = 0, look = 0, built = 0;
    LandmarkUse use;
  };
  void add_at(int place, int look, int day = 0) { landmarks_[next_++] = {place, look, day, {}}; }

  UseRules rules_;
  std::map<std::uint32_t, Landmark> landmarks_;
  std::uint32_t next_ = 1;
};

bool never(int) { return false; }

TEST(UseRules, AMapStopsGrowingThoughPlacesAreMissedNowAndThen) {
  Map map(Map::kPlaces);
  std::uint64_t drawn = 1;
  const auto one_in_fifty = [&](int) {
    drawn = drawn * 6364136223846793005ULL + 1442695040888963407ULL;
    return (drawn >> 33) % 50 == 0;
  };
  std::size_t after_ten = 0;
  for (int day = 1; day <= 50; ++day) {
    map.drive(
        day, [](int) { return 0; }, one_in_fifty);
    if (day == 10) after_ten = map.size();
  }
  EXPECT_LE(static_cast<double>(map.size()), 1.05 * static_cast<double>(after_ten));
  EXPECT_GE(map.of_look(0), static_cast<std::size_t>(Map::kPlaces));
}

TEST(UseRules, WinterIsLearnedOnItsSecondDayAndSummerIsKept) {
  Map map(Map::kPlaces);
  map.drive(
      1, [](int) { return 1; }, never);
  EXPECT_EQ(map.of_look(1), 0U);
  map.drive(
      2, [](int) { return 1; }, never);
  EXPECT_EQ(map.of_look(1), static_cast<std::size_t>(Map::kPlaces));
  for (int day = 3; day <= 60; ++day)
    map.drive(
        day, [](int) { return 1; }, never);
  EXPECT_EQ(map.of_look(0), static_cast<std::size_t>(Map::kPlaces));
  EXPECT_EQ(map.size(), 2U * Map::kPlaces);
}

TEST(UseRules, ARepaintedPlaceIsLearnedAndItsOldLookForgotten) {
  Map map(Map::kPlaces);
  const auto repainted = [](int place) { return place == 7 ? 1 : 0; };
  for (int day = 1; day <= 12; ++day) map.drive(day, repainted, never);
  EXPECT_EQ(map.of_look(1), 1U);
  EXPECT_EQ(map.of_look(0), static_cast<std::size_t>(Map::kPlaces) - 1);
}

TEST(UseRules, APlaceHasABoundedNumberOfAppearances) {
  Map map(Map::kPlaces);
  for (int day = 1; day <= 60; ++day) {
    map.drive(
        day, [day](int) { return day / 4; }, never);
    EXPECT_LE(map.size(), 4U * Map::kPlaces);
  }
  EXPECT_EQ(map.of_look(60 / 4 - 1), static_cast<std::size_t>(Map::kPlaces)) << "the newest replaced the oldest";
}

}  // namespace
}  // namespace panvo::landmarks
