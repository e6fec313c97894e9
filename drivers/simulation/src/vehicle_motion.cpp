// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/vehicle_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulation {

using simulated_world::Random;

namespace {

constexpr double kTimeStep_s = 0.02;
constexpr int kSmoothingHalf = 7;  // steps to each side, applied three times: acceleration changes within 0.4 s
constexpr int kReach = 3 * kSmoothingHalf;
constexpr double kWheelBase_m = 2.6, kTrack_m = 1.5;
constexpr std::size_t kWaves = 6;

// A uniform cubic B-spline: value and derivatives with respect to its parameter. Control points beyond the ends are
// point reflections of those inside, so that it starts and ends at the first and last control point.
template <typename Value>
struct SplineValue {
  Value value, first;
};
template <typename Value>
SplineValue<Value> spline(const std::vector<Value>& controls, double parameter) {
  const auto last = static_cast<std::ptrdiff_t>(controls.size()) - 1;
  const double inside = std::clamp(parameter, 0.0, static_cast<double>(last));
  const auto i = std::min(static_cast<std::ptrdiff_t>(inside), last - 1);
  const double u = inside - static_cast<double>(i), v = 1.0 - u;
  const auto at = [&](std::ptrdiff_t k) { return controls[static_cast<std::size_t>(k)]; };
  const Value b = at(i), c = at(i + 1);
  const Value a = i > 0 ? at(i - 1) : Value(2.0 * b - c);
  const Value d = i + 2 <= last ? at(i + 2) : Value(2.0 * c - b);
  return {Value((v * v * v * a + (4.0 - 6.0 * u * u + 3.0 * u * u * u) * b + (4.0 - 6.0 * v * v + 3.0 * v * v * v) * c +
                 u * u * u * d) /
                6.0),
          Value(0.5 * (-v * v * a + (3.0 * u * u - 4.0 * u) * b + (4.0 * v - 3.0 * v * v) * c + u * u * d))};
}

void check(const DrivenPath& path, const MotionParameters& parameters) {
  const auto require = [](bool holds, const char* name, double value, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("vehicle motion: {} = {} must be {}", name, value, what));
  };
  require(parameters.min_speed_m_per_s > 0.0, "min_speed_m_per_s", parameters.min_speed_m_per_s, "positive");
  require(parameters.cruise_speed_m_per_s >= parameters.min_speed_m_per_s, "cruise_speed_m_per_s",
          parameters.cruise_speed_m_per_s, "at least min_speed_m_per_s");
  require(parameters.turn_acceleration_m_per_s2 > 0.0, "turn_acceleration_m_per_s2",
          parameters.turn_acceleration_m_per_s2, "positive");
  require(parameters.acceleration_m_per_s2 > 0.0, "acceleration_m_per_s2", parameters.acceleration_m_per_s2,
          "positive");
  require(parameters.standstill_s >= 0.0, "standstill_s", parameters.standstill_s, "zero or more");
  require(parameters.vibration >= 0.0, "vibration", parameters.vibration, "zero or more");

  require(parameters.turn_rate_rad_per_s > 0.0, "turn_rate_rad_per_s", parameters.turn_rate_rad_per_s, "positive");
  require(parameters.max_wait_s >= 0.0, "max_wait_s", parameters.max_wait_s, "zero or more");

  const std::size_t count = path.points.size();
  if (count < 2 || path.along_m.size() != count || path.curvature_per_m.size() != count) {
    throw std::invalid_argument(
        "vehicle motion: the path needs at least two points, each with arc length and curvature");
  }
}

void check_even(const std::vector<double>& along_m, std::size_t first, std::size_t last) {
  if (last <= first || last >= along_m.size()) {
    throw std::invalid_argument("vehicle motion: the path's turns in place must be inside it, in ascending order");
  }
  const double step = (along_m[last] - along_m[first]) / static_cast<double>(last - first);
  for (std::size_t i = first; i <= last; ++i) {
    if (!(std::abs(along_m[i] - along_m[first] - step * static_cast<double>(i - first)) < 0.5 * step)) {
      throw std::invalid_argument("vehicle motion: the path's points must be evenly spaced");
    }
  }
}

// Three moving averages, which together are nearly a Gaussian.
std::vector<double> smoothed_in_time(std::vector<double> values) {
  const auto last = static_cast<int>(values.size()) - 1;
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<double> raw = values;
    for (int i = 0; i <= last; ++i) {
      double sum = 0.0;
      for (int k = i - kSmoothingHalf; k <= i + kSmoothingHalf; ++k) {
        sum += raw[static_cast<std::size_t>(std::clamp(k, 0, last))];
      }
      values[static_cast<std::size_t>(i)] = sum / (2 * kSmoothingHalf + 1);
    }
  }
  return values;
}

double heading_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

// Sinusoids with incommensurate frequencies between `low` and `high` whose sum has the given `rms`.
template <typename Wave>
std::vector<Wave> waves(Random random, double low_hz, double high_hz, double rms) {
  constexpr std::array<double, kWaves> kRoots{1.41421356, 1.73205081, 2.23606798, 2.64575131, 3.31662479, 3.60555128};
  std::vector<Wave> made;
  for (const double root : kRoots) {
    const double share = (root - kRoots.front()) / (kRoots.back() - kRoots.front());
    const double hz = (low_hz + (high_hz - low_hz) * share) * random.uniform(0.97, 1.03);
    made.push_back({2.0 * std::numbers::pi * hz, random.uniform(0.0, 2.0 * std::numbers::pi),
                    rms * std::sqrt(2.0 / static_cast<double>(kWaves))});
  }
  return made;
}

}  // namespace

VehicleMotion::VehicleMotion(const DrivenPath& path, const simulated_world::Terrain& terrain,
                             const MotionParameters& parameters, std::uint64_t seed)
    : path_(path), terrain_(terrain), cruise_speed_m_per_s_(parameters.cruise_speed_m_per_s) {
  check(path, parameters);
  plan(parameters, seed);
  const Random random(seed, "vibration");
  pitch_ = waves<Wave>(random.part(0), 1.0, 3.0, parameters.vibration * parameters.pitch_rms_rad);
  roll_ = waves<Wave>(random.part(1), 0.9, 2.6, parameters.vibration * parameters.roll_rms_rad);
  height_ = waves<Wave>(random.part(2), 1.1, 3.0, parameters.vibration * parameters.height_rms_m);
}

void VehicleMotion::plan(const MotionParameters& parameters, std::uint64_t seed) {
  std::vector<std::size_t> ends = path_.turns_in_place;
  ends.push_back(path_.points.size() - 1);
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    check_even(path_.along_m, begin, end);
    const auto at = [&](std::size_t i) { return path_.points.begin() + static_cast<std::ptrdiff_t>(i); };
    lines_.push_back({{at(begin), at(end) + 1},
                      path_.along_m[begin],
                      (path_.along_m[end] - path_.along_m[begin]) / static_cast<double>(end - begin)});
    begin = end;
  }

  // standstill before and after: as configured, plus the reach of the smoothing
  const auto before = static_cast<std::size_t>(std::ceil(parameters.standstill_s / kTimeStep_s)) + kReach;
  arc_m_.assign(before, 0.0);
  Random random(seed, "waits");
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (i > 0) {
      const auto& ended = lines_[i - 1].points;
      const Eigen::Vector2d in = spline(ended, static_cast<double>(ended.size() - 1)).first;
      const Eigen::Vector2d out = spline(lines_[i].points, 0.0).first;
      const double angle = std::remainder(heading_of(out) - heading_of(in), 2.0 * std::numbers::pi);
      lines_[i].turned_rad = lines_[i - 1].turned_rad;
      turn_in_place(angle, random.uniform(0.0, parameters.max_wait_s), parameters.turn_rate_rad_per_s, lines_[i]);
    }
    follow(lines_[i], parameters);
  }
  arc_m_.insert(arc_m_.end(), 2 * kReach, path_.along_m.back());
  duration_s_ = kTimeStep_s * static_cast<double>(arc_m_.size() - 1);
  arc_m_ = smoothed_in_time(std::move(arc_m_));
  if (lines_.size() == 1) return;
  turned_rad_.resize(arc_m_.size(), lines_.back().turned_rad);
  turned_rad_ = smoothed_in_time(std::move(turned_rad_));
}

// Stands until the smoothing has ended, waits, and turns by `angle_rad` at a constant rate.
void VehicleMotion::turn_in_place(double angle_rad, double wait_s, double rate_rad_per_s, Line& next) {
  const double before_rad = next.turned_rad;
  const auto stands = static_cast<std::size_t>(std::ceil(wait_s / kTimeStep_s)) + 2 * kReach;
  const auto turns = static_cast<std::size_t>(std::ceil(std::abs(angle_rad) / (rate_rad_per_s * kTimeStep_s)));
  turned_rad_.resize(arc_m_.size() + stands, before_rad);
  for (std::size_t i = 0; i < turns; ++i) {
    turned_rad_.push_back(before_rad + angle_rad * static_cast<double>(i) / static_cast<double>(turns));
  }
  next.from_s = kTimeStep_s * (static_cast<double>(arc_m_.size() + stands) + 0.5 * static_cast<double>(turns));
  next.turned_rad += angle_rad;
  turned_rad_.resize(turned_rad_.size() + 2 * kReach, next.turned_rad);
  arc_m_.resize(turned_rad_.size(), next.begin_m);
}

// The fastest motion within all limits: limited by curvature, then by acceleration in a forward pass and by braking in
// a backward pass, to be smoothed in time, which keeps the limits.
void VehicleMotion::follow(const Line& line, const MotionParameters& parameters) {
  const std::size_t count = line.points.size();
  const auto first =
      static_cast<std::size_t>(std::ranges::lower_bound(path_.along_m, line.begin_m) - path_.along_m.begin());
  const double step = line.step_m;
  std::vector<double> speed(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double curvature_per_m = std::abs(path_.curvature_per_m[first + i]);
    const double in_turn = std::sqrt(parameters.turn_acceleration_m_per_s2 / std::max(curvature_per_m, 1e-6));
    speed[i] = std::clamp(in_turn, parameters.min_speed_m_per_s, parameters.cruise_speed_m_per_s);
  }
  speed.front() = speed.back() = 0.0;
  const double gain = 2.0 * parameters.acceleration_m_per_s2 * step;
  for (std::size_t i = 1; i < count; ++i) {
    speed[i] = std::min(speed[i], std::sqrt(speed[i - 1] * speed[i - 1] + gain));
  }
  for (std::size_t i = count - 1; i > 0; --i) {
    speed[i - 1] = std::min(speed[i - 1], std::sqrt(speed[i] * speed[i] + gain));
  }

  const std::size_t before = arc_m_.size();
  double segment_begins_s = 0.0, next_s = 0.0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double lasts = 2.0 * step / (speed[i] + speed[i + 1]);
    const double acceleration = (speed[i + 1] - speed[i]) / lasts;
    for (; next_s < segment_begins_s + lasts; next_s = kTimeStep_s * static_cast<double>(arc_m_.size() - before)) {
      const double t = next_s - segment_begins_s;
      arc_m_.push_back(line.begin_m + static_cast<double>(i) * step + (speed[i] + 0.5 * acceleration * t) * t);
    }
    segment_begins_s += lasts;
  }
}

double VehicleMotion::duration_s() const { return duration_s_; }

double VehicleMotion::cruise_speed_m_per_s() const { return cruise_speed_m_per_s_; }

const DrivenPath& VehicleMotion::path() const { return path_; }

double VehicleMotion::travelled_m(double t_s) const { return spline(arc_m_, t_s / kTimeStep_s).value; }

double VehicleMotion::speed_m_per_s(double t_s) const {
  return std::max(0.0, spline(arc_m_, t_s / kTimeStep_s).first / kTimeStep_s);
}

VehicleMotion::Place VehicleMotion::place(double t_s) const {
  const auto after = std::ranges::upper_bound(lines_.begin() + 1, lines_.end(), t_s, {}, &Line::from_s);
  const Line& line = *(after - 1);
  const auto [position, way] = spline(line.points, (travelled_m(t_s) - line.begin_m) / line.step_m);
  if (turned_rad_.empty()) return {position, heading_of(way)};
  const double turned_rad = spline(turned_rad_, t_s / kTimeStep_s).value;
  return {position, heading_of(way) + turned_rad - line.turned_rad};
}

double VehicleMotion::sum(const std::vector<Wave>& waves, double t_s) const {
  double total = 0.0;
  for (const Wave& wave : waves) total += wave.amplitude * std::sin(wave.per_s * t_s + wave.phase_rad);
  return total;
}

Eigen::Isometry3d VehicleMotion::world_from_base(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s_);
  const auto [position, heading] = place(t);
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading)), left(-ahead.y(), ahead.x());
  const double front = terrain_.height_m(position + 0.5 * kWheelBase_m * ahead);
  const double rear = terrain_.height_m(position - 0.5 * kWheelBase_m * ahead);
  const double on_left = terrain_.height_m(position + 0.5 * kTrack_m * left);
  const double on_right = terrain_.height_m(position - 0.5 * kTrack_m * left);

  const double shaking = speed_m_per_s(t) / cruise_speed_m_per_s_;
  const double nose_up = std::atan2(front - rear, kWheelBase_m) + shaking * sum(pitch_, t);
  const double left_up = std::atan2(on_left - on_right, kTrack_m) + shaking * sum(roll_, t);
  const double height = 0.5 * (front + rear) + shaking * sum(height_, t);

  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << position, height;
  pose.linear() =
      (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-nose_up, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(left_up, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return pose;
}

// From the poses just before and after: exact to about 1e-6, because the motion is twice differentiable.
vision::Vector6d VehicleMotion::twist(double t_s) const {
  constexpr double kApart_s = 1e-4;
  const double from = std::clamp(t_s - kApart_s, 0.0, duration_s_), to = std::clamp(t_s + kApart_s, 0.0, duration_s_);
  const Eigen::Isometry3d before = world_from_base(from), after = world_from_base(to), now = world_from_base(t_s);
  vision::Vector6d twist;
  twist.head<3>() = now.linear().transpose() * (after.translation() - before.translation()) / (to - from);
  twist.tail<3>() = vision::so3_log(before.linear().transpose() * after.linear()) / (to - from);
  return twist;
}

}  // namespace panvo::simulation
