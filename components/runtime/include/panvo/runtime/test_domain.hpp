// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::runtime {

/// A DDS domain for a test that speaks over DDS: one that no other process on this host has claimed, so that tests may run side by side. Held
/// until this process ends, the same at every call; $PANVO_TEST_DOMAIN, where it is set, is taken as it is. Throws std::runtime_error when every
/// domain is claimed.
int test_domain();

}  // namespace panvo::runtime
