// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Names follow ROS 2: words of letters, digits and underscores that do not begin with a digit, joined by
/// '/'. A name is relative ("odometry/binocular"), absolute ("/tf") or private to a node ("~/status").

/// What is wrong with a topic name as a component or a remap rule may write it, and what to write instead;
/// nullopt: fine.
std::optional<std::string> topic_name_problem(std::string_view name);

/// The same for a node's name: one word.
std::optional<std::string> node_name_problem(std::string_view name);

/// The same for a package: small letters, digits and underscores, a letter first. It becomes part of a file's name.
std::optional<std::string> package_name_problem(std::string_view name);

/// The same for a component's class, with or without its namespaces: "panvo::StereoRectifierComponent".
std::optional<std::string> class_name_problem(std::string_view name);

/// The same for a namespace: "", "/", "robot" or "/fleet/robot".
std::optional<std::string> name_space_problem(std::string_view name_space);

/// `inner` as seen from within `outer`, absolute: "/fleet" and "robot" give "/fleet/robot"; an absolute
/// `inner` stays. The root is "/".
std::string join_name_spaces(std::string_view outer, std::string_view inner);

/// "/robot" and "odometry/binocular" give "/robot/odometry/binocular"; the name of a node in a namespace
/// likewise.
std::string full_name(std::string_view name_space, std::string_view name);

/// The name under which `topic` of a node goes over the wire. A remap rule is tried in both forms: "image",
/// and "/robot/image", remap the topic "image" of a node in "/robot"; what it gives is resolved likewise.
/// Throws ConfigError on a name that is none.
std::string resolve_topic(std::string_view name_space, std::string_view node_name,
                          const std::map<std::string, std::string>& remaps, std::string_view topic);

}  // namespace panvo::runtime
