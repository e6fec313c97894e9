// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <deque>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/dataset_player/passes.hpp"
#include "panvo/dataset_player/timeline.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::dataset_player {

struct Parameters {
  std::string directory;
  std::string calibration;
  std::string cameras = "all";
  bool grey = false;
  double rate_hz = 0.0;
  double start_s = 0.0;
  double duration_s = 0.0;
  int passes = 1;
  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.path(&P::directory, "directory",
               "folder of the data set: KITTI odometry, EuRoC/ASL, or left/right folders with a calibration");
    field.path(&P::calibration, "calibration",
               "calibration folder for left/right folders, as in config/rigs; empty: the data set's own");
    field(&P::cameras, "cameras", "", "cameras to play", {"all", "stereo", "panorama"});
    field(&P::grey, "grey", "", "decode the stereo images as grey even if they are stored in colour");
    field(&P::rate_hz, "rate_hz", "Hz", "frame rate of data sets without times; 0: KITTI 10, folders 30", 0.0, 1000.0);
    field(&P::start_s, "start_s", "s", "start, after the first image", 0.0, 1e6);
    field(&P::duration_s, "duration_s", "s", "duration to play; 0: to the end", 0.0, 1e6);
    field(&P::passes, "passes", "", "number of passes: forward, backward, forward, ... with increasing stamps", 1,
          1'000'000);
  }
};

/// Plays a data set as if it were live cameras: static transforms of the cameras first, then image_raw and camera_info
/// of each stereo camera, the panorama, inertial measurements and the ground truth.
class DatasetPlayerComponent final : public runtime::Component, public runtime::Source {
 public:
  explicit DatasetPlayerComponent(runtime::Context& context);

  std::optional<std::int64_t> next_stamp_ns() override;
  void emit() override;
  Progress progress() const override { return {steps_done_, steps_total_}; }

 private:
  /// Output of one camera.
  struct Camera {
    std::string frame_id;
    runtime::Output<sensor_msgs::msg::Image> images;
    int width = 0, height = 0;
    Colour colour = Colour::kAsStored;
  };
  struct Eye {
    Camera camera;
    runtime::Output<sensor_msgs::msg::CameraInfo> infos;
    conversions::PairedCamera geometry;
  };
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;
  /// Left and right image of a stereo frame, or one panorama; nullptr for none or if the file is unusable.
  using Images = std::array<ImagePtr, 2>;

  void open(const Parameters& parameters);
  void open_stereo(const StereoRecording& stereo, Colour colour);
  void say_what_is_played() const;
  void publish_static_transforms(std::int64_t stamp_ns);
  void publish_ground_truth(const GroundTruthPose& pose, std::int64_t stamp_ns);
  void publish_imu(const ImuSample& sample, std::int64_t stamp_ns);
  void publish_stereo(std::int64_t stamp_ns, const Images& images);
  void load_ahead();
  Images load(const TimelineEvent& event);
  ImagePtr load(const Camera& camera, const std::filesystem::path& file, std::int64_t stamp_ns);
  void report_unreadable(const std::string& what);

  static constexpr const char* kImuFrame = "imu";

  runtime::Context& context_;
  Dataset dataset_;
  Passes events_;
  std::uint64_t next_ = 0;
  std::deque<Images> ahead_;  ///< preloaded images of the events from next_ on
  std::optional<Eye> left_, right_;
  std::optional<Camera> panorama_;
  std::optional<runtime::Output<nav_msgs::msg::Odometry>> ground_truth_;
  std::optional<runtime::Output<sensor_msgs::msg::Imu>> imu_;
  runtime::Output<tf2_msgs::msg::TFMessage> static_transforms_;
  ImageDecoder decoder_;
  bool is_placed_ = false;  ///< the static transforms have been published
  TimelineEvent::Kind step_kind_ = TimelineEvent::Kind::kStereo;
  std::uint64_t steps_done_ = 0, steps_total_ = 0;
  std::uint64_t unreadable_ = 0;
};

DatasetPlayerComponent::DatasetPlayerComponent(runtime::Context& context)
    : context_(context), static_transforms_(context.output(topics::kTfStatic)) {
  const auto parameters = context.parameters<Parameters>();
  try {
    open(parameters);
  } catch (const DatasetError& error) {
    throw runtime::ConfigError(error.what());
  }
  say_what_is_played();
  context.source(*this);
}

void DatasetPlayerComponent::open(const Parameters& parameters) {
  dataset_ = open_dataset(parameters.directory, {.rate_hz = parameters.rate_hz, .calibration = parameters.calibration});
  const Selection selection{.start_s = parameters.start_s,
                            .duration_s = parameters.duration_s,
                            .stereo = parameters.cameras != "panorama",
                            .panorama = parameters.cameras != "stereo"};
  events_ = Passes(timeline(dataset_, selection), static_cast<std::uint64_t>(parameters.passes));
  if (dataset_.stereo && selection.stereo) {
    open_stereo(*dataset_.stereo, parameters.grey ? Colour::kGrey : Colour::kAsStored);
  }
  if (dataset_.panorama && selection.panorama) {
    panorama_.emplace(Camera{"panorama_optical", context_.output(topics::kPanorama), dataset_.panorama->width,
                             dataset_.panorama->height});
  }
  if (!dataset_.ground_truth.empty()) ground_truth_.emplace(context_.output(topics::kGroundTruth));
  if (dataset_.imu) imu_.emplace(context_.output(topics::kImu));
  step_kind_ = left_ ? TimelineEvent::Kind::kStereo : TimelineEvent::Kind::kPanorama;
  for (std::uint64_t i = 0; i < events_.size(); ++i) steps_total_ += events_[i].kind == step_kind_;
}

void DatasetPlayerComponent::open_stereo(const StereoRecording& stereo, Colour colour) {
  const auto eye = [&](const char* frame_id, const auto& image_topic, const auto& info_topic,
                       const conversions::PairedCamera& geometry) {
    const auto& size = geometry.raw.pinhole;
    return Eye{{frame_id, context_.output(image_topic), size.width, size.height, colour},
               context_.output(info_topic),
               geometry};
  };
  left_.emplace(eye("stereo_left_optical", topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo,
                    conversions::left_camera(stereo.calibration, stereo.rectified)));
  right_.emplace(eye("stereo_right_optical", topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo,
                     conversions::right_camera(stereo.calibration, stereo.rectified)));
}

void DatasetPlayerComponent::say_what_is_played() const {
  const auto& log = context_.log();
  const auto seconds = static_cast<double>(events_[events_.size() - 1].stamp_ns - events_[0].stamp_ns) * 1e-9;
  std::string content;
  if (left_) {
    content += fmt::format(", stereo of {} x {} px {}, baseline {:.4f} m", left_->camera.width, left_->camera.height,
                           conversions::is_rectified(left_->geometry) && conversions::is_rectified(right_->geometry)
                               ? "(rectified)"
                               : "(raw)",
                           dataset_.stereo->rectified.baseline_m);
  }
  if (panorama_) content += fmt::format(", panorama of {} x {} px", panorama_->width, panorama_->height);
  log.info("{}: {}, {} frames in {:.2f} s{}{}", dataset_.directory.string(), dataset_.kind, steps_total_, seconds,
           content, (imu_ ? ", IMU" : std::string()) + (ground_truth_ ? ", ground truth" : ""));
  for (const auto& note : dataset_.notes) log.warn("{}", note);
}

std::optional<std::int64_t> DatasetPlayerComponent::next_stamp_ns() {
  if (next_ == events_.size()) return std::nullopt;
  return events_[next_].stamp_ns;
}

void DatasetPlayerComponent::emit() {
  if (next_ == events_.size()) return;
  const auto stamp_ns = events_[next_].stamp_ns;
  if (!is_placed_) publish_static_transforms(stamp_ns);
  load_ahead();
  for (; next_ < events_.size() && events_[next_].stamp_ns == stamp_ns; ++next_) {
    const auto [stamp, kind, index] = events_[next_];
    const Images images = std::move(ahead_.front());
    ahead_.pop_front();
    switch (kind) {
      case TimelineEvent::Kind::kGroundTruth:
        publish_ground_truth(dataset_.ground_truth[index], stamp_ns);
        break;
      case TimelineEvent::Kind::kImu:
        publish_imu(dataset_.imu->samples[index], stamp_ns);
        break;
      case TimelineEvent::Kind::kStereo:
        publish_stereo(stamp_ns, images);
        break;
      case TimelineEvent::Kind::kPanorama:
        if (images[0]) panorama_->images.publish(images[0]);
        break;
    }
    if (kind == step_kind_) ++steps_done_;
  }
  load_ahead();
  if (next_ == events_.size() && unreadable_ > 0) {
    context_.log().warn("{} of {} frames could not be read and were skipped", unreadable_, steps_total_);
  }
}

/// Loads the images of the next step in advance, so that decoding does not delay their publication.
void DatasetPlayerComponent::load_ahead() {
  for (std::uint64_t i = next_ + ahead_.size(); i < events_.size() && events_[i].stamp_ns == events_[next_].stamp_ns;
       ++i)
    ahead_.push_back(load(events_[i]));
}

void DatasetPlayerComponent::publish_static_transforms(std::int64_t stamp_ns) {
  is_placed_ = true;
  tf2_msgs::msg::TFMessage message;
  const auto place = [&](const std::string& frame_id, const Eigen::Isometry3d& base_from_camera) {
    message.transforms().push_back(conversions::to_static_transform(stamp_ns, "base_link", frame_id, base_from_camera));
  };
  if (left_) {
    place(left_->camera.frame_id, dataset_.stereo->base_from_left);
    place(right_->camera.frame_id, dataset_.stereo->base_from_right());
  }
  if (panorama_) place(panorama_->frame_id, dataset_.panorama->base_from_panorama);
  if (imu_) place(kImuFrame, dataset_.imu->base_from_imu);
  static_transforms_.publish(std::move(message));
}

void DatasetPlayerComponent::publish_imu(const ImuSample& sample, std::int64_t stamp_ns) {
  sensor_msgs::msg::Imu message;
  message.header().stamp(conversions::to_stamp(stamp_ns));
  message.header().frame_id(kImuFrame);
  message.orientation_covariance()[0] = -1.0;  // not measured, REP 145
  message.angular_velocity(conversions::to_vector3(sample.rate_rad_s));
  message.linear_acceleration(conversions::to_vector3(sample.acceleration_m_s2));
  for (const std::size_t diagonal : {0, 4, 8}) {
    message.angular_velocity_covariance()[diagonal] = dataset_.imu->rate_variance;
    message.linear_acceleration_covariance()[diagonal] = dataset_.imu->acceleration_variance;
  }
  imu_->publish(std::move(message));
}

void DatasetPlayerComponent::publish_ground_truth(const GroundTruthPose& pose, std::int64_t stamp_ns) {
  nav_msgs::msg::Odometry message;
  message.header().stamp(conversions::to_stamp(stamp_ns));
  message.header().frame_id("map");
  message.child_frame_id("base_link");
  message.pose().pose(conversions::to_pose(pose.map_from_base));
  // The velocity is not recorded, which is conventionally expressed by a huge variance.
  constexpr double kNotMeasured = 1e6;
  message.twist().covariance(conversions::to_array(kNotMeasured * vision::Matrix6d::Identity()));
  ground_truth_->publish(std::move(message));
}

void DatasetPlayerComponent::publish_stereo(std::int64_t stamp_ns, const Images& images) {
  const auto& [left, right] = images;
  if (!left || !right) return;
  for (auto* eye : {&*left_, &*right_}) {
    eye->infos.publish(conversions::to_camera_info(eye->geometry, stamp_ns, eye->camera.frame_id));
  }
  left_->camera.images.publish(left);
  right_->camera.images.publish(right);
}

DatasetPlayerComponent::Images DatasetPlayerComponent::load(const TimelineEvent& event) {
  if (event.kind == TimelineEvent::Kind::kPanorama) {
    const auto& frame = dataset_.panorama->frames[event.index];
    return {load(*panorama_, frame.image, event.stamp_ns), nullptr};
  }
  if (event.kind != TimelineEvent::Kind::kStereo) return {};
  const auto& frame = dataset_.stereo->frames[event.index];
  const auto left = load(left_->camera, frame.left, event.stamp_ns);
  return {left, left ? load(right_->camera, frame.right, event.stamp_ns) : nullptr};
}

/// Loads a file as an image message. Reports an unusable file and returns nullptr.
DatasetPlayerComponent::ImagePtr DatasetPlayerComponent::load(const Camera& camera, const std::filesystem::path& file,
                                                              std::int64_t stamp_ns) {
  const runtime::StageTimer timer(context_.times(), "decode");
  cv::Mat pixels;
  if (const auto problem = decoder_.decode(file, camera.colour, pixels)) {
    report_unreadable(*problem);
    return nullptr;
  }
  if (pixels.cols != camera.width || pixels.rows != camera.height) {
    report_unreadable(fmt::format("{}: is {} x {} px, the previous images are {} x {} px", file.string(), pixels.cols,
                                  pixels.rows, camera.width, camera.height));
    return nullptr;
  }
  const auto image = conversions::make_image(stamp_ns, camera.frame_id, conversions::encoding_of(pixels.type()),
                                             camera.width, camera.height);
  pixels.copyTo(conversions::pixels(*image));
  return image;
}

void DatasetPlayerComponent::report_unreadable(const std::string& what) {
  ++unreadable_;
  context_.log().warn_throttled("unreadable", "{}; frame skipped", what);
}

PANVO_REGISTER_COMPONENT(DatasetPlayerComponent)

}  // namespace panvo::dataset_player
