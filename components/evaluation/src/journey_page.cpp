// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_page.hpp"

namespace panvo::evaluation {

std::string journey_page(const JourneyReport& report) { return "<!doctype html><title>" + report.title + "</title>"; }

}  // namespace panvo::evaluation
