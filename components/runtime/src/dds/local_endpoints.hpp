// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

/// Readers and writers of this process by topic, for announcing which node owns which. Thread-safe.
class LocalEndpoints {
 public:
  using Guid = rtps::GUID_t;

  void add(const std::string& wire_name, const Guid& guid, bool is_writer);
  void remove(const Guid& guid);

  std::vector<Guid> of(const std::string& wire_name, bool is_writer) const;

  /// Called after each change, on the thread that made it.
  void on_change(std::function<void()> callback);

 private:
  struct Endpoint {
    std::string wire_name;
    bool is_writer = false;
  };

  void changed();

  mutable std::mutex mutex_;
  std::map<Guid, Endpoint> endpoints_;
  std::function<void()> on_change_ = [] {};
};

}  // namespace panvo::runtime::dds
