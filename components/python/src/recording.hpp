// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"
#include "stereo_pair.hpp"

namespace panvo::python {

/// 8-bit grey or BGR pixels, and what keeps them if they are a view.
struct RecordedImage {
  cv::Mat pixels;
  std::shared_ptr<const void> owner;
};

/// A stereo pair (two images) or a panorama (one).
struct RecordedFrame {
  std::int64_t stamp_ns = 0;
  std::vector<RecordedImage> images;

  bool is_panorama() const { return images.size() == 1; }
};

/// Part of a recording to read.
struct Part {
  double start_s = 0.0;     ///< after the first image
  double duration_s = 0.0;  ///< 0: to the end
  bool stereo = true;
  bool panoramas = true;
};

/// Reads the frames of a recording in order. Not thread-safe.
class FrameReader {
 public:
  FrameReader() = default;
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;
  virtual ~FrameReader() = default;

  /// nullopt at the end. Unreadable images are skipped and described in `warnings`.
  virtual std::optional<RecordedFrame> next(std::vector<std::string>& warnings) = 0;
};

/// A recording of any kind.
struct Recording {
  std::string kind;  ///< "KITTI odometry", "EuRoC/ASL", "left/right folders", "bag"
  std::filesystem::path path;
  std::optional<StereoPair> stereo;
  std::optional<Eigen::Isometry3d> base_from_panorama;        ///< nullopt: no panoramas
  std::vector<dataset_player::GroundTruthPose> ground_truth;  ///< stamps increase
  std::vector<std::string> notes;                             ///< warnings for the user

  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;

  /// Throws DatasetError if the part has no images.
  virtual std::unique_ptr<FrameReader> read(const Part& part) const = 0;
};

struct RecordingOptions {
  dataset_player::ReadOptions folder;         ///< of a data set
  std::map<std::string, std::string> topics;  ///< of a bag: role to name, see bag_roles()
};

/// Roles of the topics of a bag, with the names that panvo's components use: "left" to "/stereo/left/image_raw".
const std::map<std::string, std::string>& bag_roles();

/// Opens a data set or a bag. Throws DatasetError, FileError or BagError.
std::shared_ptr<const Recording> open_recording(const std::filesystem::path& path, const RecordingOptions& options);

std::shared_ptr<const Recording> open_folder(const std::filesystem::path& path,
                                             const dataset_player::ReadOptions& options);
std::shared_ptr<const Recording> open_bag(const std::filesystem::path& path,
                                          const std::map<std::string, std::string>& topics);

/// The stereo camera of a recording. Throws DatasetError if it has none.
const StereoPair& expect_stereo(const Recording& recording, const std::filesystem::path& path);

}  // namespace panvo::python
