// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_use.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <map>

namespace panvo::landmarks {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A straight road with a landmark every 50 m, all of one session.
PassCounter road(int landmarks) {
  PassCounter counter;
  for (int i = 1; i <= landmarks; ++i) counter.set_landmark(static_cast<std::uint32_t>(i), {50.0 * i, 0.0}, 1);
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
              ElementsAre(LandmarkPass{1, true, false}, LandmarkPass{2, false, false}, LandmarkPass{3, true, false}));
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

TEST(PassCounter, CountsNoPassOfWhichItSawTheLastPartOnly) {
  auto counter = road(3);
  counter.leave_out_current();
  counter.move_to({51.0, 0.0});
  for (double x = 52.0; x <= 120.0; x += 1.0) EXPECT_THAT(counter.move_to({x, 0.0}), IsEmpty()) << x;
  EXPECT_THAT(counter.move_to({126.0, 0.0}), ElementsAre(LandmarkPass{2, false, false})) << "was not near then";
}

TEST(PassCounter, CountsNoPassWhereALandmarkWasBuiltJustNow) {
  PassCounter counter;
  counter.move_to({0.0, 0.0});
  counter.set_landmark(1, {0.0, 0.0}, 1);
  for (double x = 1.0; x <= 30.0; x += 1.0) EXPECT_THAT(counter.move_to({x, 0.0}), IsEmpty()) << x;
  for (double x = 30.0; x >= -20.0; x -= 1.0) counter.move_to({x, 0.0});
  EXPECT_THAT(counter.move_to({-30.0, 0.0}), ElementsAre(LandmarkPass{1, false, false}))
      << "on the way back it was passed";
}

TEST(PassCounter, FindsCompanyWhereMostOfTheSessionAreRecognised) {
  auto counter = road(13);
  const auto passes = drive(counter, 700.0, 0.0, [](std::uint32_t id) { return id != 3 && id != 6 && id != 12; });
  ASSERT_EQ(passes.size(), 13U);
  EXPECT_FALSE(passes[9].in_company) << "nine passes are too few to tell";
  EXPECT_TRUE(passes[11].in_company) << "nine of eleven were recognised";
  EXPECT_FALSE(passes[12].in_company) << "nine of twelve were";
  EXPECT_FALSE(counter.looks_different(1));
}

TEST(PassCounter, FindsNoCompanyWhereOnlyAnotherSessionIsRecognised) {
  auto counter = road(12);
  for (std::uint32_t id = 101; id <= 112; ++id) counter.set_landmark(id, {50.0 * (id - 100), 1.0}, 2);
  std::vector<LandmarkPass> passes;
  for (double x = 0.0; x <= 650.0; x += 1.0) {
    const auto ended = counter.move_to({x, 0.0});
    passes.insert(passes.end(), ended.begin(), ended.end());
    for (std::uint32_t id = 1; id <= 12; ++id) {
      if (x == 50.0 * id) counter.recognised(100 + id);
    }
  }
  ASSERT_EQ(passes.size(), 24U);
  for (const auto& pass : passes) {
    EXPECT_EQ(pass.recognised, pass.id > 100);
    EXPECT_FALSE(pass.id < 100 && pass.in_company) << pass.id;
  }
  EXPECT_TRUE(counter.looks_different(1));
  EXPECT_FALSE(counter.looks_different(2));
}

TEST(LandmarkUse, CountsMissesSinceTheLastRecognition) {
  LandmarkUse use{7};
  add({1, false, true}, use);
  add({1, false, false}, use);
  EXPECT_EQ(use, (LandmarkUse{7, 2, 0, 2, 1}));
  add({1, true, true}, use);
  EXPECT_EQ(use, (LandmarkUse{7, 3, 1, 0, 0}));
}

/// A made-up map over many drives along a road with a place every 50 m. Each landmark has the look of its day; a new one is
/// built where none of a place is recognised.
class Map {
 public:
  static constexpr int kPlaces = 40;

  Map() {
    for (int place = 1; place <= kPlaces; ++place) add_at(place, 0, 1);
  }

  struct Landmark {
    int place = 0, look = 0;
    LandmarkUse use;
  };

  /// `look(place)`: that of landmarks built today; `is_recognised(landmark)`: today.
  void drive(const std::function<int(int)>& look, const std::function<bool(const Landmark&)>& is_recognised) {
    std::erase_if(landmarks_, [&](const auto& entry) { return rules_.forgets(entry.second.use); });
    ++session_;
    const auto before = landmarks_;
    PassCounter counter;
    for (const auto& [id, landmark] : landmarks_) {
      counter.set_landmark(id, {50.0 * landmark.place, 0.0}, landmark.use.session);
    }
    for (double x = 0.0; x < 50.0 * (kPlaces + 1); x += 1.0) {
      for (const auto& pass : counter.move_to({x, 0.0})) {
        if (const auto passed = landmarks_.find(pass.id); passed != landmarks_.end()) add(pass, passed->second.use);
      }
      const int place = static_cast<int>(x / 50.0);
      if (place * 50.0 != x || place < 1) continue;
      const auto seen = std::find_if(landmarks_.begin(), landmarks_.end(), [&](const auto& entry) {
        return entry.second.place == place && is_recognised(entry.second);
      });
      if (seen != landmarks_.end()) {
        counter.recognised(seen->first);
      } else {
        build(place, look(place), before, counter);
      }
    }
  }

  std::size_t size() const { return landmarks_.size(); }
  std::size_t of_look(int look) const {
    return static_cast<std::size_t>(std::count_if(landmarks_.begin(), landmarks_.end(),
                                                  [&](const auto& entry) { return entry.second.look == look; }));
  }

 private:
  void build(int place, int look, const std::map<std::uint32_t, Landmark>& before, const PassCounter& counter) {
    std::vector<std::uint32_t> ids;
    std::vector<UseRules::Neighbour> neighbours;
    for (const auto& [id, landmark] : before) {
      if (landmark.place != place) continue;
      ids.push_back(id);
      neighbours.push_back({landmark.use, counter.looks_different(landmark.use.session)});
    }
    const auto admission = rules_.admit(neighbours);
    if (!admission.is_kept) return;
    if (admission.instead_of) landmarks_.erase(ids[*admission.instead_of]);
    add_at(place, look, session_);
  }
  void add_at(int place, int look, std::uint32_t session) { landmarks_[next_++] = {place, look, {session}}; }

  UseRules rules_;
  std::map<std::uint32_t, Landmark> landmarks_;
  std::uint32_t next_ = 1, session_ = 1;
};

/// Numbers from 0 to 1, the same in each run.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

constexpr auto kPlaces = static_cast<std::size_t>(Map::kPlaces);

std::function<int(int)> all(int look) {
  return [look](int) { return look; };
}

std::function<bool(const Map::Landmark&)> of_look(int look) {
  return [look](const Map::Landmark& landmark) { return landmark.look == look; };
}

TEST(UseRules, AMapStopsGrowingWhereverPlacesAreMissedByChance) {
  for (const double missed : {0.02, 0.07, 0.15}) {
    std::size_t after_ten = 0, after_fifty = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Map map;
      Draw draw(seed);
      for (int day = 1; day <= 50; ++day) {
        map.drive(all(0), [&](const Map::Landmark&) { return draw() >= missed; });
        if (day == 10) after_ten += map.size();
      }
      after_fifty += map.size();
      EXPECT_EQ(map.of_look(0), map.size());
      EXPECT_GE(map.size(), kPlaces);
    }
    EXPECT_LE(static_cast<double>(after_fifty), 1.05 * static_cast<double>(after_ten)) << missed;
  }
}

TEST(UseRules, WinterIsLearnedOnItsSecondDayAndSummerIsKept) {
  Map map;
  map.drive(all(1), of_look(1));
  EXPECT_EQ(map.of_look(1), 0U);
  map.drive(all(1), of_look(1));
  EXPECT_GE(map.of_look(1), kPlaces - PassCounter::kEnoughOther - 1) << "all but those passed before it was known";
  for (int day = 3; day <= 60; ++day) map.drive(all(1), of_look(1));
  EXPECT_EQ(map.of_look(1), kPlaces);
  EXPECT_EQ(map.of_look(0), kPlaces);
}

TEST(UseRules, SummerIsKeptThoughSomeOfItIsRecognisedInAllOfALongWinter) {
  for (const int percent : {5, 20, 40, 60}) {
    Map map;
    for (int day = 1; day <= 60; ++day) {
      map.drive(all(1), [&](const Map::Landmark& landmark) {
        return landmark.look == 1 || landmark.place * 37 % 100 < percent;
      });
    }
    EXPECT_EQ(map.of_look(0), kPlaces) << percent << " % recognised in winter";
  }
}

TEST(UseRules, ARepaintedPlaceIsLearnedOnItsFourthDay) {
  Map map;
  const auto repainted = [](int place) { return place == 7 ? 1 : 0; };
  const auto is_recognised = [&](const Map::Landmark& landmark) { return landmark.look == repainted(landmark.place); };
  for (int day = 1; day <= 3; ++day) map.drive(repainted, is_recognised);
  EXPECT_EQ(map.of_look(1), 0U);
  map.drive(repainted, is_recognised);
  EXPECT_EQ(map.of_look(1), 1U);
}

TEST(UseRules, TheOldLookOfARepaintedPlaceIsForgotten) {
  Map map;
  const auto repainted = [](int place) { return place == 27 ? 1 : 0; };
  const auto is_recognised = [&](const Map::Landmark& landmark) { return landmark.look == repainted(landmark.place); };
  for (int day = 1; day <= 10; ++day) map.drive(repainted, is_recognised);
  EXPECT_EQ(map.of_look(0), kPlaces);
  map.drive(repainted, is_recognised);
  EXPECT_EQ(map.of_look(0), kPlaces - 1);
  EXPECT_EQ(map.of_look(1), 1U);
}

TEST(UseRules, APlaceHasABoundedNumberOfAppearances) {
  Map map;
  for (int day = 0; day < 80; ++day) {
    map.drive(all(day / 8), of_look(day / 8));
    EXPECT_LE(map.size(), 4U * kPlaces);
  }
  EXPECT_GE(map.of_look(9), kPlaces - PassCounter::kEnoughOther - 1) << "the newest replaced the oldest";
}

}  // namespace
}  // namespace panvo::landmarks
