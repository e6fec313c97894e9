// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "session.hpp"

namespace panvo::runtime::graph {

/// Each function adds its commands to the command line; they run during parsing, when `options` is complete.
void add_node_commands(CLI::App& app, const SessionOptions& options);
void add_param_commands(CLI::App& app, const SessionOptions& options);
void add_topic_commands(CLI::App& app, const SessionOptions& options);
void add_service_commands(CLI::App& app, const SessionOptions& options);
void add_component_commands(CLI::App& app, const SessionOptions& options);

}  // namespace panvo::runtime::graph
