// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/policies.hpp"

namespace panvo::runtime {

/// One component to load: a `composable_node`.
struct ComponentDescription {
  std::string package;     ///< "panvo_binocular_odometry"
  std::string plugin;      ///< class name: "BinocularOdometryComponent"
  std::string name;        ///< "binocular_odometry"
  std::string name_space;  ///< absolute, root "/"
  WrittenValues parameters;
  std::map<std::string, std::string> remaps;  ///< from, to, as configured; see resolve_topic
  OnError on_error = OnError::kIgnore;        ///< default in a system file: kRestart
  Location where;
};

/// One process: a `node_container`.
struct ContainerDescription {
  std::string name;
  std::string name_space;  ///< absolute, root "/"
  std::vector<ComponentDescription> components;
  WrittenValues parameters;               ///< of its own node: use_sim_time, qos_overrides
  bool respawn = false;                   ///< restart after a crash or failure
  std::optional<double> respawn_delay_s;  ///< delay before the restart
  double shared_images_mb = 0;            ///< largest shared image, MB; 0: no sharing
  double max_message_mb = 64;             ///< larger messages of other processes are refused and counted, MB
  double max_topic_rate_hz = 1000;        ///< per topic; excess messages of other processes are refused and counted
  bool required = true;                   ///< if it is lost, the other processes of the system end too
  ServiceAccess services = ServiceAccess::kByHost;
  std::string files_below;               ///< folder for files named by service requests; empty: none allowed
  std::optional<double> requests_per_s;  ///< limit per service
  Location where;
};

/// The processes of a system and their components.
struct SystemDescription {
  std::string file;
  std::vector<ContainerDescription> containers;  ///< in file order; full component names are unique
  std::vector<std::string> notes;                ///< settings without effect here, with file and line
};

/// Reads a system file: ROS 2's launch vocabulary in YAML.
///
///     launch:
///     - arg: {name: rig, default: kitti, description: folder of the calibration}
///     - node_container:
///         name: stereo
///         respawn: true            # restart after a crash; respawn_delay: 1 s
///         required: false          # the other processes continue if this one is lost; default: true
///         services: look           # or steer, off; default: this host may control, others may read
///         files_below: /srv/panvo  # folder for files named by service requests; default: none
///         on_error: restart        # or stop (the container), ignore: if a component throws; also in a composable_node
///         shared_images_mb: 2      # largest image shared in memory with containers of this machine; default: 64
///         max_message_mb: 64       # larger messages of other processes are refused (default value)
///         max_topic_rate_hz: 1000  # excess messages on a topic are refused (default value)
///         composable_node:
///         - pkg: panvo_binocular_odometry
///           plugin: BinocularOdometryComponent
///           name: binocular_odometry
///           param:
///           - from: $(dirname)/../rigs/$(var rig)/odometry.yaml  # ROS 2 parameter file; "/**": nodes that have it
///           - {name: tracking.max_features, value: 500}
///           remap:
///           - {from: stereo/left/image_rect, to: /camera/left/image_rect}
///
/// Also supported: `let` (name, value), `include` (file, arg), `group` with `push_ros_namespace`, and `if` and `unless`
/// on each. Paths are relative to the file they appear in. Substitutions: $(var NAME), $(env NAME [DEFAULT]),
/// $(dirname), $(find-pkg-share PACKAGE). `arguments` sets the file's `arg` entries. Throws ConfigError with all
/// problems, each with file and line.
SystemDescription read_system_file(const std::filesystem::path& file,
                                   const std::map<std::string, std::string>& arguments = {});

/// Sets one parameter as on the command line: "binocular_odometry.tracking.max_features=500", a list as "name.list=[1,
/// 2]". A component in a namespace may be given by its full name; a short name selects all components of that name.
/// Throws ConfigError if there is none.
void apply_setting(SystemDescription& system, const std::string& setting);

/// Sets a parameter by ROS 2's option -p: "use_sim_time:=true" for all nodes that have it, "NODE:NAME:=VALUE" for
/// one. Throws ConfigError if there is no such node.
void apply_parameter(SystemDescription& system, const std::string& assignment);

/// Applies a rule of ROS 2's option -r: "__ns:=/NS" puts all nodes into a namespace, "__node:=NAME" names the container,
/// "FROM:=TO" remaps a topic for all components. With "NODE:" in front, a rule applies to that node only. Throws
/// ConfigError on an invalid rule, or if two nodes have the same name afterwards.
void apply_remap(SystemDescription& system, const std::string& rule);

}  // namespace panvo::runtime
