// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>

#include "panvo/interfaces/library_folders.hpp"
#include "panvo/interfaces/message_codec.hpp"

namespace panvo::interfaces {
namespace fs = std::filesystem;

namespace {

/// Maximum number of packages to look for. Peers on the network choose the names, so the record of them must be
/// bounded.
constexpr std::size_t kMaxMissing = 1024;

/// All message types of this process. Types are added when a library is loaded and never removed.
class Registry {
 public:
  static Registry& instance() {
    static Registry registry;  // static initialisers of libraries use it, in any order
    return registry;
  }

  /// If two libraries define a type, keeps the first.
  void add(std::span<const MessageType* const> types) {
    const std::unique_lock lock(mutex_);
    for (const MessageType* type : types) {
      const auto place = std::ranges::lower_bound(types_, type->name, {}, name_of);
      if (place == types_.end() || (*place)->name != type->name) types_.insert(place, type);
    }
  }

  const MessageType* find(std::string_view name) const {
    const std::shared_lock lock(mutex_);
    const auto place = std::ranges::lower_bound(types_, name, {}, name_of);
    return place != types_.end() && (*place)->name == name ? *place : nullptr;
  }

  std::vector<const MessageType*> types() const {
    const std::shared_lock lock(mutex_);
    return types_;
  }

  /// Number of libraries that were rejected because their tables were compiled with different headers.
  std::size_t misfits() const { return misfits_; }
  void add_misfit() { ++misfits_; }

 private:
  static std::string_view name_of(const MessageType* type) { return type->name; }

  mutable std::shared_mutex mutex_;
  std::vector<const MessageType*> types_;
  std::atomic<std::size_t> misfits_{0};
};

/// "my_msgs" for "my_msgs/msg/Thing"; empty for a name that is not a type name. Package names are restricted to lower
/// case, digits and '_', so that they cannot contain a path.
std::string_view package_of(std::string_view name) {
  const std::string_view package = name.substr(0, name.find('/'));
  const auto rest = name.substr(package.size());
  const bool is_type = rest.starts_with("/msg/") || rest.starts_with("/srv/");
  const auto is_allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return is_type && std::ranges::all_of(package, is_allowed) ? package : std::string_view();
}

/// Loads message libraries by package name, each once.
class Loader {
 public:
  static Loader& instance() {
    static Loader loader;
    return loader;
  }

  /// Returns whether types may have been added.
  bool load(const std::string& package) {
    const std::lock_guard lock(mutex_);
    if (problems_.contains(package) || problems_.size() >= kMaxMissing) return false;
    std::string& problem = problems_[package];
    for (const auto& folder : message_folders()) {
      const fs::path file = folder / message_library_name(package);
      std::error_code error;
      if (!fs::is_regular_file(file, error)) continue;
      const auto misfits = Registry::instance().misfits();
      // RTLD_NOW: missing symbols show here, not later in the run. RTLD_NODELETE: references to its types stay valid.
      if (!dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
        problem = dlerror();
      } else if (Registry::instance().misfits() != misfits) {
        problem = file.string() + " was built with different headers of panvo_interfaces; rebuild it";
      }
      return problem.empty();
    }
    return false;
  }

  /// Why the library of a package could not be loaded; empty if it was loaded or does not exist.
  std::string problem_of(const std::string& package) {
    const std::lock_guard lock(mutex_);
    const auto found = problems_.find(package);
    return found == problems_.end() ? std::string() : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> problems_;  ///< by package, for every package looked for
};

}  // namespace

MessageTable::MessageTable(std::span<const MessageType* const> types, std::size_t type_size, std::size_t field_size) {
  if (type_size == sizeof(MessageType) && field_size == sizeof(CdrField)) {
    Registry::instance().add(types);
  } else {
    Registry::instance().add_misfit();
  }
}

const MessageType* find_message_type(std::string_view name) {
  const MessageType* found = Registry::instance().find(name);
  if (found) return found;
  const std::string package(package_of(name));
  return !package.empty() && Loader::instance().load(package) ? Registry::instance().find(name) : nullptr;
}

std::string why_unknown(std::string_view name) {
  const std::string package(package_of(name));
  if (package.empty()) return "is not a type name; write it as package/msg/Type, the package in lower case";
  const std::string problem = Loader::instance().problem_of(package);
  if (!problem.empty()) return "cannot be loaded: " + problem;
  const auto types = message_types();
  const bool is_package_known =
      std::ranges::any_of(types, [&package](const MessageType* type) { return package_of(type->name) == package; });
  return (is_package_known ? "is unknown: the package " + package + " does not define it"
                           : "is unknown: cannot find " + message_library_name(package)) +
         "; build the package with panvo_generate_interfaces() and source its workspace, or add its folder to "
         "PANVO_PLUGIN_PATH";
}

std::vector<const MessageType*> message_types() { return Registry::instance().types(); }

}  // namespace panvo::interfaces
