// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>
#include <vector>

#include "library.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

/// Packages with a plugin in the search path.
std::set<std::string> packages() {
  std::set<std::string> packages;
  for (const auto& folder : plugin_folders()) {
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
      const std::string name = file.path().filename().string();
      constexpr std::string_view kEnd = "_component.so";
      if (name.starts_with("lib") && name.ends_with(kEnd))
        packages.insert(name.substr(3, name.size() - 3 - kEnd.size()));
    }
  }
  return packages;
}

/// Lists all loadable components, then throws if some plugins cannot be loaded (as during a build).
void list() {
  std::vector<std::string> problems;
  for (const auto& package : packages()) {
    try {
      const Library library(find_plugin(package));  // outlives its descriptors
      for (const auto* component : library.components()) std::cout << package << " " << component->class_name << "\n";
    } catch (const ConfigError& error) {
      problems.emplace_back(error.what());
    }
  }
  std::cout << std::flush;
  if (!problems.empty()) throw ConfigError(std::move(problems));
}

/// An empty working folder, removed at the end: a component may write files when it is created, such as a recorder.
class EmptyWorkingFolder {
 public:
  EmptyWorkingFolder() {
    std::string made = (std::filesystem::temp_directory_path() / "panvo_component.XXXXXX").string();
    if (!mkdtemp(made.data())) throw ConfigError(made + ": cannot be made; set TMPDIR to a folder with room");
    folder_ = made;
    std::filesystem::current_path(folder_);
  }
  ~EmptyWorkingFolder() {
    std::error_code error;
    std::filesystem::current_path(before_, error);
    std::filesystem::remove_all(folder_, error);
  }
  EmptyWorkingFolder(const EmptyWorkingFolder&) = delete;
  EmptyWorkingFolder& operator=(const EmptyWorkingFolder&) = delete;

 private:
  const std::filesystem::path before_ = std::filesystem::current_path();
  std::filesystem::path folder_;
};

void show(const std::string& package) {
  const Library library(find_plugin(package));
  const EmptyWorkingFolder working_folder;
  for (const auto* component : library.components()) {
    std::vector<ParameterDescription> parameters;
    Container container({.replay = true, .log = [](LogLevel, const std::string&, const std::string&) {}});
    ComponentDescription description;
    description.package = package;
    description.plugin = std::string(component->class_name);
    description.name = package.starts_with("panvo_") ? package.substr(6) : package;
    description.name_space = "/";
    try {  // parameters are known even if the constructor then fails for lack of a file or device
      container.add(description, [&](Context& context) -> std::unique_ptr<Component> {
        std::unique_ptr<Component, void (*)(Component*)> made(nullptr, component->destroy);
        try {
          made.reset(component->create(context));
        } catch (const std::exception&) {
        }
        parameters = context.declared_parameters();
        return std::make_unique<Component>();
      });
    } catch (const ConfigError&) {
    }
    std::cout << component->class_name << " (" << package << ")\n";
    for (const auto& parameter : parameters) {
      std::cout << "  " << parameter.name << " = " << parameter.default_value;
      if (!parameter.unit.empty()) std::cout << " [" << parameter.unit << "]";
      if (parameter.min && parameter.max) std::cout << "  " << *parameter.min << " .. " << *parameter.max;
      for (std::size_t i = 0; i < parameter.choices.size(); ++i)
        std::cout << (i == 0 ? "  " : " | ") << parameter.choices[i];
      std::cout << "\n      " << parameter.type << ": " << parameter.description << "\n";
    }
  }
}

}  // namespace
}  // namespace panvo::runtime

int main(int argc, char** argv) {
  using namespace panvo::runtime;
  CLI::App app("Lists components and describes their parameters.", "panvo component");
  app.require_subcommand(1);
  app.add_subcommand("list", "list the available components: package and plugin")->callback(list);
  auto* show_command =
      app.add_subcommand("show", "show the parameters of a package's components, with units, defaults and ranges");
  std::string package;
  show_command->add_option("PACKAGE", package, "such as panvo_binocular_odometry")->required();
  show_command->callback([&] { show(package); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo component: %s\n", error.what());
    return 1;
  }
  return 0;
}
