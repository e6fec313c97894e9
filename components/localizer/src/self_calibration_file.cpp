// SPDX-License-Identifier: Apache-2.0
#include "self_calibration_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "panvo/interfaces/check.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/clock_search.hpp"
#include "pose_lines.hpp"

namespace panvo::localizer {
namespace {

/// A line of the file, and its part in a sentence.
struct Line {
  const char* key;
  std::optional<Estimate> SelfCalibration::*quantity;
  double unit;                     ///< of the numbers in the file, in that of the quantity
  double least, most, most_sigma;  ///< of them
  const char* text;                ///< for `times` * (value - `perfect`)
  double times = 1.0, perfect = 0.0;
};

constexpr double kFarthest_s = vision::ClockSearch::kFarthest_s;

/// Bounds of values: what is searched, any direction, and what no calibrated camera exceeds. Of standard deviations: the
/// largest priors that parameters may state.
const std::array<Line, 4> kLines{{
    {"panorama_clock_ahead_s", &SelfCalibration::panorama_ahead_s, 1.0, -kFarthest_s, kFarthest_s, 1.0,
     "the panoramic camera's clock is {:+.0f} ms ahead", 1000.0},
    {"panorama_direction_left_deg", &SelfCalibration::direction_rad, vision::kDegree, -180.0, 180.0, 180.0,
     "its driving direction {:+.1f} deg to the left of the odometry's"},
    {"odometry_turn_error", &SelfCalibration::turn_scale, 1.0, -0.1, 0.1, 0.1, "odometry's turns {:+.2f} %", 100.0},
    {"odometry_scale", &SelfCalibration::scale, 1.0, 0.5, 2.0, 0.5, "its distances {:+.2f} %", 100.0, 1.0},
}};

Estimate estimate_of(const Lines& lines, const Line& line) {
  const auto values = numbers<double>(lines, line.key, 2);
  interfaces::Check check;
  check.within(line.key, values[0], line.least, line.most);
  check.within({line.key, "sigma"}, values[1], 0.0, line.most_sigma);
  if (check.problem()) throw std::runtime_error(*check.problem());
  return {line.unit * values[0], line.unit * values[1]};
}

FileKind self_calibration_kind() {
  FileKind kind{"calibration", {}};
  for (const auto& line : kLines) kind.keys.emplace_back(line.key);
  return kind;
}

SelfCalibration calibration_of(const Lines& lines) {
  SelfCalibration calibration;
  for (const auto& line : kLines) {
    if (lines.contains(line.key)) calibration.*line.quantity = estimate_of(lines, line);
  }
  return calibration;
}

}  // namespace

void write_self_calibration(const std::filesystem::path& file, const SelfCalibration& calibration) {
  std::string text;
  for (const auto& line : kLines) {
    const auto& quantity = calibration.*line.quantity;
    if (!quantity) continue;
    text += fmt::format("{} {} {}\n", line.key, quantity->value / line.unit, quantity->sigma / line.unit);
  }
  write_kept(file, self_calibration_kind(), text);
}

std::optional<SelfCalibration> read_self_calibration(const std::filesystem::path& file) {
  return read_kept(file, self_calibration_kind(), calibration_of);
}

std::string to_text(const SelfCalibration& calibration) {
  std::vector<std::string> parts;
  for (const auto& line : kLines) {
    const auto& quantity = calibration.*line.quantity;
    if (!quantity) continue;
    parts.push_back(fmt::format(fmt::runtime(line.text), line.times * (quantity->value / line.unit - line.perfect)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace panvo::localizer
