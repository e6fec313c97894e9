// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "panvo/localizer/self_calibration.hpp"

namespace panvo::localizer {

/// As write_kept() and read_kept(). A line for each quantity: its name with the unit, value, standard deviation.
void write_self_calibration(const std::filesystem::path& file, const SelfCalibration& calibration);
std::optional<SelfCalibration> read_self_calibration(const std::filesystem::path& file);

/// The quantities in a sentence, for the log; empty if there is none.
std::string to_text(const SelfCalibration& calibration);

}  // namespace panvo::localizer
