// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.hpp"

namespace panvo::runtime {

/// Runs each container of `system` in a process of its own: this executable with `--container NAME`. They start together once their topics are
/// connected; when those that play something have ended, the others are asked to stop; when one fails, all are. Result files are merged.
ExitStatus launch(const RunOptions& options, const SystemDescription& system);

}  // namespace panvo::runtime
