// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/place_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "made_up_view.hpp"
#include "painted_place.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/store_error.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::places {
namespace {

using test::paint_place;
using vision::kDegree;

PanoramaImage image_of(const cv::Mat& panorama) {
  auto fitted = fit_panorama(panorama, {}, {});
  EXPECT_FALSE(fitted.fault) << fitted.fault.value_or("");
  return fitted.image;
}

std::vector<KnownPlace> places(int count, const cv::Size& size) {
  std::vector<KnownPlace> made;
  for (int i = 0; i < count; ++i) {
    cv::Mat panorama;
    cv::resize(paint_place(static_cast<std::uint64_t>(i + 1)), panorama, size, 0.0, 0.0, cv::INTER_AREA);
    made.push_back(make_place("place" + std::to_string(i) + ".jpg", image_of(panorama)));
  }
  return made;
}

TEST(PlaceFinder, FindsPlacesTurnedTiltedDimmedAndSmall) {
  const PlaceFinder finder(places(6, {1080, 540}), {});
  for (std::size_t i = 0; i < 6; ++i) {
    const double heading_deg = 50.0 * static_cast<double>(i) - 140.0;
    cv::Mat view = test::render(paint_place(i + 1), test::moved(heading_deg, 6.0, 0.0, 0.0).linear());
    view.convertTo(view, CV_8U, 0.6, 5.0);
    cv::resize(view, view, {480, 240}, 0.0, 0.0, cv::INTER_AREA);
    const auto answer = finder.find(image_of(view));
    ASSERT_TRUE(answer.place) << answer.shared.reason;
    EXPECT_EQ(*answer.place, i);
    EXPECT_LT(std::abs(vision::wrap(answer.shared.view->heading_rad / kDegree - heading_deg, 360.0)), 1.0);
    EXPECT_EQ(answer.agreeing_places, 1);
  }
}

TEST(PlaceFinder, FindsPlacesOfAFewPixels) {
  const PlaceFinder finder(places(4, {120, 60}), {});
  for (std::size_t i = 0; i < 4; ++i) {
    cv::Mat view;
    cv::resize(test::render(paint_place(i + 1), test::moved(77.0, 0.0, 0.0, 0.0).linear()), view, {120, 60}, 0.0, 0.0,
               cv::INTER_AREA);
    const auto answer = finder.find(image_of(view));
    ASSERT_TRUE(answer.place) << answer.shared.reason;
    EXPECT_EQ(*answer.place, i);
    EXPECT_LT(std::abs(vision::wrap(answer.shared.view->heading_rad / kDegree - 77.0, 360.0)), 2.0);
  }
}

TEST(PlaceFinder, DoesNotKnowOtherPlacesAndNoise) {
  const PlaceFinder finder(places(6, {1080, 540}), {});
  for (std::uint64_t seed = 50; seed < 54; ++seed) {
    const auto answer = finder.find(image_of(paint_place(seed)));
    EXPECT_FALSE(answer.place);
    EXPECT_FALSE(answer.shared.reason.empty());
    cv::Mat noise(540, 1080, CV_8UC1);
    cv::RNG random(seed);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    EXPECT_FALSE(finder.find(image_of(noise)).place);
  }
}

TEST(PlaceFinder, VerifiesOnlyTheMostSimilarOfMany) {
  PlaceFinderParameters parameters;
  parameters.max_verified = 2;
  const PlaceFinder finder(places(8, {1080, 540}), parameters);
  const auto answer = finder.find(image_of(test::render(paint_place(5), test::moved(-30.0, 0.0, 0.0, 0.0).linear())));
  EXPECT_EQ(answer.verified, 2);
  ASSERT_TRUE(answer.place);
  EXPECT_EQ(*answer.place, 4U);
}

TEST(PlaceFinder, KnowsNothingWithoutPlaces) {
  const auto answer = PlaceFinder({}, {}).find(image_of(paint_place(1)));
  EXPECT_FALSE(answer.place);
  EXPECT_EQ(answer.shared.reason, "the library is empty");
}

TEST(PlaceLibrary, ComesBackFromItsFile) {
  const panvo::test::TemporaryFolder folder;
  auto made = places(2, {1080, 540});
  made[1].map_from_base = Eigen::Isometry3d(Eigen::Translation3d(3.0, -4.0, 0.0));
  save_places(folder / "a.places", made);
  save_places(folder / "a.places", made);  // replaces
  const auto loaded = load_places(folder / "a.places");
  ASSERT_EQ(loaded.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(loaded[i].name, made[i].name);
    EXPECT_EQ(loaded[i].description, made[i].description);
    EXPECT_EQ(loaded[i].keypoints, made[i].keypoints);
    EXPECT_EQ(loaded[i].thumbnail, made[i].thumbnail);
  }
  EXPECT_FALSE(loaded[0].map_from_base);
  ASSERT_TRUE(loaded[1].map_from_base);
  EXPECT_EQ(loaded[1].map_from_base->translation().y(), -4.0);
}

TEST(PlaceLibrary, IsNotTheLandmarkStoreOfARun) {
  const panvo::test::TemporaryFolder folder;
  {
    const landmarks::LandmarkStore store(folder / "run.landmarks",
                                         landmarks::description_settings(landmarks::DescriptionParameters{}, 1));
  }
  EXPECT_THROW(load_places(folder / "run.landmarks"), landmarks::StoreError);
  EXPECT_THROW(load_places(folder / "absent"), landmarks::StoreError);
}

}  // namespace
}  // namespace panvo::places
