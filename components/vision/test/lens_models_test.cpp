// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/lens_models.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/ccalib/omnidir.hpp>
#include <set>
#include <string>

#include "example_lenses.hpp"
#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/lens_projection.hpp"

namespace panvo::vision {
namespace {

using Points = std::vector<cv::Point3d>;
using Pixels = std::vector<cv::Point2d>;

cv::Matx33d matrix_of(const LensCamera& camera) {
  const auto& p = camera.pinhole;
  return {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};
}

/// Pixels of points by another implementation of the model than ours. A model without one does not compile.
void project_otherwise(const Perspective& /*formula*/, const LensCamera& camera, const Points& points, Pixels& pixels) {
  const auto coefficients = ros_coefficients(camera);
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix_of(camera), coefficients, pixels);
}
void project_otherwise(const EquidistantLens& /*formula*/, const LensCamera& camera, const Points& points,
                       Pixels& pixels) {
  cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), matrix_of(camera),
                             cv::Vec4d(camera.distortion.data()));
}
void project_otherwise(const MeiLens& /*formula*/, const LensCamera& camera, const Points& points, Pixels& pixels) {
  cv::omnidir::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), matrix_of(camera), camera.distortion[4],
                             cv::Vec4d(camera.distortion.data()));
}

class EachLensModel : public ::testing::TestWithParam<LensModel> {
 protected:
  /// test(formula, coefficients): for the example of the model.
  template <class Test>
  void with_formula(const Test& test) const {
    visit_lens(GetParam(), [&](const auto& formula) { test(formula, camera.distortion.data()); });
  }

  LensCamera camera = test::example(GetParam());
  CameraModel model{camera};
};

TEST_P(EachLensModel, ProjectsAsAnotherImplementationDoes) {
  Points points{{0.3, -0.2, 1.0}, {-0.5, 0.4, 1.1}, {0.0, 0.1, 2.0}, {0.9, 0.8, 1.4}, {-0.2, 0.0, 3.0}};
  Pixels pixels;
  visit_lens(GetParam(), [&](const auto& formula) {
    if (!formula.kIsPerspective) points.emplace_back(-2.5, 1.4, 1.1);
    project_otherwise(formula, camera, points, pixels);
  });
  ASSERT_EQ(pixels.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = model.project({points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), pixels[i].x, 1e-9);
    EXPECT_NEAR(pixel->y(), pixels[i].y, 1e-9);
  }
}

TEST_P(EachLensModel, HasTheJacobianOfItsDistortion) {
  constexpr double kStep = 1e-6;
  with_formula([&]<LensFormula Formula>(const Formula& /*formula*/, const double* c) {
    for (double theta = 0.0; theta < model.widest_rad(); theta += 0.1) {
      const double r = Formula::radius(c, theta);
      const Eigen::Vector2d place(r * std::cos(3.0 * theta), r * std::sin(3.0 * theta));
      const auto distorted = [&](const Eigen::Vector2d& ideal) {
        return distortion_at<Formula>(c, ideal).apply(ideal);
      };
      const Eigen::Matrix2d jacobian = distortion_at<Formula>(c, place).jacobian(place);
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
        const Eigen::Vector2d difference = (distorted(place + step) - distorted(place - step)) / (2.0 * kStep);
        EXPECT_LT((jacobian.col(i) - difference).norm(), 1e-7 * (1.0 + difference.norm())) << theta << " rad, " << i;
      }
    }
  });
}

TEST_P(EachLensModel, HasARadiusThatGrowsUpToItsLimitAndItsInverse) {
  with_formula([&]<LensFormula Formula>(const Formula& /*formula*/, const double* c) {
    EXPECT_EQ(Formula::radius(c, 0.0), 0.0);
    double before = 0.0;
    for (double theta = 0.05; theta < Formula::limit_rad(c); theta += 0.05) {
      const double r = Formula::radius(c, theta);
      EXPECT_GT(r, before) << theta;
      before = r;
      const Eigen::Vector3d direction(std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7),
                                      std::cos(theta));
      EXPECT_LT((Formula::direction(c, {r * std::cos(0.7), r * std::sin(0.7)}) - direction).norm(), 1e-9) << theta;
    }
    EXPECT_LT((Formula::direction(c, {0.0, 0.0}) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  });
}

TEST_P(EachLensModel, IsContinuousOnTheAxis) {
  const auto on_axis = model.project(Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(on_axis);
  EXPECT_EQ(*on_axis, Eigen::Vector2d(camera.pinhole.cx, camera.pinhole.cy));
  for (const double off : {1e-3, 1e-6, 1e-9, 1e-300})
    EXPECT_LT((*model.project({off, -off, 1.0}) - *on_axis).norm(), 2.0 * off * camera.pinhole.fx);
}

TEST_P(EachLensModel, IsTheSameAfterWritingAndReading) {
  const auto back = lens_camera(ros_name(GetParam()), ros_coefficients(camera), camera.pinhole);
  EXPECT_EQ(back.model, GetParam());
  EXPECT_EQ(back.distortion, camera.distortion);
}

TEST_P(EachLensModel, NamesItsCoefficientsAndCanStartACalibration) {
  LensCamera first{camera.pinhole, GetParam()};
  std::set<std::string_view> names;
  for (const auto& coefficient : lens_coefficients(GetParam())) {
    EXPECT_TRUE(names.insert(coefficient.name).second) << coefficient.name;
    first.distortion.at(names.size() - 1) = coefficient.start;
  }
  EXPECT_NO_THROW(CameraModel{first});
}

INSTANTIATE_TEST_SUITE_P(Registered, EachLensModel, ::testing::ValuesIn(kLensModels),
                         [](const auto& tested) { return std::string(ros_name(tested.param)); });

TEST(LensModels, DifferInAllTheirNames) {
  std::set<std::string> names, kalibr_names;
  for (const auto model : kLensModels) {
    visit_lens(model, [&](const auto& formula) {
      EXPECT_TRUE(names.emplace(formula.kName).second) << formula.kName;
      for (const auto alias : formula.kAliases) EXPECT_TRUE(names.emplace(alias).second) << alias;
      EXPECT_FALSE(formula.kPurpose.empty()) << formula.kName;
      if (!formula.kKalibr) return;
      const auto& [projection, distortion, distortion_count, intrinsic_count] = *formula.kKalibr;
      EXPECT_TRUE(kalibr_names.emplace(std::string(projection) + "-" + std::string(distortion)).second);
      EXPECT_LE(distortion_count + intrinsic_count, formula.kCoefficients.size()) << formula.kName;
    });
  }
}

TEST(LensModels, AreFoundByAllTheirNames) {
  for (const auto model : kLensModels) {
    EXPECT_EQ(find_lens_model(ros_name(model)), model);
    visit_lens(model, [&](const auto& formula) {
      for (const auto alias : formula.kAliases) EXPECT_EQ(find_lens_model(alias), model) << alias;
    });
  }
  EXPECT_EQ(find_lens_model("division"), std::nullopt);
}

TEST(LensModels, RefuseAValueThatIsNone) {
  EXPECT_THROW(ros_name(static_cast<LensModel>(kLensModels.size())), std::out_of_range);
}

}  // namespace
}  // namespace panvo::vision
