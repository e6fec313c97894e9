// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "panvo/recorder/bag_reader.hpp"
#include "panvo/recorder/bag_writer.hpp"

namespace panvo::recorder::test {

inline BagTopic topic(const std::string& name, const std::string& type = "test_msgs/msg/Bytes") {
  BagTopic topic;
  topic.name = name;
  topic.type = type;
  topic.offered_qos_profiles = {QosProfile{}};
  topic.type_description_hash = "RIHS01_" + std::string(64, '0');
  return topic;
}

/// Pseudo-random bytes determined by the message number.
inline interfaces::Bytes payload(std::uint64_t message, std::size_t size) {
  interfaces::Bytes bytes(size);
  std::uint64_t state = message * 0x9E3779B97F4A7C15u + 1;
  for (auto& byte : bytes) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    byte = static_cast<std::uint8_t>(state >> 56);
  }
  return bytes;
}

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kStep = 10'000'000;

/// Writes `count` messages of `size` bytes to /data, message i at kStart + i kStep.
inline void write_numbered(BagWriter& writer, std::uint64_t count, std::size_t size) {
  const int data = writer.add_topic(topic("/data"));
  for (std::uint64_t i = 0; i < count; ++i) {
    writer.write(data, kStart + static_cast<std::int64_t>(i) * kStep, payload(i, size));
  }
}

struct Read {
  std::string topic;
  std::int64_t timestamp_ns;
  interfaces::Bytes data;
  bool operator==(const Read&) const = default;
};

inline std::vector<Read> read_all(BagReader& reader) {
  std::vector<Read> messages;
  while (const BagMessage* message = reader.next()) {
    messages.push_back({reader.metadata().topics[message->topic].name, message->timestamp_ns, message->data});
  }
  return messages;
}

/// Returns the first fault of messages written by write_numbered(): wrong content or time; "" if there is none.
inline std::string wrong_in_numbered(const std::vector<Read>& messages, std::size_t size) {
  for (const auto& message : messages) {
    const auto number = (message.timestamp_ns - kStart) / kStep;
    if (message.timestamp_ns != kStart + number * kStep ||
        message.data != payload(static_cast<std::uint64_t>(number), size)) {
      return "message " + std::to_string(number) + " is not what was written";
    }
  }
  return "";
}

/// As wrong_in_numbered(); also checks that no message before the last one is missing.
inline std::string wrong_in_first_numbered(const std::vector<Read>& messages, std::size_t size) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (messages[i].timestamp_ns != kStart + static_cast<std::int64_t>(i) * kStep) {
      return "message " + std::to_string(i) + " is missing";
    }
  }
  return wrong_in_numbered(messages, size);
}

/// Message of the BagError thrown by `action`; "" if it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const BagError& error) {
    return error.what();
  }
  return "";
}

inline bool any_contains(const std::vector<std::string>& lines, const std::string& text) {
  for (const auto& line : lines) {
    if (line.find(text) != std::string::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace panvo::recorder::test
