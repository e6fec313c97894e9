// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/qos_profile.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "qos_yaml.hpp"

namespace panvo::recorder {
namespace {

using Profile = QosProfile;

// Names by value, as in ROS 2's rmw layer.
constexpr std::array<std::string_view, 4> kHistory{"system_default", "keep_last", "keep_all", "unknown"};
constexpr std::array<std::string_view, 5> kReliability{"system_default", "reliable", "best_effort", "unknown",
                                                       "best_available"};
constexpr std::array<std::string_view, 5> kDurability{"system_default", "transient_local", "volatile", "unknown",
                                                      "best_available"};
constexpr std::array<std::string_view, 6> kLiveliness{"system_default",  "automatic", "manual_by_node",
                                                      "manual_by_topic", "unknown",   "best_available"};

template <class Policy, std::size_t N>
YAML::Node write_policy(Policy policy, const std::array<std::string_view, N>& names, QosNotation notation) {
  const int value = static_cast<int>(policy);
  return notation == QosNotation::kNumbers ? YAML::Node(value)
                                           : YAML::Node(std::string(names[static_cast<std::size_t>(value)]));
}

/// Reads either notation. Throws YAML::Exception or std::out_of_range.
template <class Policy, std::size_t N>
void read_policy(const YAML::Node& node, const std::array<std::string_view, N>& names, Policy& policy) {
  const auto text = node.as<std::string>();
  auto value = static_cast<std::size_t>(std::find(names.begin(), names.end(), text) - names.begin());
  if (value == N) {
    value = node.as<std::size_t>();
  }
  if (value >= N) {
    throw std::out_of_range(text);
  }
  policy = static_cast<Policy>(value);
}

YAML::Node write_qos_duration(const Profile::Duration& duration) {
  YAML::Node node;
  node["sec"] = duration.sec;
  node["nsec"] = duration.nsec;
  return node;
}

void read_duration(const YAML::Node& node, Profile::Duration& duration) {
  // In ROS 2 Foxy each middleware had its own value for infinite, some beyond int64; 0 meant unspecified.
  const auto sec = node["sec"].as<std::uint64_t>();
  const auto nsec = node["nsec"].as<std::uint64_t>();
  const bool infinite = sec >= 0x7fffffff || (sec == 0 && nsec == 0);
  duration = infinite ? Profile::Duration{}
                      : Profile::Duration{static_cast<std::int64_t>(sec), static_cast<std::int64_t>(nsec)};
}

Profile read_profile(const YAML::Node& node) {
  Profile profile;
  read_policy(node["history"], kHistory, profile.history);
  profile.depth = node["depth"].as<std::int64_t>();
  read_policy(node["reliability"], kReliability, profile.reliability);
  read_policy(node["durability"], kDurability, profile.durability);
  read_duration(node["deadline"], profile.deadline);
  read_duration(node["lifespan"], profile.lifespan);
  read_policy(node["liveliness"], kLiveliness, profile.liveliness);
  read_duration(node["liveliness_lease_duration"], profile.liveliness_lease_duration);
  profile.avoid_ros_namespace_conventions = node["avoid_ros_namespace_conventions"].as<bool>();
  return profile;
}

YAML::Node write_profile(const Profile& profile, QosNotation notation) {
  YAML::Node node;
  node["history"] = write_policy(profile.history, kHistory, notation);
  node["depth"] = profile.depth;
  node["reliability"] = write_policy(profile.reliability, kReliability, notation);
  node["durability"] = write_policy(profile.durability, kDurability, notation);
  node["deadline"] = write_qos_duration(profile.deadline);
  node["lifespan"] = write_qos_duration(profile.lifespan);
  node["liveliness"] = write_policy(profile.liveliness, kLiveliness, notation);
  node["liveliness_lease_duration"] = write_qos_duration(profile.liveliness_lease_duration);
  node["avoid_ros_namespace_conventions"] = profile.avoid_ros_namespace_conventions;
  return node;
}

}  // namespace

QosProfile offered_profile(const interfaces::Qos& qos) {
  QosProfile profile;
  profile.history = qos.keep_all ? Profile::History::kKeepAll : Profile::History::kKeepLast;
  profile.depth = static_cast<std::int64_t>(qos.depth);
  profile.reliability = Profile::Reliability::kReliable;  // our publishers always are; qos.requested is for subscribers
  profile.durability = qos.durability == interfaces::Durability::kTransientLocal ? Profile::Durability::kTransientLocal
                                                                                 : Profile::Durability::kVolatile;
  return profile;
}

interfaces::Qos replay_qos(const std::vector<QosProfile>& offered, std::uint64_t message_count) {
  interfaces::Qos qos;
  if (offered.empty()) {
    return qos;
  }
  const auto all = [&](auto predicate) { return std::all_of(offered.begin(), offered.end(), predicate); };
  const auto any = [&](auto predicate) { return std::any_of(offered.begin(), offered.end(), predicate); };
  if (any([](const Profile& p) { return p.reliability == Profile::Reliability::kBestEffort; })) {
    qos.requested = interfaces::Reliability::kBestEffort;
  }
  for (const auto& profile : offered) {
    qos.depth = std::max(qos.depth, static_cast<std::size_t>(std::clamp<std::int64_t>(profile.depth, 0, 100'000)));
  }
  if (all([](const Profile& p) { return p.durability == Profile::Durability::kTransientLocal; })) {
    constexpr std::uint64_t kMaxLatched = 1000;
    qos.durability = interfaces::Durability::kTransientLocal;
    qos.depth = std::max(qos.depth, static_cast<std::size_t>(std::min(message_count, kMaxLatched)));
    qos.keep_all = any([](const Profile& p) { return p.history == Profile::History::kKeepAll; });
  }
  return qos;
}

YAML::Node to_node(const std::vector<QosProfile>& profiles, QosNotation notation) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (const auto& profile : profiles) {
    node.push_back(write_profile(profile, notation));
  }
  return node;
}

std::vector<QosProfile> profiles_from_node(const YAML::Node& node) {
  std::vector<QosProfile> profiles;
  for (const auto& item : node) {
    profiles.push_back(read_profile(item));
  }
  return profiles;
}

std::string to_text(const std::vector<QosProfile>& profiles, QosNotation notation) {
  return profiles.empty() ? std::string() : YAML::Dump(to_node(profiles, notation));
}

std::optional<std::vector<QosProfile>> parse_qos_profiles(const std::string& text) {
  try {
    const auto node = YAML::Load(text);
    if (node.IsNull()) {
      return std::vector<QosProfile>{};
    }
    if (!node.IsSequence()) {
      return std::nullopt;
    }
    return profiles_from_node(node);
  } catch (const YAML::Exception&) {
  } catch (const std::out_of_range&) {
  }
  return std::nullopt;
}

}  // namespace panvo::recorder
