// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::aravis_camera::testing {

/// Takes this process, and what it starts from now on, into a network of its own that has 127.0.0.1 and 127.0.0.2 and nothing else: no camera of
/// the host's is heard, and tests do not hear each other. Needs no rights where user namespaces are allowed. To be called before there are
/// threads. Returns why it cannot be, empty: it is.
std::string enter_own_network();

}  // namespace panvo::aravis_camera::testing
