// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/evaluation/journey_evaluation.hpp"

/// The sections of the report, each with its heading; empty if the run has no data for it.
namespace panvo::evaluation {

std::string page_style();
/// "; 2 recognised at places that the recording does not list"; empty if there are none.
std::string elsewhere_words(const RevisitScore& score);
std::string page_headline(const JourneyReport& report);
std::string paths_section(const JourneyReport& report);
std::string error_section(const JourneyReport& report);
std::string tables_section(const JourneyReport& report);
std::string revisits_section(const JourneyReport& report);
std::string azimuth_section(const JourneyReport& report);
std::string states_section(const JourneyReport& report);
std::string times_section(const JourneyReport& report);
std::string facts_section(const JourneyReport& report);

}  // namespace panvo::evaluation
