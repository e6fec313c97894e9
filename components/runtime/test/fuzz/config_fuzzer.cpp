// SPDX-License-Identifier: Apache-2.0
// For libFuzzer: the first byte selects the kind of the remaining input: a system file, a ROS 2 parameter file, a
// message or value in YAML, or a command-line setting. It must be read or refused with a ConfigError.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "config/message_from_yaml.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/system_file.hpp"

namespace {

using namespace panvo::runtime;
namespace fs = std::filesystem;

struct Parameters {
  std::int64_t count = 1;
  double gain = 1.0;
  bool on = false;
  std::string text;
  std::vector<double> weights;
  std::vector<std::string> names;

  template <class Field>
  static void describe(Field&& field) {
    field(&Parameters::count, "count", "1", "a whole number", 0, 9);
    field(&Parameters::gain, "gain", "1", "a number", 0.0, 1.0);
    field(&Parameters::on, "on", "", "a flag");
    field(&Parameters::text, "text", "", "a text", {"a", "b"});
    field(&Parameters::weights, "weights", "", "numbers");
    field(&Parameters::names, "names", "", "texts");
  }
};

fs::path file(const std::string& name) {
  const fs::path path = "/dev/shm/panvo_config_fuzzer_" + std::to_string(::getpid()) + "_" + name;
  static const int removed_at_exit = std::atexit([] {
    for (const char* each : {"system.yaml", "parameters.yaml"}) fs::remove(file(each));
  });
  static_cast<void>(removed_at_exit);
  return path;
}

/// Reads the parameters like a component.
void construct(const SystemDescription& system) {
  for (const auto& container : system.containers) {
    for (const auto& component : container.components) {
      ParameterReader reader(component.name, component.parameters);
      reader.read<Parameters>();
      reader.problems();
    }
  }
}

SystemDescription system_with(const std::string& component_lines) {
  std::ofstream(file("system.yaml"), std::ios::binary)
      << "launch:\n- node_container:\n    name: x\n    composable_node:\n"
         "    - pkg: panvo_a\n      plugin: A\n      name: a\n"
      << component_lines;
  return read_system_file(file("system.yaml"));
}

void read(std::uint8_t kind, const std::string& text) {
  const auto types = panvo::interfaces::message_types();
  switch (kind % 5) {
    case 0:
      std::ofstream(file("system.yaml"), std::ios::binary) << text;
      return construct(read_system_file(file("system.yaml"), {{"rig", text.substr(0, 8)}}));
    case 1:
      std::ofstream(file("parameters.yaml"), std::ios::binary) << text;
      return construct(system_with("      param: [{from: " + file("parameters.yaml").string() + "}]\n"));
    case 2:
      message_from_yaml(*types[text.size() % types.size()], text);
      return;
    case 3:
      parameter_value_from_yaml(text);
      return;
    default:
      auto system = system_with("");
      apply_setting(system, text);
      construct(system);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  try {
    read(data[0], std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  } catch (const ConfigError&) {
  }
  return 0;
}
