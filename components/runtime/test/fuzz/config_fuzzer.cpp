// SPDX-License-Identifier: Apache-2.0
// For libFuzzer: the first byte selects the kind of the remaining input: a system file, a ROS 2 parameter file, a
// message or value in YAML, or a command-line setting. It must be read or refused with a ConfigError.
#include <filesystem>
#include <string>

#include "config/message_from_yaml.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/system_file.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace {

using namespace panvo::runtime;

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

/// In shared memory, to avoid disk writes.
std::filesystem::path write(const std::string& name, const std::string& text) {
  static const panvo::test::TemporaryFolder folder("/dev/shm");
  return folder.write(name, text);
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
  return read_system_file(write("system.yaml",
                                "launch:\n- node_container:\n    name: x\n    composable_node:\n"
                                "    - pkg: panvo_a\n      plugin: A\n      name: a\n" +
                                    component_lines));
}

void read(std::uint8_t kind, const std::string& text) {
  const auto types = panvo::interfaces::message_types();
  switch (kind % 5) {
    case 0:
      return construct(read_system_file(write("system.yaml", text), {{"rig", text.substr(0, 8)}}));
    case 1:
      return construct(system_with("      param: [{from: " + write("parameters.yaml", text).string() + "}]\n"));
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
