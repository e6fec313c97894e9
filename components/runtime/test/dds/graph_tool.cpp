// SPDX-License-Identifier: Apache-2.0
#include "graph_tool.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace panvo::runtime::test {

ToolResult run_graph_tool(int domain, const std::string& arguments) {
  const std::string command = std::string(PANVO_GRAPH_TOOL) + " --domain " + std::to_string(domain) + " " +
                              (arguments.starts_with("--") ? "" : "--timeout 30 ") + arguments + " 2>&1";
  ToolResult result;
  FILE* output = popen(command.c_str(), "r");
  std::array<char, 4096> chunk{};
  for (std::size_t size = 0; (size = fread(chunk.data(), 1, chunk.size(), output)) > 0;)
    result.said.append(chunk.data(), size);
  const int status = pclose(output);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

}  // namespace panvo::runtime::test
