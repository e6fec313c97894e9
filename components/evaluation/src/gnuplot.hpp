// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace panvo::evaluation {

// Runs gnuplot on `script` (a file name inside `folder`) with `folder` as its working folder and no start-up files; no
// shell is involved. Throws PlotError, with what gnuplot said, if it is not installed or fails.
void run_gnuplot(const std::filesystem::path& folder, const std::string& script);

// A gnuplot string: single quotes, inside which gnuplot substitutes nothing; control characters become blanks.
std::string gnuplot_quoted(const std::string& text);

}  // namespace panvo::evaluation
