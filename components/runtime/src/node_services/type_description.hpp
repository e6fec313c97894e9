// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/interfaces/message_type.hpp"
#include "type_description_interfaces/msg/TypeDescription.h"
#include "type_description_interfaces/msg/TypeSource.h"

namespace panvo::runtime::node_services {

/// A message type and all that it contains, in ROS 2's terms: what its type hash is computed of. Read from the
/// definition of the type.
type_description_interfaces::msg::TypeDescription describe_type(const interfaces::MessageType& type);

/// The definitions of the type and all that it contains, as .msg files.
std::vector<type_description_interfaces::msg::TypeSource> sources_of(const interfaces::MessageType& type);

}  // namespace panvo::runtime::node_services
