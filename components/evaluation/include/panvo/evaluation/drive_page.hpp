// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {

/// Where the page of the web view lies: share/panvo/web_view/page of the prefix of this program, or
/// components/web_view/page/dist of its build folder. Empty: it was not built.
std::filesystem::path live_page_folder();

/// The page of the web view as one HTML file that shows the drive: its map, time line, events, and pictures of the
/// recording along it. Needs no server. Throws InputError for files of the page or images that cannot be read.
std::string drive_page(const JourneyReport& report, const std::filesystem::path& page_folder);

}  // namespace panvo::evaluation
