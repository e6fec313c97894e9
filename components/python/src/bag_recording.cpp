// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "bag_cameras.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "recording.hpp"

namespace panvo::python {
namespace {

using dataset_player::DatasetError;

/// Pairs the images of a bag by equal stamps.
class BagFrameReader final : public FrameReader {
 public:
  BagFrameReader(const std::filesystem::path& path, BagTopics topics, const Part& part)
      : bag_(path), topics_(std::move(topics)), part_(part) {
    bag_.select([&](const recorder::BagTopic& topic) {
      const auto role = topics_.role_of(topic.name);
      return ((role == "left" || role == "right") && part_.stereo) || (role == "panorama" && part_.panoramas);
    });
  }

  std::optional<RecordedFrame> next(std::vector<std::string>& warnings) override {
    while (auto* message = bag_.next()) {
      const auto& topic = bag_.metadata().topics[message->topic];
      auto frame = add(topics_.role_of(topic.name), topic.name, *message, warnings);
      if (!frame) continue;
      if (!begin_ns_) begin_ns_ = frame->stamp_ns + std::llround(part_.start_s * 1e9);
      if (frame->stamp_ns < *begin_ns_) continue;
      if (part_.duration_s > 0.0 && frame->stamp_ns > *begin_ns_ + std::llround(part_.duration_s * 1e9)) return {};
      return frame;
    }
    return std::nullopt;
  }

 private:
  std::optional<RecordedFrame> add(const std::string& role, const std::string& topic,
                                   const recorder::BagMessage& message, std::vector<std::string>& warnings) {
    std::shared_ptr<const sensor_msgs::msg::Image> image;
    try {
      image = decode<sensor_msgs::msg::Image>(message);
    } catch (const interfaces::DecodeError& error) {
      warnings.push_back(fmt::format("{}: {}; image skipped", topic, error.what()));
      return std::nullopt;
    }
    const auto pixels = conversions::grey_or_bgr(*image);
    if (!pixels) {
      warnings.push_back(fmt::format("{} {}; image skipped", topic, pixels.reason()));
      return std::nullopt;
    }
    const std::int64_t stamp_ns = conversions::stamp_ns(*image);
    const bool is_view = pixels->data == image->data().data();
    RecordedImage recorded{*pixels, is_view ? image : nullptr};
    if (role == "panorama") return RecordedFrame{stamp_ns, {std::move(recorded)}};
    return pair(role == "left", stamp_ns, std::move(recorded));
  }

  std::optional<RecordedFrame> pair(bool is_left, std::int64_t stamp_ns, RecordedImage image) {
    constexpr std::size_t kMostWaiting = 20;
    auto& own = is_left ? left_ : right_;
    auto& other = is_left ? right_ : left_;
    if (const auto partner = other.find(stamp_ns); partner != other.end()) {
      RecordedFrame frame{stamp_ns, {}};
      frame.images = is_left ? std::vector{std::move(image), std::move(partner->second)}
                             : std::vector{std::move(partner->second), std::move(image)};
      for (auto* waiting : {&left_, &right_}) waiting->erase(waiting->begin(), waiting->upper_bound(stamp_ns));
      return frame;
    }
    own.insert_or_assign(stamp_ns, std::move(image));
    if (own.size() > kMostWaiting) own.erase(own.begin());
    return std::nullopt;
  }

  recorder::BagReader bag_;
  BagTopics topics_;
  Part part_;
  std::optional<std::int64_t> begin_ns_;
  std::map<std::int64_t, RecordedImage> left_, right_;  // images whose partner has not come yet
};

class BagRecording final : public Recording {
 public:
  BagRecording(const std::filesystem::path& bag_path, const std::map<std::string, std::string>& given) {
    kind = "bag";
    path = bag_path;
    recorder::BagReader bag(path);
    topics_ = find_topics(bag.metadata(), given, path);
    if (!(topics_.has("left") && topics_.has("right")) && !topics_.has("panorama")) {
      throw DatasetError(fmt::format(
          "{}: has neither {} and {} nor {}; name its topics: Recording(..., topics={{\"left\": ..., \"right\": ...}})",
          path.string(), bag_roles().at("left"), bag_roles().at("right"), bag_roles().at("panorama")));
    }
    auto cameras = read_cameras(bag, topics_);
    stereo = std::move(cameras.stereo);
    base_from_panorama = cameras.base_from_panorama;
    ground_truth = std::move(cameras.ground_truth);
    notes = bag.warnings();
    notes.insert(notes.end(), cameras.notes.begin(), cameras.notes.end());
  }

  std::unique_ptr<FrameReader> read(const Part& part) const override {
    return std::make_unique<BagFrameReader>(path, topics_, part);
  }

 private:
  BagTopics topics_;
};

}  // namespace

std::shared_ptr<const Recording> open_bag(const std::filesystem::path& path,
                                          const std::map<std::string, std::string>& topics) {
  return std::make_shared<BagRecording>(path, topics);
}

std::shared_ptr<const Recording> open_recording(const std::filesystem::path& path, const RecordingOptions& options) {
  if (recorder::is_bag(path)) return open_bag(path, options.topics);
  return open_folder(path, options.folder);
}

const StereoPair& expect_stereo(const Recording& recording, const std::filesystem::path& path) {
  if (!recording.stereo) throw DatasetError(fmt::format("{}: has no calibrated stereo camera", path.string()));
  return *recording.stereo;
}

}  // namespace panvo::python
