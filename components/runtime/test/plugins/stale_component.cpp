// SPDX-License-Identifier: Apache-2.0
// A plugin compiled with other headers.
#include <cstdlib>

#include "panvo/runtime/component.hpp"

namespace {

using panvo::runtime::Component;
using panvo::runtime::Context;

panvo::runtime::ComponentDescriptor stale{PANVO_RUNTIME_VERSION " (headers 000000000000, messages 000000000000)",
                                          "RelayComponent", [](Context&) -> Component* { std::abort(); },
                                          [](Component*) { std::abort(); }, nullptr};
const panvo::runtime::detail::Registrar registrar{stale};

}  // namespace
