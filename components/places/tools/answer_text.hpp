// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "panvo/places/place_finder.hpp"

namespace panvo::places {

/// What was found for one image of a folder.
struct ImageAnswer {
  std::string image;
  std::optional<std::string> fault;  ///< why the image was skipped; then there is no answer
  PlaceAnswer answer;
};

/// One line for people: "0007.jpg  place 0012.jpg, heading +31.2 +- 0.3 deg, ...".
std::string line_of(const ImageAnswer& answer, const std::vector<KnownPlace>& places);

/// Names of the columns of csv_line().
std::string csv_header();
std::string csv_line(const ImageAnswer& answer, const std::vector<KnownPlace>& places);

nlohmann::json json_of(const ImageAnswer& answer, const std::vector<KnownPlace>& places);

}  // namespace panvo::places
