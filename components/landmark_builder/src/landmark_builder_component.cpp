// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/time_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmark_builder/landmark_builder.hpp"
#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/landmarks/panorama_level.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/vision/panorama_watch.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::landmark_builder {

/// The algorithm's parameters, the seed and the names of the frames.
struct ComponentParameters : BuilderParameters {
  int description_seed = 1;
  std::string map_frame = "map";
  std::string base_frame = "base_link";

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(static_cast<JunctionDetectorParameters P::*>(&P::junction), "junction");
    field.group(static_cast<JunctionFilterParameters P::*>(&P::filter), "filter");
    field.group(static_cast<LandmarkRuleParameters P::*>(&P::rule), "rule");
    field.group(static_cast<TriangulationParameters P::*>(&P::triangulation), "triangulation");
    field.group(static_cast<landmarks::DescriptionParameters P::*>(&P::description), "description");
    field.group(static_cast<landmarks::KeypointParameters P::*>(&P::keypoints), "keypoints");
    field(static_cast<int P::*>(&P::neighbours), "neighbours", "1",
          "panoramas before and after a landmark's that triangulate its keypoints", 0, 20);
    field(static_cast<double P::*>(&P::max_neighbour_distance_m), "max_neighbour_distance_m", "m",
          "distance of the farthest of them from the landmark", 0.5, 50.0);
    field(static_cast<int P::*>(&P::thumbnail_quality), "thumbnail_quality", "1",
          "JPEG quality of a landmark's thumbnail; 0: no thumbnail", 0, 100);
    field(&P::description_seed, "description_seed", "",
          "seed of the measurement matrices; must be equal in all nodes that describe panoramas", 0, 1'000'000'000);
    field(&P::map_frame, "map_frame", "", "frame of the landmarks; without a localizer the odometry frame");
    field(&P::base_frame, "base_frame", "", "vehicle frame; /tf_static gives the extrinsics of the panoramic camera");
  }
};

/// panorama/image, odometry/binocular, /tf_static, landmarks/match -> landmarks, with the stamp of the panorama each
/// was built from. Also reads landmarks that others, such as a store, publish. With a localizer, odometry/enhanced and
/// landmarks/poses give the poses of vehicle and landmarks in the map; distances between panoramas always come from
/// stereo odometry, which does not jump; panorama/time_reference tells which stamps belong together.
class LandmarkBuilderComponent final : public runtime::Component {
 public:
  explicit LandmarkBuilderComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        settings_(landmarks::landmark_settings(parameters_.description, parameters_.keypoints,
                                               static_cast<std::uint64_t>(parameters_.description_seed))),
        timer_(context.times()),
        landmarks_(context.output(topics::kLandmarks)),
        transforms_(context),
        map_(context) {
    context.set_background();  // landmarks are not urgent, poses are
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_enhanced(*message); });
    context.input(topics::kPanoramaTimeReference, [this](const auto& message) { on_time_reference(*message); });
    context.input(topics::kVehicleMask, [this](const auto& message) { on_vehicle_mask(*message); });
    context.input(topics::kLandmarkMatch, [this](const auto& message) { on_match(*message); });
    context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    context.input(topics::kPanorama, [this](const auto& message) { on_panorama(message); });
    context.before_end([this] {
      if (builder_) publish(builder_->finish(map_.map()));
    });
  }

 private:
  struct Odometry {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
    vision::Matrix6d covariance;
  };

  static constexpr std::size_t kMaxOdometry = 2000;  // poses: of the panoramas that the builder keeps
  static constexpr std::size_t kMaxWaiting = 10;     // panoramas waiting for odometry
  static constexpr std::int64_t kMaxGap_ns = 1'000'000'000;

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) return;  // the other nodes refuse it as well
    landmarks::PanoramicLandmark landmark;
    landmark.id = message.id();
    landmark.stamp_ns = conversions::stamp_ns(message);
    landmark.map_from_base = *pose;
    landmark.covariance = conversions::to_matrix(message.pose().covariance());
    if (map_.map().is_other(landmark)) return;  // the other nodes refuse it, too
    map_.map().add(landmark);
  }

  void on_enhanced(const nav_msgs::msg::Odometry& message) {
    const auto map_from_base = conversions::to_isometry(message.pose().pose());
    const auto odometry = pose_at(conversions::stamp_ns(message));
    if (map_from_base && odometry) map_from_odom_ = *map_from_base * odometry->odom_from_base.inverse();
  }

  void on_time_reference(const sensor_msgs::msg::TimeReference& message) {
    panorama_ahead_ns_ = conversions::to_ns(message.time_ref()) - conversions::stamp_ns(message);
    is_clock_known_ = true;
    if (!builder_) return;
    builder_->set_clock_known();
    builder_->set_poses([this](std::int64_t stamp_ns) -> std::optional<Eigen::Isometry3d> {
      const auto pose = pose_at(in_odometry_time(stamp_ns));
      return pose ? std::optional(pose->odom_from_base) : std::nullopt;
    });
  }

  std::int64_t in_odometry_time(std::int64_t panorama_stamp_ns) const { return panorama_stamp_ns - panorama_ahead_ns_; }

  void on_vehicle_mask(const sensor_msgs::msg::Image& message) {
    if (const auto seen = conversions::grey(message)) seen_ = seen->clone();
    if (builder_) builder_->set_seen(level_.level_mask(seen_));
  }

  void on_match(const panvo_msgs::msg::LandmarkMatch& message) {
    const bool is_passed = message.state() == panvo_msgs::msg::LandmarkMatch_Constants::MATCHED;
    if (builder_ && message.landmark_id() != 0 && is_passed) builder_->recognised();
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
    if (order == vision::StampOrder::kSetBack) begin_anew();
    odometry_.push_back({stamp_ns, *pose, conversions::to_matrix(message.pose().covariance())});
    if (odometry_.size() > kMaxOdometry) odometry_.pop_front();
    work_off();
  }

  /// After the clock was set back: old stamps must not be mixed with new ones. The panoramas' clock may have been left as
  /// it was: the localizer searches its offset again, and tells it even if it is the same.
  void begin_anew() {
    is_clock_known_ = false;
    odometry_.clear();
    waiting_.clear();
    last_stamp_ns_.reset();
    builder_.reset();
  }

  void on_panorama(const std::shared_ptr<const sensor_msgs::msg::Image>& message) {
    waiting_.push_back(message);
    work_off();
    if (waiting_.size() <= kMaxWaiting) return;
    waiting_.pop_front();
    context_.log().warn_throttled("no odometry",
                                  "panoramas received, but nothing on {} for their stamps: no landmarks are built",
                                  context_.resolved_name(topics::kOdometryBinocular));
  }

  /// Processes the waiting panoramas whose pose is available.
  void work_off() {
    while (!waiting_.empty() && !odometry_.empty() &&
           in_odometry_time(conversions::stamp_ns(*waiting_.front())) <= odometry_.back().stamp_ns) {
      const auto message = waiting_.front();
      waiting_.pop_front();
      build(*message);
    }
  }

  void build(const sensor_msgs::msg::Image& message) {
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    if (last_stamp_ns_ && stamp_ns <= *last_stamp_ns_) {
      return context_.log().warn_throttled("stamp", "{}: stamp is not later than the previous one; panorama skipped",
                                           context_.resolved_name(topics::kPanorama));
    }
    const auto pose = pose_at(in_odometry_time(stamp_ns));
    if (!pose) {
      return context_.log().warn_throttled("no pose", "{} has no pose near a panorama's stamp; panorama skipped",
                                           context_.resolved_name(topics::kOdometryBinocular));
    }
    const auto pixels = conversions::grey_or_bgr(message);
    if (!pixels) {
      return context_.log().warn_throttled("unusable", "{} {}; no landmark", context_.resolved_name(topics::kPanorama),
                                           pixels.reason());
    }
    const cv::Mat& panorama = *pixels;
    const auto unlike_before = watch_.add(panorama);
    const auto no_content = landmarks::find_fault(panorama);
    if (const auto& fault = no_content ? no_content : unlike_before) {
      return context_.log().warn_throttled(*fault, "{}: {}; no landmark", context_.resolved_name(topics::kPanorama),
                                           *fault);
    }
    if (!make_builder(message, panorama.size())) return;
    if (panorama.size() != size_) {
      return context_.log().warn_throttled(
          "size", "{} changed its size from {} x {} to {} x {} px; restart if the camera was replaced",
          context_.resolved_name(topics::kPanorama), size_.width, size_.height, panorama.cols, panorama.rows);
    }
    last_stamp_ns_ = stamp_ns;
    publish(builder_->step({stamp_ns, level_.level(panorama), pose->odom_from_base, pose->covariance, map_from_odom_},
                           map_.map()));
  }

  void publish(const std::vector<landmarks::PanoramicLandmark>& built) {
    for (const auto& landmark : built) {
      const auto points = std::count_if(landmark.keypoints.begin(), landmark.keypoints.end(),
                                        [](const auto& keypoint) { return keypoint.has_point; });
      context_.log().info("landmark {}: {}, {} keypoints, {} of them triangulated", landmark.id,
                          landmark.is_junction ? "a junction" : "by distance", landmark.keypoints.size(), points);
      landmarks_.publish(landmarks::to_message(landmark, settings_, parameters_.map_frame));
    }
  }

  /// The pose interpolated between the two odometry messages around a stamp, with the covariance of the later one.
  std::optional<Odometry> pose_at(std::int64_t stamp_ns) const {
    const auto after = std::find_if(odometry_.begin(), odometry_.end(),
                                    [&](const Odometry& odometry) { return odometry.stamp_ns >= stamp_ns; });
    if (after == odometry_.end()) return std::nullopt;
    if (after->stamp_ns == stamp_ns) return *after;
    if (after == odometry_.begin() || after->stamp_ns - std::prev(after)->stamp_ns > kMaxGap_ns) return std::nullopt;
    const auto before = std::prev(after);
    const double share =
        static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
    return Odometry{stamp_ns, vision::interpolate(before->odom_from_base, after->odom_from_base, share),
                    after->covariance};
  }

  bool make_builder(const sensor_msgs::msg::Image& message, cv::Size size) {
    if (builder_) return true;
    const std::string& frame = message.header().frame_id();
    const auto base_from_panorama =
        transforms_.lookup(parameters_.base_frame, frame, "publish the extrinsics of the panoramic camera");
    if (!base_from_panorama) return false;
    level_ = landmarks::PanoramaLevel(*base_from_panorama);
    try {
      builder_.emplace(parameters_, static_cast<std::uint64_t>(parameters_.description_seed), level_.base_from_level(),
                       size, &timer_);
    } catch (const std::invalid_argument& error) {
      context_.log().warn_throttled("no builder", "no landmarks: {}", error.what());
      return false;
    }
    size_ = size;
    builder_->set_seen(level_.level_mask(seen_));
    if (is_clock_known_) builder_->set_clock_known();
    return true;
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  const landmarks::DescriptionSettings settings_;
  conversions::StageTimer timer_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> landmarks_;

  conversions::TransformListener transforms_;
  landmarks::MapListener map_;
  vision::PanoramaWatch watch_;
  std::optional<LandmarkBuilder> builder_;
  landmarks::PanoramaLevel level_;  // of the builder's panoramas
  cv::Size size_;
  cv::Mat seen_;                        // all but the vehicle; empty: unknown
  std::int64_t panorama_ahead_ns_ = 0;  // the panoramic camera's clock
  bool is_clock_known_ = false;
  vision::StampSequence stamps_;  // of the odometry
  std::deque<Odometry> odometry_;
  Eigen::Isometry3d map_from_odom_ = Eigen::Isometry3d::Identity();
  std::deque<std::shared_ptr<const sensor_msgs::msg::Image>> waiting_;
  std::optional<std::int64_t> last_stamp_ns_;
};

PANVO_REGISTER_COMPONENT(LandmarkBuilderComponent)

}  // namespace panvo::landmark_builder
