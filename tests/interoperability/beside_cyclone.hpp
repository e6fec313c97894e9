// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/test_domain.hpp"

namespace panvo::test {

/// Panvo's bridge in this process, for a peer with Cyclone DDS in another, both on the loopback interface only.
class BesideCyclone : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string_view(CYCLONE_PEER).empty()) GTEST_SKIP() << "built without Cyclone DDS (package cyclonedds-dev)";
    setenv("CYCLONEDDS_URI", ("file://" + std::string(CONFIG) + "/dds/cyclone_localhost.xml").c_str(), 1);
    bridge_ = runtime::make_dds_bridge(
        {.domain = domain_, .profiles = CONFIG "/dds/localhost.xml", .name = "panvo_interoperability"});
  }

  // Before the members of derived fixtures, which its threads call.
  void TearDown() override { bridge_.reset(); }

  const int domain_ = runtime::test_domain();
  std::unique_ptr<runtime::Bridge> bridge_;
};

}  // namespace panvo::test
