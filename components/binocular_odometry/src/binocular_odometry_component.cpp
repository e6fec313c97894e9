// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "odometry_messages.hpp"
#include "panvo/binocular_odometry/tracking_stage.hpp"
#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/lasting_calibration.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"
#include "vehicle_motion.hpp"

namespace panvo::binocular_odometry {

/// Parameters of the algorithm, and frame names.
struct ComponentParameters : Parameters {
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_tf = false;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field.group(static_cast<TrackingParameters P::*>(&P::tracking), "tracking");
    field.group(static_cast<MotionParameters P::*>(&P::motion), "motion");
    field(&P::odom_frame, "odom_frame", "", "parent frame of the poses: base_frame at the first image");
    field(&P::base_frame, "base_frame", "",
          "frame whose motion is published; /tf_static must contain the pose of the left camera in it");
    field(&P::publish_tf, "publish_tf", "",
          "publish odom_frame -> base_frame on /tf; only in systems without a localizer, which publishes it too");
  }
};

/// stereo/{left,right}/image_rect with camera_info, and /tf_static -> odometry/binocular, odometry/quality,
/// odometry/points if anybody reads them, optionally /tf, with the image stamps. Tracking runs on the component's
/// thread, motion with the local bundle adjustment on a second one; in replay both run in sequence.
class BinocularOdometryComponent final : public runtime::Component {
 public:
  explicit BinocularOdometryComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        odometry_(context.output(topics::kOdometryBinocular)),
        quality_(context.output(topics::kOdometryQuality)),
        points_(context.output(topics::kOdometryPoints)),
        tracked_(context.stage<RigFrame>("motion", 2, [this](const RigFrame& seen) { on_tracked(seen); })),
        transforms_(context),
        motion_(parameters_.motion, &timer_) {
    if (parameters_.publish_tf) tf_.emplace(context.output(topics::kTf));
    context.input(topics::kStereoLeftCameraInfo,
                  [this](const auto& info) { on_camera(left_, *info, topics::kStereoLeftCameraInfo); });
    context.input(topics::kStereoRightCameraInfo,
                  [this](const auto& info) { on_camera(right_, *info, topics::kStereoRightCameraInfo); });
    context.input_pair(topics::kStereoLeftImageRect, topics::kStereoRightImageRect,
                       [this](const auto& left, const auto& right) { on_images(*left, *right); });
  }

 private:
  static constexpr double kStaleCalibration_px = 1.0;  // a good calibration has a few tenths
  static constexpr double kSameMount = 0.001;          // m and rad: mounts are not measured better

  /// Created when the cameras are known, and again when they change.
  struct Tracking {
    TrackingStage stage;
    std::shared_ptr<const StereoRig> rig;
    Eigen::Isometry3d base_from_raw_left;
  };

  struct Calibration {
    std::string frame_id;
    conversions::PairedCamera camera;
    bool operator==(const Calibration& other) const { return camera == other.camera; }
  };
  using Camera = conversions::LastingCalibration<Calibration>;

  void on_camera(Camera& camera, const sensor_msgs::msg::CameraInfo& info,
                 const interfaces::Topic<sensor_msgs::msg::CameraInfo>& topic) {
    const auto read = conversions::to_camera(info);
    if (!read) return context_.log().warn_throttled(topic.name, "{} {}", context_.resolved_name(topic), read.reason());
    if (!camera.add({info.header().frame_id(), *read})) return;
    context_.log().warn(
        "{} alternates between two calibrations: two publishers disagree. The one in use stays; stop one of "
        "them, or remap its topic",
        context_.resolved_name(topic));
  }

  void on_images(const sensor_msgs::msg::Image& left, const sensor_msgs::msg::Image& right) {
    const auto fits = [](const sensor_msgs::msg::Image& image) {
      return [&image](const Calibration& one) {
        return static_cast<int>(image.width()) == one.camera.rectified.width &&
               static_cast<int>(image.height()) == one.camera.rectified.height;
      };
    };
    if (Camera::add_images(left_, fits(left), right_, fits(right))) tracking_.reset();
    if (!tracking_ && !begin_tracking()) return;
    check_mount();
    const auto left_grey = conversions::grey(left);
    const auto right_grey = conversions::grey(right);
    if (!left_grey || !right_grey) {
      const auto& topic = left_grey ? topics::kStereoRightImageRect : topics::kStereoLeftImageRect;
      return context_.log().warn_throttled(topic.name, "{} {}; image pair skipped", context_.resolved_name(topic),
                                           left_grey ? right_grey.reason() : left_grey.reason());
    }
    tracked_.push({tracking_->stage.track({conversions::stamp_ns(left), *left_grey, *right_grey}), tracking_->rig});
  }

  void on_tracked(const RigFrame& seen) {
    const TrackedFrame& frame = seen.frame;
    if (frame.row_misalignment_px > kStaleCalibration_px) say_stale(frame.row_misalignment_px);
    const VehicleEstimate estimate = motion_.estimate(seen);
    const Quality& quality = estimate.of_left.quality;
    quality_.publish(to_quality(estimate.of_left, parameters_.base_frame));
    if (quality.reliable != was_reliable_) {
      was_reliable_ = quality.reliable;
      if (was_reliable_) {
        context_.log().info_throttled("reliable", "reliable again");
      } else {
        context_.log().warn_throttled("unreliable", "unreliable: {}", quality.reason);
      }
    }
    // For a late pair only the quality is published, no pose.
    if (frame.is_late) return;
    const auto odometry = to_odometry(estimate, last_stamp_ns_, parameters_.odom_frame, parameters_.base_frame);
    if (tf_) tf_->publish(to_transform(odometry));
    odometry_.publish(odometry);
    if (context_.has_reader(topics::kOdometryPoints)) {
      points_.publish(
          to_point_cloud(motion_.points(), motion_.odom_from_start(), frame.stamp_ns, parameters_.odom_frame));
    }
    last_stamp_ns_ = frame.stamp_ns;
  }

  /// Begins once both cameras and the pose of the left one are known; otherwise logs what is missing.
  bool begin_tracking() {
    const auto &left = left_.used(), &right = right_.used();
    if (!left || !right) {
      const auto& missing = left ? topics::kStereoRightCameraInfo : topics::kStereoLeftCameraInfo;
      context_.log().warn_throttled("no calibration", "images received, but no valid calibration on {} yet",
                                    context_.resolved_name(missing));
      return false;
    }
    const auto stereo = conversions::to_stereo(left->camera, right->camera);
    if (!stereo) {
      context_.log().warn_throttled("no stereo pair", "{} and {} do not form a stereo pair: {}",
                                    context_.resolved_name(topics::kStereoLeftCameraInfo),
                                    context_.resolved_name(topics::kStereoRightCameraInfo), stereo.reason());
      return false;
    }
    const auto base_from_raw_left = transforms_.lookup(parameters_.base_frame, left->frame_id,
                                                       "publish the pose of the left camera on the vehicle");
    if (!base_from_raw_left) return false;
    const Eigen::Isometry3d raw_from_rectified(left->camera.rectified_from_raw.transpose());
    auto rig = std::make_shared<const StereoRig>(StereoRig{*stereo, *base_from_raw_left * raw_from_rectified});
    tracking_.emplace(Tracking{TrackingStage(*stereo, parameters_, &timer_), std::move(rig), *base_from_raw_left});
    is_said_moved_ = false;
    if (was_tracking_) {
      context_.log().warn_throttled("calibration changed",
                                    "{} or {} changed while running: tracking restarts with the new calibration",
                                    context_.resolved_name(topics::kStereoLeftCameraInfo),
                                    context_.resolved_name(topics::kStereoRightCameraInfo));
    }
    was_tracking_ = true;
    return true;
  }

  /// A camera that moves on the vehicle while it drives cannot be told from one whose extrinsics were wrong before.
  void check_mount() {
    const auto& frame = left_.used()->frame_id;
    const auto now = transforms_.buffer().lookup(parameters_.base_frame, frame);
    if (is_said_moved_ || !now || vision::pose_error(tracking_->base_from_raw_left, *now).norm() < kSameMount) return;
    is_said_moved_ = true;
    context_.log().warn(
        "{} has another pose of {} on {} than when tracking began: it is used only when tracking restarts",
        context_.resolved_name(topics::kTfStatic), frame, parameters_.base_frame);
  }

  /// Logged once, because it persists while driving.
  void say_stale(double row_misalignment_px) {
    if (is_said_stale_) return;
    is_said_stale_ = true;
    context_.log().warn(
        "right image rows are {:.1f} px off the left ones: the calibration is stale or belongs to other cameras; "
        "compensating online. Recalibrate the pair.",
        row_misalignment_px);
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  runtime::Output<nav_msgs::msg::Odometry> odometry_;
  runtime::Output<panvo_msgs::msg::OdometryQuality> quality_;
  runtime::Output<sensor_msgs::msg::PointCloud2> points_;
  std::optional<runtime::Output<tf2_msgs::msg::TFMessage>> tf_;
  runtime::Stage<RigFrame> tracked_;

  conversions::TransformListener transforms_;
  Camera left_, right_;
  std::optional<Tracking> tracking_;
  bool was_tracking_ = false, is_said_moved_ = false;

  // State of the motion stage.
  VehicleMotion motion_;
  std::optional<std::int64_t> last_stamp_ns_;
  bool was_reliable_ = true;
  bool is_said_stale_ = false;
};

PANVO_REGISTER_COMPONENT(BinocularOdometryComponent)

}  // namespace panvo::binocular_odometry
