// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::aravis_camera::testing {

/// Moves this process and its future children into a network namespace that has only 127.0.0.1 and 127.0.0.2, isolated
/// from the host's cameras and from other tests. Needs no privileges if user namespaces are allowed. Call this before
/// threads are started. Returns an error, or an empty string on success.
std::string enter_own_network();

}  // namespace panvo::aravis_camera::testing
