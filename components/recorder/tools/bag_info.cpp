// SPDX-License-Identifier: Apache-2.0
#include "bag_info.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <vector>

#include "panvo/recorder/input_proposal.hpp"

namespace panvo::recorder {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::string seconds(std::int64_t time_ns) {
  std::int64_t whole = time_ns / kNsPerS;
  std::int64_t rest = time_ns % kNsPerS;
  if (rest < 0) {
    rest += kNsPerS;
    --whole;
  }
  char text[48];
  std::snprintf(text, sizeof text, "%lld.%09lld", static_cast<long long>(whole), static_cast<long long>(rest));
  return text;
}

std::string date(std::int64_t time_ns) {
  const std::time_t whole = time_ns / kNsPerS;
  std::tm local{};
  localtime_r(&whole, &local);
  char text[64];
  std::strftime(text, sizeof text, "%b %d %Y %H:%M:%S", &local);
  const auto in_seconds = seconds(time_ns);
  return text + in_seconds.substr(in_seconds.find('.')) + " (" + in_seconds + ")";
}

std::string size(std::uint64_t bytes) {
  const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024.0 && unit + 1 < std::size(units); ++unit) {
    value /= 1024.0;
  }
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return text;
}

std::vector<BagTopic> sorted_topics(const BagReader& bag) {
  auto topics = bag.metadata().topics;
  std::sort(topics.begin(), topics.end(), [](const BagTopic& a, const BagTopic& b) { return a.name < b.name; });
  return topics;
}

/// How to play the bag in a system, and what it lacks.
std::string describe_inputs(const BagReader& bag) {
  const auto proposal = propose_inputs(bag.metadata().topics);
  if (!proposal.has_stereo) return {};
  std::string text = proposal.has_panorama ? "panvo run enhanced_vo" : "panvo run stereo";
  text += " --bag " + bag.path().string();
  if (!proposal.has_camera_info) text += " --calibration FOLDER";
  if (proposal.is_compressed) text += " compressed:=true";
  for (const auto& rename : proposal.renames)
    text += " \\\n" + std::string(21, ' ') + "-r " + rename.recorded + ":=" + rename.read_as;
  return text;
}

}  // namespace

std::string describe_as_text(const BagReader& bag) {
  const auto& metadata = bag.metadata();
  std::string text;
  const auto line = [&](std::string label, const std::string& value) {
    label.resize(19, ' ');
    text += label + value + "\n";
  };
  for (std::size_t i = 0; i < metadata.files.size(); ++i) {
    line(i == 0 ? "Files:" : "", metadata.files[i].path);
  }
  line("Bag size:", size(bag.size_bytes()));
  line("Storage id:", metadata.storage_identifier);
  line("ROS Distro:", metadata.ros_distro.empty() ? "unknown" : metadata.ros_distro);
  line("Duration:", seconds(metadata.duration_ns) + "s");
  line("Start:", metadata.message_count > 0 ? date(metadata.start_ns) : "-");
  line("End:", metadata.message_count > 0 ? date(metadata.start_ns + metadata.duration_ns) : "-");
  line("Messages:", std::to_string(metadata.message_count));
  line("Dropped:", std::to_string(dropped_messages(metadata)));
  if (bag.lost_messages() > 0) {
    line("Unreadable:", std::to_string(bag.lost_messages()));
  }
  std::string label = "Topic information:";
  for (const auto& topic : sorted_topics(bag)) {
    const auto dropped = dropped_messages(metadata, topic.name);
    line(label, "Topic: " + topic.name + " | Type: " + topic.type + " | Count: " + std::to_string(topic.message_count) +
                    " | Serialization Format: " + topic.serialization_format +
                    (dropped > 0 ? " | Dropped: " + std::to_string(dropped) : ""));
    label.clear();
  }
  if (metadata.topics.empty()) {
    line(label, "-");
  }
  if (const auto inputs = describe_inputs(bag); !inputs.empty()) line("Play with:", inputs);
  return text;
}

std::string describe_as_json(const BagReader& bag) {
  const auto& metadata = bag.metadata();
  nlohmann::ordered_json json;
  json["bag"] = bag.path().string();
  for (const auto& file : metadata.files) {
    json["files"].push_back(file.path);
  }
  json["size_bytes"] = bag.size_bytes();
  json["storage"] = metadata.storage_identifier;
  json["metadata_version"] = metadata.version;
  json["ros_distro"] = metadata.ros_distro;
  json["duration_ns"] = metadata.duration_ns;
  const bool empty = metadata.message_count == 0;
  json["start_ns"] = empty ? nlohmann::ordered_json() : nlohmann::ordered_json(metadata.start_ns);
  json["end_ns"] = empty ? nlohmann::ordered_json() : nlohmann::ordered_json(metadata.start_ns + metadata.duration_ns);
  json["messages"] = metadata.message_count;
  json["dropped"] = dropped_messages(metadata);
  json["unreadable"] = bag.lost_messages();
  json["topics"] = nlohmann::ordered_json::array();
  for (const auto& topic : sorted_topics(bag)) {
    const auto latched = std::any_of(
        topic.offered_qos_profiles.begin(), topic.offered_qos_profiles.end(),
        [](const QosProfile& profile) { return profile.durability == QosProfile::Durability::kTransientLocal; });
    json["topics"].push_back({{"name", topic.name},
                              {"type", topic.type},
                              {"count", topic.message_count},
                              {"serialization_format", topic.serialization_format},
                              {"transient_local", latched},
                              {"dropped", dropped_messages(metadata, topic.name)}});
  }
  const auto proposal = propose_inputs(metadata.topics);
  json["inputs"] = {{"stereo", proposal.has_stereo},
                    {"camera_info", proposal.has_camera_info},
                    {"panorama", proposal.has_panorama},
                    {"compressed", proposal.is_compressed},
                    {"renames", nlohmann::ordered_json::object()}};
  for (const auto& rename : proposal.renames) json["inputs"]["renames"][rename.recorded] = rename.read_as;
  json["custom_data"] = metadata.custom_data;
  json["warnings"] = bag.warnings();
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace panvo::recorder
