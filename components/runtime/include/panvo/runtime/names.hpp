// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Names follow ROS 2: words of letters, digits and underscores that do not start with a digit, joined by '/'. A name
/// is relative ("odometry/binocular"), absolute ("/tf") or private to a node ("~/status").

/// Returns what is wrong with a topic name of a component or remap rule, and the remedy; nullopt if valid.
std::optional<std::string> topic_name_problem(std::string_view name);

/// The same for a node name: one word.
std::optional<std::string> node_name_problem(std::string_view name);

/// The same for a package name: lower-case letters, digits and underscores, starting with a letter. It becomes part of
/// a file name.
std::optional<std::string> package_name_problem(std::string_view name);

/// The same for a component class, with or without namespaces: "panvo::StereoRectifierComponent".
std::optional<std::string> class_name_problem(std::string_view name);

/// The same for a namespace: "", "/", "robot" or "/fleet/robot".
std::optional<std::string> name_space_problem(std::string_view name_space);

/// Absolute form of `inner` within `outer`: "/fleet" and "robot" give "/fleet/robot"; an absolute `inner` is returned
/// unchanged. The root is "/".
std::string join_name_spaces(std::string_view outer, std::string_view inner);

/// Joins a namespace and a topic or node name: "/robot" and "odometry/binocular" give "/robot/odometry/binocular".
std::string full_name(std::string_view name_space, std::string_view name);

/// Resolves the topic name of a node. A remap rule matches in both forms: "image" and "/robot/image" remap the topic
/// "image" of a node in "/robot". The new name is resolved in the same way. Throws ConfigError on an invalid name.
std::string resolve_topic(std::string_view name_space, std::string_view node_name,
                          const std::map<std::string, std::string>& remaps, std::string_view topic);

/// Whether there is a rule for this topic of a node, in any form.
bool is_remapped(std::string_view name_space, std::string_view node_name,
                 const std::map<std::string, std::string>& remaps, std::string_view topic);

/// Adds a rule, which replaces those for the same topic in other forms.
void set_remap(std::string_view name_space, std::string_view node_name, std::map<std::string, std::string>& remaps,
               const std::string& from, const std::string& to);

}  // namespace panvo::runtime
