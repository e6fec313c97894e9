// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace panvo::evaluation {

// Runs gnuplot on `script` (a file name in `folder`) with `folder` as working folder, without start-up files or a
// shell. Throws PlotError, with gnuplot's output, if it is not installed or fails.
void run_gnuplot(const std::filesystem::path& folder, const std::string& script);

// Writes `text` to `script` in `folder`, then runs it. Throws PlotError also if writing fails.
void write_and_run_gnuplot(const std::filesystem::path& folder, const std::string& script, const std::string& text);

// A gnuplot string in single quotes, in which gnuplot substitutes nothing. Quotes become apostrophes (UTF-8), control
// characters become spaces.
std::string gnuplot_quoted(const std::string& text);

}  // namespace panvo::evaluation
