// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "panvo/conversions/pose.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/dataset_player/timeline.hpp"
#include "recording.hpp"

namespace panvo::python {
namespace {

using dataset_player::Colour;
using dataset_player::Dataset;
using dataset_player::TimelineEvent;

/// A pose as /tf_static carries it, with the last digits of a quaternion, so that results equal those of `panvo run`.
Eigen::Isometry3d as_transmitted(const Eigen::Isometry3d& pose) {
  return *conversions::to_isometry(conversions::to_transform(pose));
}

class FolderReader final : public FrameReader {
 public:
  FolderReader(std::shared_ptr<const Dataset> dataset, const Part& part)
      : dataset_(std::move(dataset)),
        events_(dataset_player::timeline(*dataset_, {.start_s = part.start_s,
                                                     .duration_s = part.duration_s,
                                                     .stereo = part.stereo,
                                                     .panorama = part.panoramas})) {}

  std::optional<RecordedFrame> next(std::vector<std::string>& warnings) override {
    while (next_ < events_.size()) {
      const auto& event = events_[next_++];
      if (event.kind == TimelineEvent::Kind::kGroundTruth || event.kind == TimelineEvent::Kind::kImu) continue;
      if (auto frame = load(event, warnings)) return frame;
    }
    return std::nullopt;
  }

 private:
  std::optional<RecordedFrame> load(const TimelineEvent& event, std::vector<std::string>& warnings) {
    RecordedFrame frame{event.stamp_ns, {}};
    const auto add = [&](const std::filesystem::path& file, int width, int height) {
      cv::Mat pixels;
      auto problem = decoder_.decode(file, Colour::kAsStored, pixels);
      if (!problem && (pixels.cols != width || pixels.rows != height)) {
        problem = fmt::format("{}: is {} x {} px, the previous images are {} x {} px", file.string(), pixels.cols,
                              pixels.rows, width, height);
      }
      if (problem) warnings.push_back(*problem + "; frame skipped");
      frame.images.push_back({pixels, nullptr});
      return !problem;
    };
    if (event.kind == TimelineEvent::Kind::kPanorama) {
      const auto& panorama = *dataset_->panorama;
      if (!add(panorama.frames[event.index].image, panorama.width, panorama.height)) return std::nullopt;
    } else {
      const auto& files = dataset_->stereo->frames[event.index];
      const auto& [left, right, right_from_left] = dataset_->stereo->calibration;
      if (!add(files.left, left.pinhole.width, left.pinhole.height) ||
          !add(files.right, right.pinhole.width, right.pinhole.height)) {
        return std::nullopt;
      }
    }
    return frame;
  }

  std::shared_ptr<const Dataset> dataset_;
  std::vector<TimelineEvent> events_;
  std::size_t next_ = 0;
  dataset_player::ImageDecoder decoder_;
};

class FolderRecording final : public Recording {
 public:
  explicit FolderRecording(Dataset dataset) : dataset_(std::make_shared<const Dataset>(std::move(dataset))) {
    kind = dataset_->kind;
    path = dataset_->directory;
    notes = dataset_->notes;
    ground_truth = dataset_->ground_truth;
    if (const auto& recorded = dataset_->stereo) {
      stereo = StereoPair{recorded->calibration, recorded->rectified, as_transmitted(recorded->base_from_left)};
    }
    if (dataset_->panorama) base_from_panorama = dataset_->panorama->base_from_panorama;
  }

  std::unique_ptr<FrameReader> read(const Part& part) const override {
    return std::make_unique<FolderReader>(dataset_, part);
  }

 private:
  std::shared_ptr<const Dataset> dataset_;
};

}  // namespace

std::shared_ptr<const Recording> open_folder(const std::filesystem::path& path,
                                             const dataset_player::ReadOptions& options) {
  return std::make_shared<FolderRecording>(dataset_player::open_dataset(path, options));
}

}  // namespace panvo::python
