// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "../graph/session.hpp"

namespace panvo::runtime::doctor {

/// Adds the command `doctor`. It throws graph::Failure if there are problems, after it has printed them.
void add_doctor_command(CLI::App& app, const graph::SessionOptions& options);

}  // namespace panvo::runtime::doctor
