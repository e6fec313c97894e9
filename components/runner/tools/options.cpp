// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <utility>

#include "panvo/runtime/errors.hpp"

namespace panvo::runner {
namespace {

/// Sets ROS 2's environment variables, which child processes inherit.
void use_keystore(const std::string& keystore, const std::string& enclave) {
  setenv("ROS_SECURITY_KEYSTORE", std::filesystem::absolute(keystore).c_str(), 1);
  setenv("ROS_SECURITY_ENABLE", "true", 1);
  setenv("ROS_SECURITY_STRATEGY", "Enforce", 1);
  if (!enclave.empty()) setenv("ROS_SECURITY_ENCLAVE_OVERRIDE", enclave.c_str(), 1);
}

/// Adds a component that publishes the calibration, beside the stereo rectifier and with its topic names. Throws
/// ConfigError if there is no rectifier.
void add_calibration(const RunOptions& options, runtime::SystemDescription& system) {
  runtime::ComponentDescription calibration;
  calibration.package = "panvo_stereo_rectifier";
  calibration.plugin = "StereoCalibrationComponent";
  calibration.name = "stereo_calibration";
  calibration.where = {"--calibration", 0};
  const auto folder = std::filesystem::absolute(options.calibration).string();
  calibration.parameters["folder"] = {{folder}, false, calibration.where};
  for (auto& container : system.containers) {
    auto& components = container.components;
    const auto rectifier = std::find_if(components.begin(), components.end(), [](const auto& component) {
      return component.plugin == "StereoRectifierComponent";
    });
    if (rectifier == components.end()) continue;
    calibration.name_space = rectifier->name_space;
    calibration.remaps = rectifier->remaps;
    components.insert(rectifier, std::move(calibration));
    return;
  }
  throw runtime::ConfigError("--calibration: " + options.system_file +
                             " has no StereoRectifierComponent that needs it");
}

/// Adds the web view to the first container, which has the cameras' images: they are then not sent between processes.
void add_view(runtime::SystemDescription& system) {
  const auto is_view = [](const auto& component) { return component.plugin == "WebViewComponent"; };
  for (const auto& container : system.containers) {
    if (std::ranges::any_of(container.components, is_view)) return;  // the system has one
  }
  runtime::ComponentDescription view;
  view.package = "panvo_web_view";
  view.plugin = "WebViewComponent";
  view.name = "web_view";
  view.where = {"--view", 0};
  system.containers.front().components.push_back(std::move(view));
}

}  // namespace

std::optional<int> RunOptions::parse(int argc, char** argv, RunOptions& options) {
  try {
    options.dds = runtime::dds_settings_from_environment();
  } catch (const runtime::ConfigError& error) {
    std::cerr << "panvo run: " << error.what() << "\n";
    return static_cast<int>(ExitStatus::kBadConfiguration);
  }
  CLI::App app("Runs a system of components live, or on a data set or bag.", "panvo run");
  std::vector<std::string> arguments;
  app.add_option("SYSTEM", options.system_file,
                 "system file (ROS 2 launch YAML: node_container, composable_node, param, remap)")
      ->required();
  app.add_option("ARGUMENT", arguments, "name:=value, an argument that the system file declares");
  auto* dataset =
      app.add_option("--dataset", options.dataset,
                     "play this data set: EuRoC/ASL, KITTI odometry, or left/right folders with a calibration");
  app.add_option("--bag", options.bag, "play this bag: a rosbag2 folder, or one .db3 or .mcap file")->excludes(dataset);
  app.add_option("--calibration", options.calibration,
                 "folder with left.yaml and right.yaml: the calibration of stereo images without camera_info")
      ->check(CLI::ExistingDirectory)
      ->excludes(dataset);
  app.add_flag("--view", options.view,
               "also show all topics in a browser, http://127.0.0.1:8765, and in Foxglove; --set web_view.port=PORT "
               "and other parameters of WebViewComponent");
  app.add_option("--out", options.out, "write trajectories, timing.json, summary.json and run.log to this folder");
  app.add_flag("--overwrite", options.overwrite, "let --out replace files that are not from a run");
  auto* replay = app.add_flag("--replay", options.replay,
                              "deterministic: one thread, messages in stamp order, as fast as possible");
  app.add_option("--rate", options.rate, "live: 1 as recorded, 2 twice as fast, 0 as fast as the components allow")
      ->excludes(replay)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--set", options.settings, "component.parameter=value; may be repeated")->expected(1)->take_all();
  app.add_option("-p,--param", options.ros_parameters,
                 "[NODE:]NAME:=VALUE, as in ROS 2: a parameter of one node or of all; may be repeated")
      ->expected(1)
      ->take_all();
  app.add_option("-r,--remap", options.ros_remaps,
                 "[NODE:]FROM:=TO, as in ROS 2: a topic; __node:=NAME: name of the container; __ns:=/NS: namespace of "
                 "all nodes; may be repeated")
      ->expected(1)
      ->take_all();
  app.add_flag("--ros-args")->group("");  // in front of -p and -r, as ROS 2 needs it
  app.add_option(
         "--seed", options.seed,
         "seed that components get from Context::seed(); the components of panvo have seed parameters of their own")
      ->capture_default_str();
  app.add_option("--domain", options.dds.domain, "DDS domain; overrides ROS_DOMAIN_ID")
      ->check(CLI::Range(0, runtime::DdsSettings::kMaxDomain))
      ->capture_default_str();
  app.add_option("--ros-distro", options.dds.ros_distro,
                 "ROS 2 distribution of other nodes; overrides ROS_DISTRO: humble, or jazzy for all later ones")
      ->capture_default_str();
  app.add_option("--dds-profiles", options.dds.profiles, "Fast DDS XML profile file, see config/dds")
      ->check(CLI::ExistingFile);
  app.add_flag("--local", options.local, "stay within this process: no DDS");
  app.add_flag("--verbose", options.verbose, "also show debug messages");
  app.add_option("--container", options.container, "run only this container of the system");
  auto* respawn = app.add_flag("--respawn", options.respawn,
                               "restart containers that crash or fail; those with respawn: true are always restarted")
                      ->excludes(replay);
  app.add_option("--respawn-delay", options.respawn_delay_s,
                 "delay before a restart, s, unless the system file sets it")
      ->needs(respawn)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  std::string keystore, enclave;
  auto* secure =
      app.add_option("--secure", keystore, "communicate only with holders of keys of this keystore (see panvo secure)")
          ->check(CLI::ExistingDirectory);
  app.add_option("--enclave", enclave,
                 "enclave in the keystore to use; default: each container's own (panvo secure --system), or /panvo")
      ->needs(secure);
  app.add_option("--await", options.awaited,
                 "TOPIC or TOPIC:COUNT: wait until COUNT other processes (default 1) are connected to this topic; may "
                 "be repeated. For systems on several computers")
      ->expected(1)
      ->take_all()
      ->excludes(replay);
  app.add_flag("--describe", options.describe, "print the topics and nodes of each container and exit")
      ->excludes(replay);
  app.add_option("--link-in", options.link_in)->group("");
  app.add_option("--link-out", options.link_out)->group("");
  app.add_flag("--again", options.again)->group("");
  app.add_option("--run-id", options.run_id)->group("");
  app.footer(
      "ROS_DOMAIN_ID, ROS_DISTRO, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and "
      "ROS_DISCOVERY_SERVER are honoured. Exit status: 0 success, 1 "
      "the run failed, 2 invalid configuration or command line, 130 or 143 interrupted (Ctrl-C, SIGTERM) before the "
      "end of the data.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? static_cast<int>(ExitStatus::kOk) : static_cast<int>(ExitStatus::kBadConfiguration);
  }
  if (!keystore.empty()) use_keystore(keystore, enclave);
  for (const auto& argument : arguments) {
    const auto separator = argument.find(":=");
    if (separator == std::string::npos || separator == 0) {
      std::cerr << "panvo run: \"" << argument << "\" is not an argument: write name:=value\n";
      return static_cast<int>(ExitStatus::kBadConfiguration);
    }
    options.arguments[argument.substr(0, separator)] = argument.substr(separator + 2);
  }
  return std::nullopt;
}

runtime::SystemDescription describe_system(const RunOptions& options) {
  runtime::SystemDescription system = runtime::read_system_file(options.system_file, options.arguments);
  if (system.containers.empty())
    throw runtime::ConfigError(options.system_file + ": has no node_container: nothing to run");
  const auto add_player = [&](const std::string& package, const std::string& plugin, const std::string& name,
                              const std::string& option, const std::string& directory) {
    runtime::ComponentDescription player;
    player.package = package;
    player.plugin = plugin;
    player.name = name;
    player.where = {option, 0};
    player.parameters["directory"] = {{std::filesystem::absolute(directory).string()}, false, player.where};
    // Same namespace as the first component, so a system in a namespace plays data sets unchanged.
    auto& components = system.containers.front().components;
    if (!components.empty()) {
      player.name_space = components.front().name_space;
      for (const char* topic : {"/tf", "/tf_static"}) {  // its transforms, too
        const auto found = components.front().remaps.find(topic);
        if (found != components.front().remaps.end()) player.remaps.insert(*found);
      }
    }
    components.push_back(std::move(player));  // last: a bag player skips topics that others publish
  };
  if (!options.dataset.empty()) {
    add_player("panvo_dataset_player", "DatasetPlayerComponent", "dataset_player", "--dataset", options.dataset);
  }
  if (!options.bag.empty()) add_player("panvo_recorder", "BagPlayerComponent", "bag_player", "--bag", options.bag);
  if (!options.calibration.empty()) add_calibration(options, system);
  if (options.view) add_view(system);
  for (const auto& setting : options.settings) runtime::apply_setting(system, setting);
  for (const auto& parameter : options.ros_parameters) runtime::apply_parameter(system, parameter);
  for (const auto& rule : options.ros_remaps) runtime::apply_remap(system, rule);
  return system;
}

}  // namespace panvo::runner
