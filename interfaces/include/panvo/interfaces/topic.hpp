// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "panvo/interfaces/qos.hpp"

namespace panvo::interfaces {

/// A topic: name, message type and quality of service together. The name is relative; a system file may remap it.
template <class MessageT>
struct Topic {
  using Message = MessageT;
  std::string_view name;
  Qos qos = qos::kDefault;
};

}  // namespace panvo::interfaces
