// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/lens.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace panvo::vision {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const PinholeCamera kPinhole{400, 401, 319, 241, 640, 480};

std::string refusal(const std::string& model, const std::vector<double>& coefficients) {
  try {
    lens_camera(model, coefficients, kPinhole);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LensCamera, IsReadUnderTheNamesOfRosAndKalibr) {
  EXPECT_EQ(lens_camera("plumb_bob", std::vector{-0.3, 0.1, 0.0, 0.0, 0.02}, kPinhole).model, LensModel::kPlumbBob);
  EXPECT_EQ(lens_camera("radtan", std::vector{-0.3, 0.1, 0.0, 0.0}, kPinhole).model, LensModel::kPlumbBob);
  EXPECT_EQ(lens_camera("equidistant", std::vector{0.0, 0.0, 0.0, 0.0}, kPinhole).model, LensModel::kEquidistant);
  EXPECT_EQ(lens_camera("rational_polynomial", std::vector{1., 2., 0., 0., 3., 4., 5., 6.}, kPinhole).model,
            LensModel::kRational);
  for (const char* name : {"mei", "omni-radtan"}) {
    const auto camera = lens_camera(name, std::vector{-0.2, 0.1, 0.001, 0.002, 1.1}, kPinhole);
    EXPECT_EQ(camera.model, LensModel::kMei);
    EXPECT_THAT(camera.distortion, ElementsAre(-0.2, 0.1, 0.001, 0.002, 1.1, 0, 0, 0));
  }
}

TEST(LensCamera, NeedsNoModelWithoutDistortion) {
  EXPECT_EQ(lens_camera("", {}, kPinhole).model, LensModel::kPlumbBob);
  EXPECT_EQ(lens_camera("whatever", std::vector{0.0, 0.0}, kPinhole).model, LensModel::kPlumbBob);
}

TEST(LensCamera, TakesFurtherCoefficientsThatAreZero) {
  const std::vector<double> opencv{-0.3, 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(lens_camera("rational_polynomial", opencv, kPinhole).model, LensModel::kPlumbBob);
  EXPECT_EQ(lens_camera("plumb_bob", opencv, kPinhole).distortion[0], -0.3);
}

TEST(LensCamera, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal("division", {0.1}), AllOf(HasSubstr("'division'"), HasSubstr("equidistant"), HasSubstr("mei")));
  EXPECT_THAT(refusal("plumb_bob", {0.1, 0, 0, 0, 0, 0.2}), HasSubstr("6 coefficients"));
  EXPECT_THAT(refusal("equidistant", {0.1, 0, 0, 0, 0.2}), HasSubstr("5 coefficients"));
  EXPECT_THAT(refusal("mei", {0.1, 0, 0, 0}), HasSubstr("xi"));
  EXPECT_THAT(refusal("plumb_bob", {std::numeric_limits<double>::quiet_NaN()}), HasSubstr("not a number"));
}

}  // namespace
}  // namespace panvo::vision
