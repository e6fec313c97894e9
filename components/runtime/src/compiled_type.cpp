// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/compiled_type.hpp"

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {

void require_definition(const interfaces::MessageType& type, std::string_view compiled_hash) {
  if (type.hash == compiled_hash) return;
  throw ConfigError("the plugin was compiled with another definition of " + std::string(type.name) + " (" +
                    std::string(compiled_hash) + ") than its library holds (" + std::string(type.hash) +
                    "): build the plugin again");
}

}  // namespace panvo::runtime
