// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "panvo/runtime/bridge.hpp"

namespace panvo::runtime {

/// Looks whether other processes on the DDS domain have nodes of these names, while this process is getting ready: two runs of the same names
/// read each other's images and poses.
class TakenNames {
 public:
  TakenNames(const DdsSettings& dds, std::vector<std::string> wanted);

  /// Waits until whoever is there has been heard, which takes no longer than `kLongestLook`. Throws ConfigError with the names that are taken.
  void refuse();

 private:
  std::unique_ptr<Bridge> bridge_;
  std::future<std::vector<std::string>> taken_;  // last: its thread uses the bridge
};

}  // namespace panvo::runtime
