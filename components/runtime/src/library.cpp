// SPDX-License-Identifier: Apache-2.0
#include "library.hpp"

#include <dlfcn.h>

#include "panvo/interfaces/library_folders.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::runtime {
namespace fs = std::filesystem;

namespace {

using EntryPoint = const ComponentDescriptor* (*)();

/// The plugin's own entry point. dlsym also finds those of linked libraries.
EntryPoint entry_point_of(void* handle, const fs::path& file) {
  void* symbol = dlsym(handle, kPluginEntryPoint);
  Dl_info info{};
  std::error_code error;
  if (!symbol || dladdr(symbol, &info) == 0 || !fs::equivalent(info.dli_fname, file, error)) return nullptr;
  return reinterpret_cast<EntryPoint>(symbol);
}

}  // namespace

Library::Library(const fs::path& file) : file_(file) {
  // RTLD_LOCAL: plugins may define the same symbols. RTLD_NOW: missing symbols are reported at load time.
  handle_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw ConfigError("cannot load plugin " + file.string() + ": " + dlerror());
  const EntryPoint entry_point = entry_point_of(handle_, file);
  first_ = entry_point ? entry_point() : nullptr;
  std::string problem;
  if (!entry_point) {
    problem = "is not a component plugin: it has no function " + std::string(kPluginEntryPoint) +
              "; register a component with PANVO_REGISTER_COMPONENT(Class)";
  } else if (!first_) {
    problem = "registers no component: add PANVO_REGISTER_COMPONENT(Class) to its source file";
  } else if (first_->runtime_build != kRuntimeBuild) {
    problem = "was built for panvo_runtime " + std::string(first_->runtime_build) + ", this is " +
              std::string(kRuntimeBuild) + ": build the plugin again";
  }
  if (!problem.empty()) {
    dlclose(handle_);
    throw ConfigError(file.string() + " " + problem);
  }
}

Library::~Library() { dlclose(handle_); }

const ComponentDescriptor* Library::find(const std::string& class_name) const {
  const auto colons = class_name.rfind("::");
  const std::string unqualified = colons == std::string::npos ? class_name : class_name.substr(colons + 2);
  for (const ComponentDescriptor* descriptor = first_; descriptor; descriptor = descriptor->next) {
    if (descriptor->class_name == unqualified) return descriptor;
  }
  return nullptr;
}

std::vector<const ComponentDescriptor*> Library::components() const {
  std::vector<const ComponentDescriptor*> components;
  for (const ComponentDescriptor* descriptor = first_; descriptor; descriptor = descriptor->next)
    components.push_back(descriptor);
  return components;
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders = interfaces::folders_in("PANVO_PLUGIN_PATH");
  for (const auto& folder : interfaces::library_folders()) folders.push_back(folder / "panvo");
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(executable.parent_path() / ".." / "panvo_plugins");  // build folder
  return folders;
}

fs::path find_plugin(const std::string& package) {
  if (const auto wrong = package_name_problem(package)) throw ConfigError("\"" + package + "\" " + *wrong);
  const std::string file_name = "lib" + package + "_component.so";
  std::string looked_in;
  for (const auto& folder : plugin_folders()) {
    const fs::path file = folder / file_name;
    std::error_code error;
    if (fs::is_regular_file(file, error)) return fs::weakly_canonical(file, error);
    looked_in += (looked_in.empty() ? "" : ", ") + folder.lexically_normal().string();
  }
  throw ConfigError("package " + package + " has no plugin: " + file_name + " is not in " + looked_in +
                    "; build the package, or add its folder to PANVO_PLUGIN_PATH");
}

}  // namespace panvo::runtime
