// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_evidence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "made_up_keypoints.hpp"

namespace panvo::stereo_places {
namespace {

constexpr double kFieldOfView_rad = 1.05;

ViewEvidence judged(const std::vector<landmarks::Keypoint>& view, const std::vector<landmarks::Keypoint>& place,
                    const Eigen::Isometry3d& pose, double log10_places = 2.0) {
  return judge_view(view, place, pose, kFieldOfView_rad, log10_places, {});
}

/// The view with the bearings of all keypoints that `is_wrong` accepts thrown anywhere into the view.
template <class IsWrong>
std::vector<landmarks::Keypoint> partly_wrong(std::vector<landmarks::Keypoint> view, IsWrong is_wrong) {
  std::mt19937_64 random(5);
  for (auto& keypoint : view) {
    if (!is_wrong(keypoint)) continue;
    const double x = static_cast<double>(random() % 1000) / 1000.0 - 0.5;
    keypoint.bearing = Eigen::Vector3d(x, static_cast<double>(keypoint.bearing.y()), 1.0).normalized().cast<float>();
  }
  return view;
}

TEST(ViewEvidence, AcceptsThePlaceSeenFromAnotherPose) {
  const auto place = made_up_place(1);
  const auto pose = moved(2.0, 0.1);
  const auto evidence = judged(seen_from(place, pose), place, pose);
  EXPECT_EQ(evidence.objection, "");
  EXPECT_GT(evidence.agreeing, 60);
  EXPECT_LT(evidence.log10_expected, -100.0);
  EXPECT_LT(evidence.log10_without_object, -50.0);
}

TEST(ViewEvidence, ExplainsRandomAgreementByChance) {
  const auto place = made_up_place(1);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto view = seen_from(place, moved(2.0), seed);
    std::mt19937_64 random(seed);
    for (auto& keypoint : view) std::swap(keypoint.bearing, view[random() % view.size()].bearing);
    const auto evidence = judged(view, place, moved(2.0));
    EXPECT_NE(evidence.objection.find("chance"), std::string::npos) << evidence.log10_expected;
  }
}

TEST(ViewEvidence, RefusesAnObjectThatStandsElsewhereAgain) {
  const auto place = made_up_place(1, 200);
  const auto pose = moved(0.3);
  const auto is_beside = [](const landmarks::Keypoint& keypoint) { return keypoint.bearing.x() < 0.15F; };
  const auto evidence = judged(partly_wrong(seen_from(place, pose), is_beside), place, pose);
  EXPECT_LT(evidence.log10_expected, -20.0);
  EXPECT_NE(evidence.objection.find("only in one part of the view"), std::string::npos) << evidence.objection;
}

/// A zebra crossing all over the view, and things that are elsewhere other ones.
TEST(ViewEvidence, RefusesEqualMarkingsOnTheRoad) {
  auto place = made_up_place(1, 200);
  for (std::size_t i = 0; i < place.size(); i += 2) {
    auto& point = place[i].point_in_panorama;
    point = Eigen::Vector3f(point.x() * 0.3F, 1.3F, 4.0F + 0.2F * point.z());
    place[i].bearing = point.normalized();
  }
  const auto pose = moved(0.5);
  int count = 0;
  const auto is_no_marking = [&](const landmarks::Keypoint&) { return ++count % 2 == 0; };
  const auto evidence = judged(partly_wrong(seen_from(place, pose), is_no_marking), place, pose);
  EXPECT_LT(evidence.log10_without_object, -10.0);
  EXPECT_NE(evidence.objection.find("only on one flat surface"), std::string::npos) << evidence.objection;
}

TEST(ViewEvidence, AcceptsAPlaceOfWhichHalfHasChangedEverywhere) {
  const auto place = made_up_place(1, 200);
  const auto pose = moved(2.0);
  int count = 0;
  const auto evidence =
      judged(partly_wrong(seen_from(place, pose), [&](const auto&) { return ++count % 2 == 0; }), place, pose);
  EXPECT_EQ(evidence.objection, "");
}

TEST(ViewEvidence, DemandsMoreAmongMorePlaces) {
  const auto place = made_up_place(1);
  const auto view = seen_from(place, moved(2.0));
  EXPECT_NEAR(judged(view, place, moved(2.0), 4.0).log10_expected - judged(view, place, moved(2.0), 1.0).log10_expected,
              3.0, 1e-9);
}

TEST(ViewEvidence, CountsMatchesOfOneThingOnce) {
  auto place = made_up_place(1, 20);
  const auto once = judged(seen_from(place, moved(0.0)), place, moved(0.0));
  std::mt19937_64 random(8);
  for (int i = 0; i < 20; ++i) {
    place.push_back(place[static_cast<std::size_t>(i)]);
    place.back().descriptor = made_up_descriptor(random);
  }
  const auto twice = judged(seen_from(place, moved(0.0)), place, moved(0.0));
  EXPECT_EQ(twice.matches, once.matches);
}

}  // namespace
}  // namespace panvo::stereo_places
