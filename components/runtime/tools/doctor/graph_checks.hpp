// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "finding.hpp"
#include "panvo/runtime/graph.hpp"

namespace panvo::runtime::doctor {

/// What other processes of the domain do wrong together: nodes of one name, topics whose types or quality of service do
/// not fit, several sources of time, distributions that do not understand each other. One finding if all is well.
Findings check_graph(const Graph& graph);

}  // namespace panvo::runtime::doctor
