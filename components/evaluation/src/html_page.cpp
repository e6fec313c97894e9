// SPDX-License-Identifier: Apache-2.0
#include "html_sections.hpp"
#include "html_text.hpp"
#include "panvo/evaluation/journey_page.hpp"

namespace panvo::evaluation {

std::string journey_page(const JourneyReport& report) {
  std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<title>" + html(report.title) + "</title>\n<style>\n" + page_style() + "</style>\n</head>\n<body>\n<main>\n";
  page += page_headline(report);
  page += paths_section(report);
  page += error_section(report);
  page += tables_section(report);
  page += revisits_section(report);
  page += azimuth_section(report);
  page += states_section(report);
  page += times_section(report);
  page += facts_section(report);
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace panvo::evaluation
