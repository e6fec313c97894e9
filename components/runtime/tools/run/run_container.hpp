// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runtime {

/// Runs `container` in this process until the data end or a signal asks to stop; `notes` on the configuration are logged first. Throws ConfigError.
ExitStatus run_container(const RunOptions& options, const ContainerDescription& container,
                         const std::vector<std::string>& notes);

}  // namespace panvo::runtime
