// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "panvo/evaluation/report.hpp"

namespace panvo::evaluation {

// The plot could not be drawn. The message says why and what to do.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The gnuplot program, data included, that writes evaluation.png and evaluation.svg into its working folder.
// It is the same text for the same report, and no name or title in it can act as a command.
std::string plot_script(const Report& report);

// Writes `folder`/evaluation.gp and lets gnuplot run it there. Throws PlotError, with the remedy, if gnuplot is not
// installed or fails.
void draw_plot(const Report& report, const std::filesystem::path& folder);

}  // namespace panvo::evaluation
