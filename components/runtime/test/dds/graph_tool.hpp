// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::runtime::test {

struct ToolResult {
  int status = -1;
  std::string said;  ///< standard output and error
};

/// Runs `panvo node`, `topic`, ... with these arguments, through a shell.
ToolResult run_graph_tool(int domain, const std::string& arguments);

}  // namespace panvo::runtime::test
