// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "odometry_trail.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/landmarks/panorama_level.hpp"
#include "panvo/position_corrector/correction_messages.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/position_corrector/match_messages.hpp"
#include "panvo/position_corrector/paper_correction.hpp"
#include "panvo/position_corrector/point_messages.hpp"
#include "panvo/position_corrector/position_correction.hpp"
#include "panvo/position_corrector/spilled_landmarks.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/vision/panorama_watch.hpp"

namespace panvo::position_corrector {

struct CorrectionParameters {
  std::string method = "metric";
  double stamp_sigma_ms = 3.0;
  PaperCorrectionParameters paper;

  template <class Field>
  static void describe(Field&& field) {
    using P = CorrectionParameters;
    field(
        &P::method, "method", "",
        "metric: six degrees of freedom from the landmark's points, for each panorama that shows it; paper: five-point "
        "motion at the nearest panorama [Lu2015 5.2]",
        {"metric", "paper"});
    field(&P::stamp_sigma_ms, "stamp_sigma_ms", "ms",
          "standard deviation of a panorama's stamp (arrival time), excluding a constant offset, "
          "which the localizer estimates; 0 with a common trigger",
          0.0, 1000.0);
    field.group(&P::paper, "paper");
  }
};

struct ComponentParameters {
  MatchingParameters matching;
  CorrectionParameters correction;
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  int description_seed = 1;
  bool use_position = true;
  std::string base_frame = "base_link";
  std::string spill_folder = "/var/tmp";

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(&P::matching, "matching");
    field.group(&P::correction, "correction");
    field.group(&P::description, "description");
    field.group(&P::keypoints, "keypoints");
    field(&P::description_seed, "description_seed", "",
          "seed of the measurement matrices; must be equal in all nodes that describe panoramas", 0, 1'000'000'000);
    field(&P::use_position, "use_position", "",
          "search only near the odometry position; false: always search the whole library");
    field(&P::base_frame, "base_frame", "", "vehicle frame; /tf_static gives the extrinsics of the panoramic camera");
    field.path(&P::spill_folder, "spill_folder",
               "folder on a disk for an unnamed file of the landmarks, 48 kB each; empty: keep in memory");
  }
};

/// panorama/image, panorama/vehicle_mask, odometry/binocular, landmarks, landmarks/poses, /tf_static -> landmarks/match,
/// correction, landmarks/match_points. Each panorama gets a match message, which states the reason if nothing matched. A correction
/// follows if a landmark was locked or rejected by geometry, with the matched points if anybody reads them.
class PositionCorrectorComponent final : public runtime::Component {
 public:
  explicit PositionCorrectorComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        describer_(parameters_.description, static_cast<std::uint64_t>(parameters_.description_seed)),
        settings_(landmarks::landmark_settings(parameters_.description, parameters_.keypoints,
                                               static_cast<std::uint64_t>(parameters_.description_seed))),
        stored_(std::make_shared<SpilledLandmarks>(parameters_.spill_folder)),
        library_(stored_, describer_.basis().limits()),
        map_(context, [this](const auto& moved) { on_moved(moved); }),
        matcher_(parameters_.matching, parameters_.keypoints, describer_, &timer_),
        match_(context.output(topics::kLandmarkMatch)),
        correction_(context.output(topics::kCorrection)),
        points_(context.output(kLandmarkPoints)),
        transforms_(context) {
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kVehicleMask, [this](const auto& message) { on_vehicle_mask(*message); });
    context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    context.input(topics::kPanorama, [this](const auto& message) { on_panorama(*message); });
  }

 private:
  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    const auto read = landmarks::to_landmark(message, settings_);
    if (!read) return context_.log().warn_throttled(read.reason(), "a landmark {}; skipped", read.reason());
    auto landmark = *read;
    if (map_.map().is_other(landmark)) {
      return context_.log().warn_throttled(fmt::format("landmark {}", landmark.id),
                                           "landmark {}: its id is that of another one; skipped", landmark.id);
    }
    map_.map().add(landmark);
    // a landmark that is received again may have an updated pose
    if (library_.set_pose(landmark.id, landmark.map_from_base, landmark.covariance)) return;
    stored_->put(landmark.id, landmark.keypoints, landmark.description);
    if (!stored_->problem().empty()) {
      context_.log().warn_throttled("spill", "{}: landmarks stay in memory", stored_->problem());
    }
    try {
      matcher_.added(library_.add(std::move(landmark)));
    } catch (const std::invalid_argument& error) {
      context_.log().warn_throttled("library", "{}; skipped", error.what());
    }
  }

  void on_moved(const std::vector<landmarks::LandmarkPose>& moved) {
    for (const auto& pose : moved) library_.set_pose(pose.id, pose.map_from_base, pose.covariance);
  }

  void on_vehicle_mask(const sensor_msgs::msg::Image& message) {
    const auto seen = conversions::grey(message);
    if (!seen) return;
    seen_ = seen->clone();
    matcher_.set_seen(level_.level_mask(seen_));
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose) {
      return context_.log().warn_throttled("odometry", "{} {}", context_.resolved_name(topics::kOdometryBinocular),
                                           pose.reason());
    }
    const auto covariance = conversions::to_matrix(message.pose().covariance());
    const auto& linear = message.twist().twist().linear();
    const auto& angular = message.twist().twist().angular();
    OdometrySample sample{
        conversions::stamp_ns(message), {pose->translation(), vision::horizontal_sigma(covariance)}, {}};
    sample.twist << linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z();
    if (!sample.twist.allFinite()) {
      return context_.log().warn_throttled("twist", "{} has a twist that is not finite",
                                           context_.resolved_name(topics::kOdometryBinocular));
    }
    trail_.add(sample);
  }

  void on_panorama(const sensor_msgs::msg::Image& message) {
    const auto panorama = conversions::grey(message);
    if (!panorama) {
      return context_.log().warn_throttled("panorama", "{} {}", context_.resolved_name(topics::kPanorama),
                                           panorama.reason());
    }
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    const auto here = trail_.at(stamp_ns);
    if (!here && parameters_.use_position && !library_.empty()) {
      context_.log().warn_throttled("no odometry", "nothing on {} yet: the whole library is searched",
                                    context_.resolved_name(topics::kOdometryBinocular));
    }
    if (!library_.empty()) set_extrinsics(message.header().frame_id());
    PanoramaFrame frame;
    frame.stamp_ns = stamp_ns;
    frame.panorama = level_.level(*panorama);
    if (here) frame.travelled_m = here->travelled_m;
    if (here && parameters_.use_position) frame.prior = here->prior;
    const auto fault = watch_.add(*panorama);
    const bool is_unlike_before = fault && !landmarks::find_fault(*panorama);
    const auto match = is_unlike_before ? unusable(stamp_ns, *fault) : matcher_.match(frame, library_);
    match_.publish(to_message(match, message.header().frame_id()));
    if (!match.points.empty() && context_.has_reader(kLandmarkPoints)) {
      points_.publish(to_point_cloud(match, message.header().frame_id(), level_.panorama_from_level()));
    }
    if (match.state == MatchState::kMatched) {
      context_.log().info("landmark {} passed, heading {:+.1f} deg relative to the landmark", match.landmark_id,
                          match.heading_rad * 180.0 / M_PI);
    } else if (match.state == MatchState::kUnusable) {
      context_.log().warn_throttled(match.reason, "{} {}", context_.resolved_name(topics::kPanorama), match.reason);
    }
    if (const auto correction = correction_of(match)) {
      correction_.publish(to_message(*correction, message.header().frame_id()));
    }
  }

  static LandmarkMatch unusable(std::int64_t stamp_ns, const std::string& fault) {
    LandmarkMatch match;
    match.stamp_ns = stamp_ns;
    match.state = MatchState::kUnusable;
    match.reason = fault;
    return match;
  }

  std::optional<PositionCorrection> correction_of(const LandmarkMatch& match) {
    const auto* landmark = library_.find(match.landmark_id);
    if (landmark == nullptr) return std::nullopt;
    const Mountings mountings{landmark->base_from_panorama,
                              has_extrinsics_ ? level_.base_from_level() : landmark->base_from_panorama};
    const bool is_paper = parameters_.correction.method == "paper";
    std::optional<PositionCorrection> correction;
    if (!is_paper || match.state == MatchState::kRejected) {
      correction = metric_correction(match, mountings);
    } else if (match.state == MatchState::kMatched) {
      const vision::Stage stage(&timer_, "five_point");
      correction =
          paper_correction(match, library_.keypoints(match.landmark_id), mountings, parameters_.correction.paper);
    }
    if (!correction) return std::nullopt;
    if (const auto then = trail_.at(correction->stamp_ns)) {
      correction->pose =
          with_uncertain_stamp(correction->pose, then->twist, 1e-3 * parameters_.correction.stamp_sigma_ms);
    }
    return correction;
  }

  void set_extrinsics(const std::string& panorama_frame) {
    const auto base_from_panorama =
        transforms_.lookup(parameters_.base_frame, panorama_frame, "using the extrinsics stored with the landmark");
    if (!base_from_panorama) return;
    if (has_extrinsics_ && base_from_panorama->matrix() == level_.base_from_panorama().matrix()) return;
    has_extrinsics_ = true;
    level_ = landmarks::PanoramaLevel(*base_from_panorama);
    matcher_.set_seen(level_.level_mask(seen_));
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  const landmarks::PanoramaDescriber describer_;
  const landmarks::DescriptionSettings settings_;
  std::shared_ptr<SpilledLandmarks> stored_;
  landmarks::LandmarkLibrary library_;
  landmarks::MapListener map_;
  vision::PanoramaWatch watch_;
  LandmarkMatcher matcher_;
  runtime::Output<panvo_msgs::msg::LandmarkMatch> match_;
  runtime::Output<panvo_msgs::msg::PositionCorrection> correction_;
  runtime::Output<sensor_msgs::msg::PointCloud2> points_;

  conversions::TransformListener transforms_;
  bool has_extrinsics_ = false;     // level_ has those of /tf_static
  landmarks::PanoramaLevel level_;  // of the matcher's panoramas
  cv::Mat seen_;                    // all but the vehicle; empty: unknown
  OdometryTrail trail_;
};

PANVO_REGISTER_COMPONENT(PositionCorrectorComponent)

}  // namespace panvo::position_corrector
