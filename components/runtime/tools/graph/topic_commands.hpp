// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "session.hpp"

namespace panvo::runtime::graph {

/// Options of a command that reads a topic.
struct TopicReading {
  std::string topic, type_name;  // empty type: the publisher's
  std::size_t count = 0;         // number of messages or reports; 0: until Ctrl-C
  std::size_t window = 1000;     // number of messages that a report covers
  bool whole = false;            // do not shorten
};

void echo(const SessionOptions& options, const TopicReading& reading);
void hz(const SessionOptions& options, const TopicReading& reading);
void bw(const SessionOptions& options, const TopicReading& reading);

}  // namespace panvo::runtime::graph
