// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_metadata.hpp"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <fstream>
#include <stdexcept>

#include "durable_file.hpp"
#include "panvo/recorder/bag_error.hpp"
#include "qos_yaml.hpp"

namespace panvo::recorder {
namespace {

constexpr const char* kRootKey = "rosbag2_bagfile_information";
constexpr const char* kDroppedKey = "dropped_messages";

YAML::Node write_start(std::int64_t start_ns) {
  YAML::Node node;
  node["nanoseconds_since_epoch"] = start_ns;
  return node;
}

YAML::Node write_duration(std::int64_t duration_ns) {
  YAML::Node node;
  node["nanoseconds"] = duration_ns;
  return node;
}

YAML::Node write_topic(const BagTopic& topic) {
  YAML::Node description;
  description["name"] = topic.name;
  description["type"] = topic.type;
  description["serialization_format"] = topic.serialization_format;
  description["offered_qos_profiles"] = to_node(topic.offered_qos_profiles, QosNotation::kNames);
  description["type_description_hash"] = topic.type_description_hash;
  YAML::Node node;
  node["topic_metadata"] = description;
  node["message_count"] = topic.message_count;
  return node;
}

YAML::Node write_file(const BagFile& file) {
  YAML::Node node;
  node["path"] = file.path;
  node["starting_time"] = write_start(file.start_ns);
  node["duration"] = write_duration(file.duration_ns);
  node["message_count"] = file.message_count;
  return node;
}

BagTopic read_topic(const YAML::Node& node) {
  const auto description = node["topic_metadata"];
  BagTopic topic;
  topic.name = description["name"].as<std::string>();
  topic.type = description["type"].as<std::string>();
  topic.serialization_format = description["serialization_format"].as<std::string>();
  if (const auto profiles = description["offered_qos_profiles"]) {
    if (profiles.IsSequence()) {  // since version 9
      topic.offered_qos_profiles = profiles_from_node(profiles);
    } else if (profiles.IsScalar()) {  // YAML within YAML
      topic.offered_qos_profiles = parse_qos_profiles(profiles.as<std::string>()).value_or(std::vector<QosProfile>{});
    }
  }
  topic.type_description_hash = description["type_description_hash"].as<std::string>("");
  topic.message_count = node["message_count"].as<std::uint64_t>();
  return topic;
}

BagFile read_file(const YAML::Node& node) {
  BagFile file;
  file.path = node["path"].as<std::string>();
  file.start_ns = node["starting_time"]["nanoseconds_since_epoch"].as<std::int64_t>();
  file.duration_ns = node["duration"]["nanoseconds"].as<std::int64_t>();
  file.message_count = node["message_count"].as<std::uint64_t>();
  return file;
}

/// `bytes`: length of the document. YAML aliases, which no recorder writes, can give each topic the profiles of all.
std::vector<BagTopic> read_topics(const YAML::Node& list, std::size_t bytes) {
  constexpr std::size_t kLeastBytes = 100, kRepeated = 1000;  // a profile without aliases; profiles of any document
  std::vector<BagTopic> topics;
  std::size_t profiles = 0;
  for (const auto& node : list) {
    topics.push_back(read_topic(node));
    profiles += topics.back().offered_qos_profiles.size();
    if (profiles > bytes / kLeastBytes + kRepeated) {
      throw YAML::Exception(node.Mark(), "aliases repeat the quality of service of topics too often");
    }
  }
  return topics;
}

BagMetadata read_bag(const YAML::Node& node, std::size_t bytes) {
  BagMetadata bag;
  bag.version = node["version"].as<int>();
  bag.storage_identifier = node["storage_identifier"].as<std::string>();
  bag.duration_ns = node["duration"]["nanoseconds"].as<std::int64_t>();
  bag.start_ns = node["starting_time"]["nanoseconds_since_epoch"].as<std::int64_t>();
  bag.message_count = node["message_count"].as<std::uint64_t>();
  bag.topics = read_topics(node["topics_with_message_count"], bytes);
  bag.compression_format = node["compression_format"].as<std::string>("");
  bag.compression_mode = node["compression_mode"].as<std::string>("");
  for (const auto& file : node["files"]) {  // since version 5
    bag.files.push_back(read_file(file));
  }
  if (bag.files.empty()) {
    for (const auto& path : node["relative_file_paths"]) {
      bag.files.push_back({.path = path.as<std::string>()});
    }
  }
  for (const auto& entry : node["custom_data"]) {  // since version 6
    bag.custom_data[entry.first.as<std::string>()] = entry.second.as<std::string>();
  }
  bag.ros_distro = node["ros_distro"].as<std::string>("");  // since version 8
  return bag;
}

std::string dropped_key(const std::string& topic) {
  return topic.empty() ? kDroppedKey : std::string(kDroppedKey) + " " + topic;
}

}  // namespace

BagTopic BagTopic::of(std::string name, const interfaces::MessageType& type, const interfaces::Qos& qos) {
  BagTopic topic;
  topic.name = std::move(name);
  topic.type = type.name;
  topic.offered_qos_profiles = {offered_profile(qos)};
  topic.type_description_hash = type.hash;
  return topic;
}

bool is_latched(const BagTopic& topic) {
  const auto& profiles = topic.offered_qos_profiles;
  return profiles.empty() ? topic.name == "/tf_static"  // early bags store no QoS; this topic is always latched
                          : std::all_of(profiles.begin(), profiles.end(), [](const QosProfile& profile) {
                              return profile.durability == QosProfile::Durability::kTransientLocal;
                            });
}

std::uint64_t dropped_messages(const BagMetadata& metadata, const std::string& topic) {
  const auto found = metadata.custom_data.find(dropped_key(topic));
  std::uint64_t count = 0;
  if (found != metadata.custom_data.end()) {
    const auto& text = found->second;
    std::from_chars(text.data(), text.data() + text.size(), count);
  }
  return count;
}

void set_dropped_messages(BagMetadata& metadata, const std::string& topic, std::uint64_t count) {
  metadata.custom_data[dropped_key(topic)] = std::to_string(count);
}

std::string to_yaml(const BagMetadata& metadata, bool in_file) {
  YAML::Node bag;
  bag["version"] = BagMetadata::kCurrentVersion;
  bag["storage_identifier"] = metadata.storage_identifier;
  bag["duration"] = write_duration(metadata.duration_ns);
  bag["starting_time"] = write_start(metadata.start_ns);
  bag["message_count"] = metadata.message_count;
  bag["topics_with_message_count"] = YAML::Node(YAML::NodeType::Sequence);
  for (const auto& topic : metadata.topics) {
    bag["topics_with_message_count"].push_back(write_topic(topic));
  }
  bag["compression_format"] = metadata.compression_format;
  bag["compression_mode"] = metadata.compression_mode;
  bag["relative_file_paths"] = YAML::Node(YAML::NodeType::Sequence);
  bag["files"] = YAML::Node(YAML::NodeType::Sequence);
  for (const auto& file : metadata.files) {
    bag["relative_file_paths"].push_back(file.path);
    bag["files"].push_back(write_file(file));
  }
  bag["custom_data"] = YAML::Node(YAML::NodeType::Null);
  for (const auto& [key, value] : metadata.custom_data) {
    bag["custom_data"][key] = value;
  }
  bag["ros_distro"] = metadata.ros_distro;
  if (in_file) {
    return YAML::Dump(bag);
  }
  YAML::Node root;
  root[kRootKey] = bag;
  return YAML::Dump(root) + "\n";
}

BagMetadata parse_metadata(const std::string& yaml, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) -> BagError {
    return BagError(file.string() + ": " + what + "; `panvo bag reindex` rewrites it from the files");
  };
  try {
    const auto root = YAML::Load(yaml);
    if (!root.IsMap()) {
      throw fail("is not the metadata of a bag");
    }
    const auto node = root[kRootKey] ? root[kRootKey] : root;
    if (!node["version"] || !node["storage_identifier"]) {
      throw fail("has no " + std::string(kRootKey) + " with version and storage_identifier");
    }
    return read_bag(node, yaml.size());
  } catch (const YAML::Exception& error) {
    const auto line = error.mark.is_null() ? std::string() : "line " + std::to_string(error.mark.line + 1) + ": ";
    throw fail(line + error.msg);
  } catch (const std::out_of_range& error) {
    throw fail("quality of service policy '" + std::string(error.what()) + "' is not known");
  }
}

BagMetadata read_metadata(const std::filesystem::path& bag) {
  const auto file = bag / kMetadataFile;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw BagError(file.string() + ": cannot be opened");
  }
  return parse_metadata({std::istreambuf_iterator<char>(stream), {}}, file);
}

void write_metadata(const std::filesystem::path& bag, const BagMetadata& metadata, bool durable) {
  replace_file(bag / kMetadataFile, to_yaml(metadata), durable);
}

}  // namespace panvo::recorder
