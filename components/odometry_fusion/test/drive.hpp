// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include "panvo/odometry_fusion/odometry_fusion.hpp"

namespace panvo::odometry_fusion {

/// Velocity of base_link and its rotation rates.
struct TrueMotion {
  double forward_m_s = 0.0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
};

/// A drive with sensors at their usual rates, and their errors.
struct Drive {
  double duration_s = 120.0;
  unsigned seed = 1;
  std::function<TrueMotion(double t_s)> motion;
  bool has_gyro = true, has_wheels = true;
  double blind_from_s = 1e9, blind_to_s = 1e9;  // no usable image
  double wheel_scale = 1.01, wheel_yaw_scale = 1.05;
  Eigen::Vector3d gyro_bias{0.004, -0.006, 0.01};
  double gyro_late_s = 0.0, wheels_late_s = 0.0;
  int stereo_delay_ms = 0;  // from the image to the pose
  std::function<void(double t_s, GyroSample&)> gyro_fault = [](double, GyroSample&) {};
  std::function<void(double t_s, WheelSample&)> wheel_fault = [](double, WheelSample&) {};
  std::function<void(double t_s, Eigen::Isometry3d& step)> stereo_fault = [](double, Eigen::Isometry3d&) {};
  /// Called after each sample of the gyroscope with the true pose at it.
  std::function<void(const OdometryFusion&, double t_s, const Eigen::Isometry3d& truth)> watch =
      [](const OdometryFusion&, double, const Eigen::Isometry3d&) {};
};

/// Truth and estimate at one stereo pose.
struct Outcome {
  double t_s;
  Eigen::Isometry3d truth, stereo;
  vision::Matrix6d stereo_covariance;
  FusedPose fused;

  double error_m() const { return (fused.odom_from_base.translation() - truth.translation()).norm(); }
  double stereo_error_m() const { return (stereo.translation() - truth.translation()).norm(); }
  /// Normalised squared error of x, y and yaw, divided by its expectation.
  double nees() const {
    const vision::Vector6d error = vision::pose_error(fused.odom_from_base, truth);
    const Eigen::Vector3d plane(error[0], error[1], error[5]);
    Eigen::Matrix3d covariance;
    constexpr int kAt[] = {0, 1, 5};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) covariance(i, j) = fused.covariance(kAt[i], kAt[j]);
    }
    return plane.dot(covariance.ldlt().solve(plane)) / 3.0;
  }
};

/// Stands for two seconds, then drives at 5 m/s, slower in a turn by 90 degrees every 15 s, alternately two to the left
/// and one to the right; shakes while it moves.
inline TrueMotion town(double t_s) {
  const auto ramp = [](double x) { return x <= 0.0 ? 0.0 : x >= 1.0 ? 1.0 : x * x * (3.0 - 2.0 * x); };
  const double moving = ramp((t_s - 2.0) / 4.0);
  const double phase = std::fmod(t_s, 15.0);
  const double bump = phase > 6.0 && phase < 12.0 ? std::pow(std::sin(M_PI * (phase - 6.0) / 6.0), 2) : 0.0;
  const double sign = std::fmod(t_s, 45.0) < 30.0 ? 1.0 : -1.0;
  const double speed = moving * (5.0 - 2.0 * bump);
  return {speed, Eigen::Vector3d(moving * 0.03 * std::sin(11.0 * t_s), moving * 0.04 * std::sin(13.0 * t_s + 1.0),
                                 t_s > 4.0 ? sign * bump * M_PI / 6.0 : 0.0)};
}

class Simulator {
 public:
  explicit Simulator(Drive drive)
      : drive_(std::move(drive)),
        stereo_noise_{drive_.seed},
        gyro_noise_{drive_.seed + 1000},
        wheel_noise_{drive_.seed + 2000} {}

  std::vector<Outcome> run(OdometryFusion& fusion) {
    std::vector<Outcome> outcomes;
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity(), before = truth;
    Eigen::Isometry3d stereo = truth;
    vision::Matrix6d covariance = vision::Matrix6d::Zero();
    std::vector<Outcome> frames;
    std::deque<StereoPose> waiting;
    redraw();
    const auto collect = [&] {
      while (const auto fused = fusion.next()) {
        for (auto& frame : frames) {
          if (std::llround(frame.t_s * 1e9) + kBegin_ns != fused->stamp_ns) continue;
          frame.fused = *fused;
          outcomes.push_back(frame);
        }
        if (frames.size() > 50) frames.erase(frames.begin(), frames.begin() + 20);
      }
    };
    const int count = static_cast<int>(std::lround(drive_.duration_s * 1000.0));
    for (int ms = 0; ms <= count; ms += kTick_ms) {
      const double t_s = 1e-3 * ms;
      if (drive_.has_gyro) fusion.add(gyro(t_s));
      if (ms % 20 == 0 && drive_.has_wheels) fusion.add(wheels(t_s));
      if (ms % 40 == 0) {
        Eigen::Isometry3d move = before.inverse() * truth;
        before = truth;
        const bool is_blind = t_s > drive_.blind_from_s && t_s <= drive_.blind_to_s;
        vision::Vector6d sigma = disturb(move);
        drive_.stereo_fault(t_s, move);
        if (is_blind) {
          move = last_move_;
          sigma += (vision::Vector6d() << 0.05, 0.05, 0.02, 0.005, 0.005, 0.02).finished();
        }
        last_move_ = move;
        covariance =
            vision::compose_covariance(stereo, covariance, move, vision::Matrix6d(sigma.cwiseAbs2().asDiagonal()));
        stereo = stereo * move;
        frames.push_back({t_s, truth, stereo, covariance, {}});
        waiting.push_back({stamp(t_s), stereo, covariance, !is_blind});
      }
      while (!waiting.empty() && waiting.front().stamp_ns <= stamp(t_s - 1e-3 * drive_.stereo_delay_ms)) {
        fusion.add(waiting.front());
        waiting.pop_front();
      }
      collect();
      drive_.watch(fusion, t_s, truth);
      const TrueMotion now = drive_.motion(t_s + 5e-4 * kTick_ms);
      vision::Vector6d twist;
      twist << now.forward_m_s, 0.0, 0.0, now.rate_rad_s;
      truth = truth * vision::se3_exp(1e-3 * kTick_ms * twist);
    }
    return outcomes;
  }

  static std::int64_t stamp(double t_s) { return kBegin_ns + std::llround(t_s * 1e9); }

 private:
  static constexpr int kTick_ms = 5;
  static constexpr std::int64_t kBegin_ns = 1'000'000'000'000;
  static constexpr double kPersistence_m = 5.0, kRatio = 0.008, kRad_per_m = 3e-4;

  /// Each sensor has its own, so that a drive without one of them is otherwise the same.
  struct Noise {
    explicit Noise(unsigned seed) : random(seed) {}
    double operator()() { return normal(random); }

    std::mt19937 random;
    std::normal_distribution<double> normal;
  };

  void redraw() {
    for (double& one : persisting_) one = stereo_noise_();
  }

  GyroSample gyro(double t_s) {
    const auto noise = [this] { return Eigen::Vector3d(gyro_noise_(), gyro_noise_(), gyro_noise_()); };
    bias_walk_ += 2e-5 * std::sqrt(0.005) * noise();
    const double white = 3e-4 * std::sqrt(200.0);
    GyroSample sample{stamp(t_s + drive_.gyro_late_s),
                      1.002 * drive_.motion(t_s).rate_rad_s + drive_.gyro_bias + bias_walk_ + white * noise(), 0.0};
    drive_.gyro_fault(t_s, sample);
    return sample;
  }

  WheelSample wheels(double t_s) {
    const TrueMotion now = drive_.motion(t_s);
    const double way_m = 0.02 * now.forward_m_s;
    // Distances are random walks; ticks of 1 mm.
    const double rolled_m = way_m / drive_.wheel_scale + 0.008 * std::sqrt(way_m) * wheel_noise_() + tick_rest_m_;
    const double ticks_m = 1e-3 * std::floor(rolled_m / 1e-3);
    tick_rest_m_ = rolled_m - ticks_m;
    WheelSample sample{stamp(t_s + drive_.wheels_late_s),
                       ticks_m / 0.02,
                       0.0,
                       now.rate_rad_s.z() / drive_.wheel_yaw_scale + 0.008 * std::sqrt(way_m) * wheel_noise_() / 0.02,
                       0.0,
                       0.0};
    drive_.wheel_fault(t_s, sample);
    return sample;
  }

  /// Adds the error of the stereo odometry to a motion: constant over some metres, and white. Returns its sigma.
  vision::Vector6d disturb(Eigen::Isometry3d& move) {
    const double way_m = move.translation().norm();
    since_m_ += way_m;
    if (since_m_ > kPersistence_m) {
      since_m_ = 0.0;
      redraw();
    }
    vision::Vector6d per_m, white, error;
    per_m << Eigen::Vector3d::Constant(kRatio), Eigen::Vector3d::Constant(kRad_per_m);
    white << Eigen::Vector3d::Constant(2e-4), Eigen::Vector3d::Constant(3e-5);
    for (int i = 0; i < 6; ++i) error[i] = way_m * per_m[i] * persisting_[i] + white[i] * stereo_noise_();
    move.translation() += error.head<3>();
    move.linear() = vision::so3_exp(error.tail<3>()) * move.linear();
    return (way_m * kPersistence_m * per_m.cwiseAbs2() + white.cwiseAbs2()).cwiseSqrt();
  }

  Drive drive_;
  Noise stereo_noise_, gyro_noise_, wheel_noise_;
  vision::Vector6d persisting_ = vision::Vector6d::Zero();
  double since_m_ = 0.0, tick_rest_m_ = 0.0;
  Eigen::Vector3d bias_walk_ = Eigen::Vector3d::Zero();
  Eigen::Isometry3d last_move_ = Eigen::Isometry3d::Identity();
};

/// Root mean square of the errors.
inline double rms_m(const std::vector<Outcome>& outcomes) {
  double sum = 0.0;
  for (const auto& one : outcomes) sum += one.error_m() * one.error_m();
  return std::sqrt(sum / static_cast<double>(outcomes.size()));
}

inline std::vector<Outcome> drive(const Drive& options, OdometryFusion& fusion) {
  return Simulator(options).run(fusion);
}
inline std::vector<Outcome> drive(const Drive& options) {
  OdometryFusion fusion({});
  return drive(options, fusion);
}

}  // namespace panvo::odometry_fusion
