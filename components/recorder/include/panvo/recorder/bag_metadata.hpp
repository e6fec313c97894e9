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
  std::string type;  ///< "sensor_msgs/msg/Image"; bags from before ROS 2 Dashing say "sensor_msgs/Image"
  std::string serialization_format = "cdr";
  std::vector<QosProfile> offered_qos_profiles;
  std::string type_description_hash;  ///< "RIHS01_...", empty where not known
  std::uint64_t message_count = 0;

  /// A topic of ours.
  static BagTopic of(std::string name, const interfaces::MessageType& type, const interfaces::Qos& qos);
};

/// A message type as a bag carries it, so that tools which do not know the type can decode its messages.
struct TypeDefinition {
  std::string encoding;  ///< "ros2msg" or "ros2idl"; "" or "unknown" where there is none
  std::string text;      ///< the type, and all that it is made of
};

/// One file of a bag. Times in ns since 1970; of an empty file start is kNoStart.
struct BagFile {
  std::string path;  ///< relative to the bag's folder
  std::int64_t start_ns = 0;
  std::int64_t duration_ns = 0;
  std::uint64_t message_count = 0;
};

/// What metadata.yaml says of a bag.
struct BagMetadata {
  static constexpr int kCurrentVersion = 9;            ///< ROS 2 Jazzy's
  static constexpr std::int64_t kNoStart = INT64_MAX;  ///< rosbag2's start of a bag without messages

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

/// How many messages the recorder says it had to drop, in all or of one topic; 0 where it says nothing.
std::uint64_t dropped_messages(const BagMetadata& metadata, const std::string& topic = "");
void set_dropped_messages(BagMetadata& metadata, const std::string& topic, std::uint64_t count);

/// metadata.yaml's text, in version 9 whatever `metadata.version` says. `in_file`: as it stands within a .db3 or .mcap
/// file, without its outermost key.
std::string to_yaml(const BagMetadata& metadata, bool in_file = false);

/// Reads any version up to 9; what a version lacks stays empty. `file` is for messages. Throws BagError.
BagMetadata parse_metadata(const std::string& yaml, const std::filesystem::path& file);

/// Reads or replaces BAG/metadata.yaml. Replacing is atomic; with `durable` it also survives a power failure. Both
/// throw BagError.
BagMetadata read_metadata(const std::filesystem::path& bag);
void write_metadata(const std::filesystem::path& bag, const BagMetadata& metadata, bool durable);

inline constexpr const char* kMetadataFile = "metadata.yaml";

}  // namespace panvo::recorder
