// SPDX-License-Identifier: Apache-2.0
#include "local_endpoints.hpp"

#include <utility>

namespace panvo::runtime::dds {

void LocalEndpoints::add(const std::string& wire_name, const Guid& guid, bool is_writer) {
  {
    const std::lock_guard lock(mutex_);
    endpoints_[guid] = {wire_name, is_writer};
  }
  changed();
}

void LocalEndpoints::remove(const Guid& guid) {
  {
    const std::lock_guard lock(mutex_);
    endpoints_.erase(guid);
  }
  changed();
}

std::vector<LocalEndpoints::Guid> LocalEndpoints::of(const std::string& wire_name, bool is_writer) const {
  const std::lock_guard lock(mutex_);
  std::vector<Guid> found;
  for (const auto& [guid, endpoint] : endpoints_) {
    if (endpoint.is_writer == is_writer && endpoint.wire_name == wire_name) found.push_back(guid);
  }
  return found;
}

void LocalEndpoints::on_change(std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(callback);
}

void LocalEndpoints::changed() {
  std::function<void()> callback;
  {
    const std::lock_guard lock(mutex_);
    callback = on_change_;
  }
  callback();
}

}  // namespace panvo::runtime::dds
