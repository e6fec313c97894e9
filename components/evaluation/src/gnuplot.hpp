// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace panvo::evaluation {

// Runs gnuplot on `script` (a file name inside `folder`) with `folder` as its working folder and no start-up files; no
// shell is involved. Throws PlotError, with what gnuplot said, if it is not installed or fails.
void run_gnuplot(const std::filesystem::path& folder, const std::string& script);

// Writes `text` as `script` into `folder` first. Throws PlotError also if that fails.
void write_and_run_gnuplot(const std::filesystem::path& folder, const std::string& script, const std::string& text);

// A gnuplot string: between single quotes, where gnuplot substitutes nothing. A quote inside becomes an apostrophe
// (UTF-8), a control character a blank.
std::string gnuplot_quoted(const std::string& text);

}  // namespace panvo::evaluation
