// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <mutex>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/interfaces/service_type.hpp"

namespace panvo::interfaces {
namespace {

struct Registry {
  static Registry& instance() {
    static Registry registry;  // static initialisers of libraries use it, in any order
    return registry;
  }
  std::mutex mutex;
  std::map<std::string_view, std::string_view> hashes;  // by name; of libraries that are never unloaded
};

}  // namespace

ServiceTable::ServiceTable(std::span<const ServiceType> types) {
  auto& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  for (const auto& type : types) registry.hashes.emplace(type.name, type.hash);
}

std::string_view service_hash(std::string_view name) {
  find_message_type(std::string(name) + "_Request");
  auto& registry = Registry::instance();
  const std::lock_guard lock(registry.mutex);
  const auto found = registry.hashes.find(name);
  return found == registry.hashes.end() ? std::string_view() : found->second;
}

}  // namespace panvo::interfaces
