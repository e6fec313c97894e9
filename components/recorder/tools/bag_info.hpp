// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {

/// What `ros2 bag info` tells of a bag, in its layout.
std::string describe_as_text(const BagReader& bag);

/// The same for scripts; times in ns.
std::string describe_as_json(const BagReader& bag);

}  // namespace panvo::recorder
