// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runner {

/// Runs each container of `system` in its own process: this executable with `--container NAME`. They start together
/// once their topics are connected. When all sources have ended or a required container has failed, the others are
/// asked to stop. Result files are merged.
ExitStatus launch(const RunOptions& options, const runtime::SystemDescription& system);

}  // namespace panvo::runner
