// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/lasting_calibration.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/position_corrector/correction_messages.hpp"
#include "panvo/position_corrector/match_messages.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/stereo_places/stereo_places.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::stereo_places {

struct ComponentParameters : Parameters {
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string spill_folder = "/var/tmp";

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(static_cast<PlaceRule P::*>(&P::rule), "rule");
    field.group(static_cast<ViewKeypointParameters P::*>(&P::keypoints), "keypoints");
    field.group(static_cast<SearchParameters P::*>(&P::search), "search");
    field.group(static_cast<RunParameters P::*>(&P::run), "run");
    field(&P::map_frame, "map_frame", "", "frame of the landmarks' poses");
    field(&P::base_frame, "base_frame", "", "vehicle frame; /tf_static must contain the pose of the left camera in it");
    field.path(&P::spill_folder, "spill_folder",
               "folder on a disk for an unnamed file of the landmarks' keypoints, 50 kB each; empty: keep in memory");
  }
};

/// stereo/{left,right}/image_rect with camera_info, odometry/binocular, odometry/enhanced, landmarks, landmarks/poses,
/// /tf_static -> landmarks, landmarks/match, correction. Images wait until odometry reaches their stamp.
class StereoPlacesComponent final : public runtime::Component {
 public:
  explicit StereoPlacesComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        settings_(view_settings(parameters_.keypoints)),
        timer_(context.times()),
        keypoints_(std::make_shared<position_corrector::SpilledLandmarks>(parameters_.spill_folder)),
        landmarks_(context.output(topics::kLandmarks)),
        match_(context.output(topics::kLandmarkMatch)),
        correction_(context.output(topics::kCorrection)),
        transforms_(context),
        map_(context, [this](const auto& moved) { on_moved(moved); }) {
    context.set_background();  // places are not urgent, poses are
    context.input(topics::kStereoLeftCameraInfo,
                  [this](const auto& info) { on_camera(left_, *info, topics::kStereoLeftCameraInfo); });
    context.input(topics::kStereoRightCameraInfo,
                  [this](const auto& info) { on_camera(right_, *info, topics::kStereoRightCameraInfo); });
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_enhanced(*message); });
    context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    context.input_pair(topics::kStereoLeftImageRect, topics::kStereoRightImageRect,
                       [this](const auto& left, const auto& right) { on_images(left, right); });
  }

 private:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;

  static constexpr std::size_t kMaxOdometry = 100;  // poses kept for late images
  static constexpr std::size_t kMaxWaiting = 10;    // pairs waiting for odometry
  static constexpr double kUnlocated_m = 50.0;      // less certain positions do not restrict the search

  struct Calibration {
    std::string frame_id;
    conversions::PairedCamera camera;
    bool operator==(const Calibration& other) const { return camera == other.camera; }
  };
  using Camera = conversions::LastingCalibration<Calibration>;
  struct Odometry {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
    vision::Matrix6d covariance;
    double way_m;
  };
  struct Enhanced {
    Eigen::Isometry3d map_from_odom;
    vision::Matrix6d covariance;  // of map_from_base
  };
  struct Pair {
    ImagePtr left, right;
  };

  void on_camera(Camera& camera, const sensor_msgs::msg::CameraInfo& info,
                 const interfaces::Topic<sensor_msgs::msg::CameraInfo>& topic) {
    const auto read = conversions::to_camera(info);
    if (!read) return context_.log().warn_throttled(topic.name, "{} {}", context_.resolved_name(topic), read.reason());
    camera.add({info.header().frame_id(), *read});  // the odometry reports publishers that disagree
  }

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    const auto read = landmarks::to_landmark(message, settings_);
    if (!read) {
      // the others know it: to them, a new place of this id would be that landmark
      last_skipped_id_ = std::max(last_skipped_id_, message.id());
      return context_.log().warn_throttled("landmark", "landmark {} {}; skipped", message.id(), read.reason());
    }
    if (map_.map().is_other(*read)) {
      return context_.log().warn_throttled("other", "landmark {}: its id is that of another one; skipped", read->id);
    }
    early_.push_back(*read);
    map_.map().add(early_.back());
    if (places_) take_early();
  }

  /// Landmarks that arrived before the calibration of the cameras.
  void take_early() {
    for (auto& landmark : std::exchange(early_, {})) {
      map_.map().add(landmark);  // it may have moved meanwhile
      try {
        places_->add(std::move(landmark));
      } catch (const std::invalid_argument& error) {
        context_.log().warn_throttled("library", "{}; skipped", error.what());
      }
    }
  }

  void on_moved(const std::vector<landmarks::LandmarkPose>& moved) {
    if (!places_) return;
    for (const auto& pose : moved) places_->set_pose(pose);
  }

  void on_enhanced(const nav_msgs::msg::Odometry& message) {
    const auto map_from_base = conversions::to_isometry(message.pose().pose());
    const auto* odometry = odometry_at(conversions::stamp_ns(message));
    if (!map_from_base || odometry == nullptr) return;
    enhanced_ = {*map_from_base * odometry->odom_from_base.inverse(),
                 conversions::to_matrix(message.pose().covariance())};
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) {
      return context_.log().warn_throttled("odometry", "{} {}", context_.resolved_name(topics::kOdometryBinocular),
                                           pose.reason());
    }
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    const auto order = stamps_.add(stamp_ns);
    if (order == vision::StampOrder::kNotLater) return;
    double way_m = 0.0;
    if (!odometry_.empty()) {
      const auto& last = odometry_.back();
      way_m = last.way_m + (pose->translation() - last.odom_from_base.translation()).norm();
    }
    if (order == vision::StampOrder::kSetBack) {  // the path goes on, what has a stamp is of the time before
      odometry_.clear();
      waiting_.clear();
    }
    odometry_.push_back({stamp_ns, *pose, conversions::to_matrix(message.pose().covariance()), way_m});
    if (odometry_.size() > kMaxOdometry) odometry_.pop_front();
    work_off();
  }

  void on_images(const ImagePtr& left, const ImagePtr& right) {
    for (auto [camera, image] : {std::pair(&left_, left.get()), std::pair(&right_, right.get())}) {
      camera->add_image([&size = *image](const Calibration& one) {
        return static_cast<int>(size.width()) == one.camera.rectified.width &&
               static_cast<int>(size.height()) == one.camera.rectified.height;
      });
    }
    waiting_.push_back({left, right});
    work_off();
    if (waiting_.size() <= kMaxWaiting) return;
    waiting_.pop_front();
    context_.log().warn_throttled("no odometry", "image pairs received, but nothing on {} for their stamps: no places",
                                  context_.resolved_name(topics::kOdometryBinocular));
  }

  void work_off() {
    while (!waiting_.empty() && !odometry_.empty() &&
           conversions::stamp_ns(*waiting_.front().left) <= odometry_.back().stamp_ns) {
      const Pair pair = std::exchange(waiting_.front(), {});
      waiting_.pop_front();
      // an unusable pair has no pose
      if (const auto* odometry = odometry_at(conversions::stamp_ns(*pair.left))) step(pair, *odometry);
    }
  }

  const Odometry* odometry_at(std::int64_t stamp_ns) const {
    const auto found = std::find_if(odometry_.rbegin(), odometry_.rend(),
                                    [&](const Odometry& odometry) { return odometry.stamp_ns <= stamp_ns; });
    return found == odometry_.rend() || found->stamp_ns != stamp_ns ? nullptr : &*found;
  }

  void step(const Pair& pair, const Odometry& odometry) {
    if (!places_ && !make_places()) return;
    if (!(*left_.used() == used_->first && *right_.used() == used_->second)) {
      return context_.log().warn_throttled("calibration changed",
                                           "{} or {} changed while running: no places; restart panvo",
                                           context_.resolved_name(topics::kStereoLeftCameraInfo),
                                           context_.resolved_name(topics::kStereoRightCameraInfo));
    }
    if (!places_->is_due(odometry.stamp_ns, odometry.odom_from_base, odometry.way_m)) return;
    const auto left = conversions::grey(*pair.left);
    const auto right = conversions::grey(*pair.right);
    if (!left || !right || left->size() != size_ || right->size() != size_) {
      return context_.log().warn_throttled("images", "{}: {}; no places",
                                           context_.resolved_name(topics::kStereoLeftImageRect),
                                           !left    ? left.reason()
                                           : !right ? right.reason()
                                                    : "the size is not that of camera_info");
    }
    publish(
        places_->step({odometry.stamp_ns, *left, *right, odometry.odom_from_base, odometry.way_m, pose_of(odometry)},
                      std::max(map_.map().next_id(), last_skipped_id_ + 1)),
        pair.left->header().frame_id());
  }

  /// In the map of the localizer; without one, in that of the odometry.
  MapPose pose_of(const Odometry& odometry) const {
    if (!enhanced_) {
      // the localizer, if there is one, has not said yet where the journey starts
      return {odometry.odom_from_base, odometry.covariance, !context_.has_publisher(topics::kOdometryEnhanced)};
    }
    const bool is_located = vision::horizontal_sigma(enhanced_->covariance) < kUnlocated_m;
    return {enhanced_->map_from_odom * odometry.odom_from_base, enhanced_->covariance, is_located};
  }

  void publish(const ViewResult& result, const std::string& frame_id) {
    if (result.passed) match_.publish(position_corrector::to_message(*result.passed, frame_id));
    match_.publish(position_corrector::to_message(result.match, frame_id));
    if (result.match.state == position_corrector::MatchState::kUnusable) {
      context_.log().warn_throttled(result.match.reason, "{} {}", context_.resolved_name(topics::kStereoLeftImageRect),
                                    result.match.reason);
    }
    if (!result.not_built.empty()) {
      context_.log().warn_throttled("no place", "no place here: {}", result.not_built);
    }
    if (result.correction) correction_.publish(position_corrector::to_message(*result.correction, frame_id));
    if (!result.built) return;
    if (!keypoints_->problem().empty()) {
      context_.log().warn_throttled("spill", "{}: keypoints of landmarks stay in memory", keypoints_->problem());
    }
    landmarks_.publish(landmarks::to_message(*result.built, settings_, parameters_.map_frame));
  }

  bool make_places() {
    const auto &left = left_.used(), &right = right_.used();
    if (!left || !right) return false;  // the odometry reports it
    const auto stereo = conversions::to_stereo(left->camera, right->camera);
    if (!stereo) return false;  // likewise
    const auto base_from_raw_left = transforms_.lookup(parameters_.base_frame, left->frame_id,
                                                       "publish the pose of the left camera on the vehicle");
    if (!base_from_raw_left) return false;
    const Eigen::Isometry3d raw_from_rectified(left->camera.rectified_from_raw.transpose());
    size_ = {stereo->camera.width, stereo->camera.height};
    used_ = {*left, *right};
    places_.emplace(parameters_, *stereo, *base_from_raw_left * raw_from_rectified, keypoints_, &timer_);
    take_early();
    return true;
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  const landmarks::DescriptionSettings settings_;
  conversions::StageTimer timer_;
  std::shared_ptr<position_corrector::SpilledLandmarks> keypoints_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> landmarks_;
  runtime::Output<panvo_msgs::msg::LandmarkMatch> match_;
  runtime::Output<panvo_msgs::msg::PositionCorrection> correction_;

  conversions::TransformListener transforms_;
  landmarks::MapListener map_;
  Camera left_, right_;
  cv::Size size_;
  std::optional<StereoPlaces> places_;
  std::optional<std::pair<Calibration, Calibration>> used_;  // for places_
  std::vector<landmarks::PanoramicLandmark> early_;
  std::uint32_t last_skipped_id_ = 0;  // the largest one
  vision::StampSequence stamps_;       // of the odometry
  std::deque<Odometry> odometry_;
  std::optional<Enhanced> enhanced_;
  std::deque<Pair> waiting_;
};

PANVO_REGISTER_COMPONENT(StereoPlacesComponent)

}  // namespace panvo::stereo_places
