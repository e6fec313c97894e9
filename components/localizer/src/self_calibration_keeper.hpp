// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "panvo/localizer/localizer.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::localizer {

/// Begins with what earlier runs measured of the sensors, and saves what this one measures for the next. What it does not
/// measure remains in the file.
class SelfCalibrationKeeper {
 public:
  /// Before any odometry. `file`: empty for none. Context and localizer must outlive it.
  SelfCalibrationKeeper(runtime::Context& context, std::filesystem::path file, Localizer& localizer);
  /// Saves the rest when the component is unloaded before the end of the run.
  ~SelfCalibrationKeeper();
  SelfCalibrationKeeper(const SelfCalibrationKeeper&) = delete;
  SelfCalibrationKeeper& operator=(const SelfCalibrationKeeper&) = delete;

  /// To be called with each pose of new odometry. Saves notable changes every ten seconds; the rest at the end of the run.
  void keep(std::int64_t stamp_ns);

 private:
  void read();
  void write();

  runtime::Context& context_;
  const std::filesystem::path file_;
  Localizer& localizer_;
  SelfCalibration saved_;
  std::optional<std::int64_t> kept_ns_;
};

}  // namespace panvo::localizer
