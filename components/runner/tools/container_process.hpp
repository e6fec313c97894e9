// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runner {

/// Runs `container` in this process until the end of the data or a stop signal; first logs `notes` on the
/// configuration. Throws ConfigError.
ExitStatus run_container(const RunOptions& options, const runtime::ContainerDescription& container,
                         const std::vector<std::string>& notes);

}  // namespace panvo::runner
