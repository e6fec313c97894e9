// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runtime {

/// Runs `components` in this process until the data end or a signal asks to stop. Throws ConfigError.
ExitStatus run_container(const RunOptions& options, const std::vector<ComponentDescription>& components);

}  // namespace panvo::runtime
