// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "panvo/evaluation/report.hpp"

namespace panvo::evaluation {

// The plot could not be drawn. The message names cause and remedy.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// gnuplot script, including the data, that writes evaluation.png and evaluation.svg into its working folder.
// Deterministic; names and titles are escaped so that they cannot act as commands.
std::string plot_script(const Report& report);

// Writes `folder`/evaluation.gp and runs gnuplot there. Throws PlotError, with the remedy, if gnuplot is not installed
// or fails.
void draw_plot(const Report& report, const std::filesystem::path& folder);

}  // namespace panvo::evaluation
