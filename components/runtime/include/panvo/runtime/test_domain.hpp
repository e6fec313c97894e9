// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::runtime {

/// Returns a DDS domain that no other test process on this host uses, so tests can run in parallel. The domain is held
/// until this process ends; each call returns the same one. $PANVO_TEST_DOMAIN overrides it. Throws std::runtime_error
/// if all domains are in use.
int test_domain();

}  // namespace panvo::runtime
