// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <mutex>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/interfaces/service_type.hpp"

namespace panvo::interfaces {
namespace {

struct Services {
  static Services& instance() {
    static Services services;  // static initialisers of libraries use it, in any order
    return services;
  }
  std::mutex mutex;
  std::map<std::string_view, std::string_view> hashes;  // by name; of libraries that are never unloaded
};

}  // namespace

ServiceTable::ServiceTable(std::span<const ServiceType> types) {
  auto& services = Services::instance();
  const std::lock_guard lock(services.mutex);
  for (const auto& type : types) services.hashes.emplace(type.name, type.hash);
}

std::string_view service_hash(std::string_view name) {
  find_message_type(std::string(name) + "_Request");
  auto& services = Services::instance();
  const std::lock_guard lock(services.mutex);
  const auto found = services.hashes.find(name);
  return found == services.hashes.end() ? std::string_view() : found->second;
}

}  // namespace panvo::interfaces
