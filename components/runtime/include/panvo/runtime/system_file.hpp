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
  std::map<std::string, std::string> remaps;  ///< from, to, as written; see resolve_topic
  OnError on_error = OnError::kIgnore;        ///< a system file that does not say means kRestart
  Location where;
};

/// One process: a `node_container`.
struct ContainerDescription {
  std::string name;
  std::string name_space;  ///< absolute, root "/"
  std::vector<ComponentDescription> components;
  bool respawn = false;                   ///< to be started again when it crashes or fails
  std::optional<double> respawn_delay_s;  ///< how long after
  double shared_images_mb = 0;            ///< size of the largest images that are shared in memory, MB; 0: none are
  double max_message_mb = 64;             ///< larger messages of others are refused and counted, MB
  double max_topic_rate_hz = 1000;        ///< of one topic; what others send beyond is refused and counted
  bool required = true;                   ///< when it is lost for good, the other processes of the system end too
  ServiceAccess services = ServiceAccess::kByHost;
  std::string files_below;               ///< folder below which requests by service may name files; empty: nowhere
  std::optional<double> requests_per_s;  ///< of one service, that are answered
  Location where;
};

/// Which processes there are and what each loads.
struct SystemDescription {
  std::string file;
  std::vector<ContainerDescription> containers;  ///< in the order of the file, no two components of one full name
  std::vector<std::string> notes;                ///< what was read and has no effect here, with file and line
};

/// Reads a system file: ROS 2's launch vocabulary in YAML.
///
///     launch:
///     - arg: {name: rig, default: kitti, description: folder of the calibration}
///     - node_container:
///         name: stereo
///         respawn: true            # when it crashes, after respawn_delay: 1 s
///         required: false          # the other processes go on when this one is lost; default: true
///         services: look           # or steer, off; default: who is on this host may steer, others look
///         files_below: /srv/panvo  # where requests by service may name files; default: nowhere
///         on_error: restart        # or stop (the container), ignore; of a component that throws. Also in a composable_node
///         shared_images_mb: 2      # images of up to 2 MB (64) pass to other containers of this machine in memory that both share
///         max_message_mb: 64       # larger messages of other processes are refused; the default
///         max_topic_rate_hz: 1000  # and what comes faster on one topic; the default
///         composable_node:
///         - pkg: panvo_binocular_odometry
///           plugin: BinocularOdometryComponent
///           name: binocular_odometry
///           param:
///           - from: $(dirname)/../rigs/$(var rig)/odometry.yaml     # a ROS 2 parameter file
///           - {name: tracker.max_features, value: 500}
///           remap:
///           - {from: stereo/left/image_rect, to: /camera/left/image_rect}
///
/// Also `let` (name, value), `include` (file, arg), `group` with `push_ros_namespace`, and `if`, `unless` on
/// each. Paths are relative to the file that has them. Substitutions: $(var NAME), $(env NAME [DEFAULT]),
/// $(dirname), $(find-pkg-share PACKAGE). `arguments` give the file's `arg`s. Throws ConfigError with every
/// problem found, each with file and line.
SystemDescription read_system_file(const std::filesystem::path& file,
                                   const std::map<std::string, std::string>& arguments = {});

/// Sets one parameter as the command line does: "binocular_odometry.tracker.max_features=500", a list as
/// "name.list=[1, 2]". A component that is in a namespace may be called by its full name; a short name means
/// each that has it. Throws ConfigError if there is none.
void apply_setting(SystemDescription& system, const std::string& setting);

}  // namespace panvo::runtime
