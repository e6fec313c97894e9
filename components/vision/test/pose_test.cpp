// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>
#include <random>

namespace panvo::vision {
namespace {

const Vector6d kTwist = (Vector6d() << 1.2, -0.4, 0.3, 0.7, -0.5, 0.2).finished();
const Vector6d kOtherTwist = (Vector6d() << -0.3, 2.0, 0.9, -0.1, 0.3, 0.8).finished();

Matrix6d some_covariance(double sigma_m, double sigma_rad) {
  Matrix6d mixing = Matrix6d::Identity();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < row; ++column) mixing(row, column) = 0.1 * (row - 2 * column);
  }
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(sigma_m), Eigen::Vector3d::Constant(sigma_rad);
  return sigma.asDiagonal() * mixing * mixing.transpose() * sigma.asDiagonal();
}

class Sampler {
 public:
  // A pose whose pose_error against `mean` has the given covariance.
  Eigen::Isometry3d disturb(const Eigen::Isometry3d& mean, const Matrix6d& covariance) {
    Vector6d unit;
    for (double& value : unit) value = normal_(random_);
    const Vector6d error = covariance.llt().matrixL() * unit;
    Eigen::Isometry3d sample = mean;
    sample.translation() += error.head<3>();
    sample.linear() = so3_exp(error.tail<3>()) * mean.linear();
    return sample;
  }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

TEST(So3, LogUndoesExpAtEveryAngle) {
  for (const double angle : {0.0, 1e-9, 1e-6, 1e-3, 1.0, 3.0, std::numbers::pi - 1e-7}) {
    const Eigen::Vector3d rotation = angle * Eigen::Vector3d(0.6, -0.48, 0.64);
    EXPECT_LT((so3_log(so3_exp(rotation)) - rotation).norm(), 1e-9) << angle;
  }
}

TEST(Se3, LogUndoesExp) {
  EXPECT_LT((se3_log(se3_exp(kTwist)) - kTwist).norm(), 1e-12);
  EXPECT_LT((se3_log(se3_exp(1e-7 * kTwist)) - 1e-7 * kTwist).norm(), 1e-15);
}

TEST(Se3, HalfATwistTwiceIsTheWhole) {
  const Eigen::Isometry3d half = se3_exp(0.5 * kTwist);
  EXPECT_TRUE((half * half).isApprox(se3_exp(kTwist), 1e-12));
}

TEST(Adjoint, TakesATwistFromOneFrameToAnother) {
  const Eigen::Isometry3d a_from_b = se3_exp(kOtherTwist);
  const Eigen::Isometry3d expected = a_from_b * se3_exp(kTwist) * a_from_b.inverse();
  EXPECT_TRUE(se3_exp(adjoint(a_from_b) * kTwist).isApprox(expected, 1e-10));
}

TEST(NearestRotation, UndoesRounding) {
  const Eigen::Matrix3d rotation = so3_exp({0.4, -0.2, 1.0});
  const Eigen::Matrix3d rounded = rotation + 1e-6 * Eigen::Matrix3d::Random();
  EXPECT_LT((nearest_rotation(rounded) - rotation).norm(), 1e-5);
  EXPECT_LT((nearest_rotation(rounded) * nearest_rotation(rounded).transpose() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
}

TEST(ComposeCovariance, AgreesWithMonteCarlo) {
  const Eigen::Isometry3d a_from_b = se3_exp(kTwist), b_from_c = se3_exp(kOtherTwist);
  const Matrix6d first = some_covariance(0.02, 0.004), second = some_covariance(0.01, 0.006);
  Sampler sampler;
  Matrix6d sampled = Matrix6d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Vector6d error =
        pose_error(a_from_b * b_from_c, sampler.disturb(a_from_b, first) * sampler.disturb(b_from_c, second));
    sampled += error * error.transpose() / kSamples;
  }
  const Matrix6d predicted = compose_covariance(a_from_b, first, b_from_c, second);
  EXPECT_LT((sampled - predicted).norm(), 0.03 * predicted.norm());
}

TEST(Interpolate, GoesAtConstantTwistFromOneToTheOther) {
  const Vector6d twist = (Vector6d() << 1.0, 2.0, -0.5, 0.1, -0.2, 0.9).finished();
  const Eigen::Isometry3d from = se3_exp((Vector6d() << 0.3, 0.0, 1.0, 0.5, 0.2, 0.0).finished());
  EXPECT_TRUE(interpolate(from, from * se3_exp(twist), 0.0).isApprox(from, 1e-12));
  EXPECT_TRUE(interpolate(from, from * se3_exp(twist), 0.25).isApprox(from * se3_exp(0.25 * twist), 1e-12));
  EXPECT_TRUE(interpolate(from, from * se3_exp(twist), 1.0).isApprox(from * se3_exp(twist), 1e-12));
}

TEST(RotateCovariance, TurnsTranslationAndRotation) {
  const Matrix6d covariance = (Vector6d() << 1.0, 4.0, 9.0, 0.1, 0.2, 0.3).finished().asDiagonal();
  const Matrix6d turned = rotate_covariance(so3_exp(Eigen::Vector3d(0.0, 0.0, 0.5 * M_PI)), covariance);
  const Matrix6d expected = (Vector6d() << 4.0, 1.0, 9.0, 0.2, 0.1, 0.3).finished().asDiagonal();
  EXPECT_TRUE(turned.isApprox(expected, 1e-12));
}

TEST(StampCovariance, LiesAlongTheWayAndTheTurn) {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = so3_exp(Eigen::Vector3d(0.0, 0.0, M_PI / 2.0));
  Vector6d twist = Vector6d::Zero();
  twist[0] = 5.0;  // m/s ahead, which is a's left
  twist[5] = 0.5;
  Matrix6d expected = Matrix6d::Zero();
  expected(1, 1) = 0.1 * 0.1;
  expected(5, 5) = 0.01 * 0.01;
  expected(1, 5) = expected(5, 1) = 0.1 * 0.01;
  EXPECT_TRUE(stamp_covariance(a_from_b, twist, 0.02).isApprox(expected, 1e-12));
}

TEST(HorizontalSigma, IsThatOfTheWorstDirection) {
  Matrix6d covariance = (Vector6d() << 4.0, 1.0, 100.0, 0.0, 0.0, 0.0).finished().asDiagonal();
  EXPECT_NEAR(horizontal_sigma(covariance), 2.0, 1e-12);
  EXPECT_NEAR(horizontal_sigma(rotate_covariance(so3_exp(Eigen::Vector3d(0.0, 0.0, 0.7)), covariance)), 2.0, 1e-12);
}

TEST(InvertCovariance, AgreesWithMonteCarlo) {
  const Eigen::Isometry3d a_from_b = se3_exp(kTwist);
  const Matrix6d covariance = some_covariance(0.02, 0.004);
  Sampler sampler;
  Matrix6d sampled = Matrix6d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Vector6d error = pose_error(a_from_b.inverse(), sampler.disturb(a_from_b, covariance).inverse());
    sampled += error * error.transpose() / kSamples;
  }
  const Matrix6d predicted = invert_covariance(a_from_b, covariance);
  EXPECT_LT((sampled - predicted).norm(), 0.03 * predicted.norm());
}

}  // namespace
}  // namespace panvo::vision
