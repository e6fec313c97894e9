// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "session.hpp"

namespace panvo::runtime::graph {

/// What a command that reads a topic was asked.
struct TopicReading {
  std::string topic, type_name;  // type empty: as it is written
  std::size_t count = 0;         // of messages, or reports; 0: until Ctrl-C
  std::size_t window = 1000;     // messages a report looks back on
  bool whole = false;            // nothing is cut
};

void echo(const SessionOptions& options, const TopicReading& reading);
void hz(const SessionOptions& options, const TopicReading& reading);
void bw(const SessionOptions& options, const TopicReading& reading);

}  // namespace panvo::runtime::graph
