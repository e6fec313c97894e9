// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "inbox.hpp"
#include "peer_process.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {

inline constexpr const char* kImageType = "sensor_msgs/msg/Image";
inline constexpr const char* kStringType = "std_msgs/msg/String";

/// A bridge in this process and one in another.
class BetweenProcesses : public ::testing::Test {
 protected:
  explicit BetweenProcesses(std::uint32_t shared_bytes = 0) : shared_image_bytes(shared_bytes) {
    bridge->on_warning(warnings.callback());
  }

  bool is_warned_of(const std::string& first, const std::string& second) {
    return warnings.wait_for([&](const std::string& text) {
      return text.find(first) != std::string::npos && text.find(second) != std::string::npos;
    });
  }

  const int domain = test_domain();
  const std::uint32_t shared_image_bytes;  // of both processes
  PeerProcess peer{domain, PANVO_BRIDGE_PEER, shared_image_bytes};
  Inbox<std::string> warnings;
  Inbox<SamplePtr> inbox;  // before the bridge: filled by its readers
  std::unique_ptr<Bridge> bridge = make_dds_bridge(
      {.domain = domain, .profiles = "", .name = "panvo_test", .shared_image_bytes = shared_image_bytes});
};

}  // namespace panvo::runtime::test
