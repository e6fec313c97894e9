// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runner {

/// Checks in the background whether other processes in the DDS domain have nodes of these names: two such runs would
/// read each other's images and poses.
class TakenNames {
 public:
  TakenNames(const runtime::DdsSettings& dds, std::vector<std::string> wanted);

  /// Waits for the result: two seconds at most, unless the process is held up. Throws ConfigError with the taken names.
  void refuse();

 private:
  std::unique_ptr<runtime::Bridge> bridge_;
  std::future<std::vector<std::string>> taken_;  // last: its thread uses `bridge_`
};

}  // namespace panvo::runner
