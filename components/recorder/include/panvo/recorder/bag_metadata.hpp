// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/qos_profile.hpp"

namespace panvo::recorder {

/// A recorded topic.
struct BagTopic {
  std::string name;  ///< "/stereo/left/image_raw"
  std::string type;  ///< "sensor_msgs/msg/Image"; "sensor_msgs/Image" in bags older than ROS 2 Dashing
  std::string serialization_format = "cdr";
  std::vector<QosProfile> offered_qos_profiles;
  std::string type_description_hash;  ///< "RIHS01_..."; empty if unknown
  std::uint64_t message_count = 0;

  /// Describes a topic published with this message type and quality of service.
  static BagTopic of(std::string name, const interfaces::MessageType& type, const interfaces::Qos& qos);
};

/// Whether subscribers that join later receive the topic's last messages.
bool is_latched(const BagTopic& topic);

/// A message type's definition as stored in a bag, so that tools without the type can decode its messages.
struct TypeDefinition {
  std::string encoding;  ///< "ros2msg" or "ros2idl"; "" or "unknown" if there is no definition
  std::string text;      ///< the type and all types that it contains
};

/// One file of a bag. Times in ns since 1970; start_ns of an empty file is kNoStart.
struct BagFile {
  std::string path;  ///< relative to the bag's folder
  std::int64_t start_ns = 0;
  std::int64_t duration_ns = 0;
  std::uint64_t message_count = 0;
};

/// Content of a bag's metadata.yaml.
struct BagMetadata {
  static constexpr int kCurrentVersion = 9;            ///< of ROS 2 Jazzy
  static constexpr std::int64_t kNoStart = INT64_MAX;  ///< rosbag2's start time of a bag without messages

  int version = kCurrentVersion;
  std::string storage_identifier = "sqlite3";
  std::int64_t start_ns = kNoStart;
  std::int64_t duration_ns = 0;
  std::uint64_t message_count = 0;
  std::vector<BagTopic> topics;
  std::string compression_format, compression_mode;
  std::vector<BagFile> files;
  std::map<std::string, std::string> custom_data;
  std::string ros_distro = "jazzy";
};

/// Number of messages the recorder dropped, in total ("") or on one topic; 0 if not recorded.
std::uint64_t dropped_messages(const BagMetadata& metadata, const std::string& topic = "");
void set_dropped_messages(BagMetadata& metadata, const std::string& topic, std::uint64_t count);

/// Text of metadata.yaml, always in version 9. `in_file`: the form stored inside a .db3 or .mcap file, without the
/// outermost key.
std::string to_yaml(const BagMetadata& metadata, bool in_file = false);

/// Parses any version up to 9; fields that a version lacks stay empty. `file` is named in errors. Throws BagError.
BagMetadata parse_metadata(const std::string& yaml, const std::filesystem::path& file);

/// Reads or replaces BAG/metadata.yaml. Replacement is atomic and, with `durable`, survives a power failure. Both throw
/// BagError.
BagMetadata read_metadata(const std::filesystem::path& bag);
void write_metadata(const std::filesystem::path& bag, const BagMetadata& metadata, bool durable);

inline constexpr const char* kMetadataFile = "metadata.yaml";

}  // namespace panvo::recorder
