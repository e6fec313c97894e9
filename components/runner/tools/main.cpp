// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "container_process.hpp"
#include "describe.hpp"
#include "enclave.hpp"
#include "launch.hpp"
#include "panvo/runner/run_files.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/shm_leftovers.hpp"

namespace panvo::runner {
namespace {

/// Only the container selected on the command line.
runtime::SystemDescription part(const runtime::SystemDescription& system, const std::string& name) {
  runtime::SystemDescription part = system;
  std::erase_if(part.containers, [&](const auto& container) { return container.name != name; });
  if (!part.containers.empty()) return part;
  std::string known;
  for (const auto& container : system.containers) known += " " + container.name;
  throw runtime::ConfigError(system.file + ": has no container " + name + "; it has" + known);
}

ExitStatus run(const RunOptions& options) {
  runtime::SystemDescription system = describe_system(options);
  if (!options.container.empty()) system = part(system, options.container);
  if (options.describe) {
    describe(system);
    return ExitStatus::kOk;
  }
  const bool is_launched = options.link_in.has_value();
  const bool respawns = std::ranges::any_of(system.containers, &runtime::ContainerDescription::respawn);
  const bool is_split = !is_launched && !options.replay && system.containers.size() > 1;
  if (is_split && !options.awaited.empty())
    throw runtime::ConfigError("--await: waits for peers of one container; name it with --container");
  if (!options.out.empty() && !is_launched) claim_run_folder(options.out, options.overwrite);
  if (is_split || (!is_launched && !options.replay && (respawns || options.respawn))) return launch(options, system);
  runtime::ContainerDescription together = system.containers.front();  // replay runs in one process
  std::vector<runtime::ComponentDescription>& all = together.components;
  all.clear();
  std::vector<runtime::ComponentDescription> players;
  for (const auto& container : system.containers) {
    for (const auto& component : container.components) {
      (component.where.file.starts_with("--") ? players : all).push_back(component);
    }
  }
  all.insert(all.end(), players.begin(), players.end());
  use_enclave_of(options.system_file, together.name);
  return run_container(options, together, system.notes);
}

void tell_of(const runtime::ShmLeftovers& removed) {
  if (removed.segments == 0) return;
  std::fprintf(stderr, "panvo run: freed %.1f MB of shared memory left by killed processes\n",
               static_cast<double>(removed.bytes) * 1e-6);
}

}  // namespace
}  // namespace panvo::runner

int main(int argc, char** argv) {
  using namespace panvo;
  using namespace panvo::runner;
  // Components run in parallel already, one thread each; OpenCV's thread pool would compete with them for the cores.
  setenv("OPENCV_FOR_THREADS_NUM", "1", 0);
  RunOptions options;
  if (const auto status = RunOptions::parse(argc, argv, options)) return *status;
  try {
    if (!options.local && !options.replay && !options.link_in && !options.describe)
      tell_of(runtime::remove_shm_leftovers());
    return static_cast<int>(run(options));
  } catch (const runtime::ConfigError& error) {
    for (const auto& problem : error.problems()) std::fprintf(stderr, "panvo run: %s\n", problem.c_str());
    return static_cast<int>(ExitStatus::kBadConfiguration);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo run: %s\n", error.what());
    return static_cast<int>(ExitStatus::kRunFailed);
  }
}
