// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {

/// Summary of a bag in the layout of `ros2 bag info`.
std::string describe_as_text(const BagReader& bag);

/// The same content as JSON; times in ns.
std::string describe_as_json(const BagReader& bag);

}  // namespace panvo::recorder
