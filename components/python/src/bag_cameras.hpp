// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "stereo_pair.hpp"

namespace panvo::python {

/// The topics of a bag that hold a recording, by role; roles without a topic are missing.
struct BagTopics {
  std::map<std::string, std::string> by_role;
  bool is_rectified = false;  ///< left and right are rectified images

  bool has(const std::string& role) const { return by_role.contains(role); }
  /// The role of a topic; empty if it has none.
  std::string role_of(const std::string& topic) const;
};

/// Finds the topics by panvo's names, or those in `given` (role to name). Throws DatasetError for a given topic
/// that the bag lacks or one of the wrong type, std::invalid_argument for an unknown role.
BagTopics find_topics(const recorder::BagMetadata& bag, const std::map<std::string, std::string>& given,
                      const std::filesystem::path& path);

/// What a bag says about its cameras.
struct BagCameras {
  std::optional<StereoPair> stereo;
  std::optional<Eigen::Isometry3d> base_from_panorama;
  std::vector<dataset_player::GroundTruthPose> ground_truth;
  std::vector<std::string> notes;
};

/// Reads the first camera_info of each eye, /tf_static, the frame of the panoramas, and the ground truth. Throws
/// DatasetError if the camera_infos are not those of a stereo pair.
BagCameras read_cameras(recorder::BagReader& bag, const BagTopics& topics);

/// Decodes a message. Throws DecodeError.
template <class Message>
std::shared_ptr<const Message> decode(const recorder::BagMessage& message) {
  return std::static_pointer_cast<const Message>(interfaces::message_type<Message>().deserialize(message.data));
}

}  // namespace panvo::python
