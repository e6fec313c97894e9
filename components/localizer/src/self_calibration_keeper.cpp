// SPDX-License-Identifier: Apache-2.0
#include "self_calibration_keeper.hpp"

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "self_calibration_file.hpp"

namespace panvo::localizer {
namespace {

constexpr std::int64_t kSavePeriod_ns = 10'000'000'000;
constexpr double kNotableChange = 0.5;  // of the standard deviation that was saved
constexpr double kNotableSigma = 0.8;   // of it or by it: what a tenth of the measurements changes is noise

/// Replaces a saved estimate by a measured one. Returns whether that is notable.
bool take(std::optional<Estimate>& saved, const std::optional<Estimate>& measured) {
  if (!measured) return false;
  const bool is_notable = !saved || std::abs(measured->value - saved->value) > kNotableChange * saved->sigma ||
                          measured->sigma < kNotableSigma * saved->sigma ||
                          saved->sigma < kNotableSigma * measured->sigma;
  if (is_notable) saved = measured;
  return is_notable;
}

}  // namespace

SelfCalibrationKeeper::SelfCalibrationKeeper(runtime::Context& context, std::filesystem::path file,
                                             Localizer& localizer)
    : context_(context), file_(std::move(file)), localizer_(localizer) {
  if (file_.empty()) return;
  read();
  context.on_end([this] { write(); });
}

SelfCalibrationKeeper::~SelfCalibrationKeeper() {
  if (!file_.empty()) write();
}

void SelfCalibrationKeeper::keep(std::int64_t stamp_ns) {
  if (file_.empty() || (kept_ns_ && std::abs(stamp_ns - *kept_ns_) < kSavePeriod_ns)) return;
  kept_ns_ = stamp_ns;
  write();
}

void SelfCalibrationKeeper::read() {
  context_.about_to_read(file_);
  try {
    const auto known = read_self_calibration(file_);
    if (!known) return;
    saved_ = *known;
    localizer_.set_self_calibration(*known);
    const std::string text = to_text(*known);
    if (!text.empty()) context_.log().info("{}: until measured again, {}", file_.string(), text);
  } catch (const std::runtime_error& error) {
    context_.log().warn("{}", error.what());
  }
}

void SelfCalibrationKeeper::write() {
  const SelfCalibration measured = localizer_.self_calibration();
  SelfCalibration now = saved_;
  bool is_notable = take(now.panorama_ahead_s, measured.panorama_ahead_s);
  is_notable |= take(now.direction_rad, measured.direction_rad);
  is_notable |= take(now.turn_scale, measured.turn_scale);
  is_notable |= take(now.scale, measured.scale);
  if (!is_notable) return;
  try {
    write_self_calibration(file_, now);
    saved_ = now;
  } catch (const std::exception& error) {
    context_.log().warn_throttled("self-calibration", "{}", error.what());
  }
}

}  // namespace panvo::localizer
