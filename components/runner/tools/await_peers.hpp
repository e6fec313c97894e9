// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "panvo/runtime/container.hpp"

namespace panvo::runner {

/// Waits until each topic that `container` publishes has a reader in another process, and each topic it reads has a
/// writer, or until `stop`. "TOPIC:COUNT" waits for several processes. For systems on several computers that are
/// started independently. Throws ConfigError for a topic that the container does not have.
void await_peers(runtime::Container& container, const std::vector<std::string>& topics, const std::atomic<bool>& stop,
                 const runtime::Logger::Write& log);

}  // namespace panvo::runner
