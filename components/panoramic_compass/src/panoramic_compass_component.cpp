// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/stage_timer.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_listener.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/vision/panorama_tilt.hpp"
#include "panvo/vision/panorama_watch.hpp"
#include "panvo/vision/stamp_sequence.hpp"
#include "panvo/vision/vehicle_mask.hpp"
#include "point_messages.hpp"

namespace panvo::panoramic_compass {

/// Parameters of the algorithm, and the vehicle frame.
struct ComponentParameters : CompassParameters {
  int seed = 1;
  std::string base_frame = "base_link";
  bool learn_vehicle_mask = true;
  std::string vehicle_mask;

  template <class Field>
  static void describe(Field&& field) {
    using P = ComponentParameters;
    field(static_cast<std::string P::*>(&P::method), "method", "",
          "all_round: fits rotation and direction of motion to points on all sides, relative to a reference kept over "
          "several panoramas; two_patches: front and rear patch of the paper, between consecutive panoramas "
          "[Lu2015 6]",
          {"all_round", "two_patches"});
    field(static_cast<double P::*>(&P::max_turn_deg), "max_turn_deg", "deg",
          "search range on each side between consecutive panoramas; 30: 150 deg/s at 5 Hz", 1.0, 180.0);
    field.group(static_cast<PatchParameters P::*>(&P::patches), "patches");
    field.group(static_cast<PointParameters P::*>(&P::points), "points");
    field.group(static_cast<AgreementParameters P::*>(&P::agreement), "agreement");
    field(&P::seed, "seed", "", "seed of the random measurement matrices", 0, 1'000'000'000);
    field(&P::base_frame, "base_frame", "",
          "vehicle frame; /tf_static must contain the rotation of the panoramic camera in it");
    field(&P::learn_vehicle_mask, "learn_vehicle_mask", "",
          "learn where the panorama shows the vehicle itself: what stays in the picture while the odometry turns");
    field.path(&P::vehicle_mask, "vehicle_mask",
               "picture of the whole panorama in any size, black where it shows the vehicle, instead of learning; "
               "empty: none");
  }
};

/// panorama/image, /tf_static, odometry/binocular -> compass/azimuth_change, one message per panorama except the first,
/// also after the clock was set back; invalid ones state the reason; compass/points, if read; panorama/vehicle_mask.
/// Odometry is used to learn the mask only.
class PanoramicCompassComponent final : public runtime::Component {
 public:
  explicit PanoramicCompassComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<ComponentParameters>()),
        timer_(context.times()),
        azimuth_change_(context.output(topics::kAzimuthChange)),
        points_(context.output(topics::kPanoramaPoints)),
        mask_output_(context.output(topics::kVehicleMask)),
        transforms_(context) {
    context.input(topics::kPanorama, [this](const auto& message) { on_panorama(message); });
    make_compass(upright_base_from_panorama());
    if (!parameters_.vehicle_mask.empty()) {
      set_seen(read_mask());
    } else if (learns_mask()) {
      context.input(topics::kOdometryBinocular, [this](const auto& message) { on_odometry(*message); });
    }
  }

 private:
  static constexpr std::int64_t kMaxApart_ns = 500'000'000;  // heading and panorama: a vehicle turns by some degrees

  void make_compass(const Eigen::Matrix3d& base_from_panorama) {
    base_from_panorama_ = base_from_panorama;
    try {
      compass_.emplace(parameters_, static_cast<std::uint64_t>(parameters_.seed), base_from_panorama, &timer_);
      if (!seen_.empty()) compass_->set_seen(seen_);
    } catch (const std::invalid_argument& error) {
      throw runtime::ConfigError(context_.name() + ": " + error.what());
    }
  }

  cv::Mat read_mask() const {
    context_.about_to_read(parameters_.vehicle_mask);
    const cv::Mat mask = cv::imread(parameters_.vehicle_mask, cv::IMREAD_GRAYSCALE);
    if (mask.empty()) {
      throw runtime::ConfigError(
          fmt::format("{}: vehicle_mask: {} cannot be read as a picture", context_.name(), parameters_.vehicle_mask));
    }
    return vision::to_cells(mask);
  }

  /// A panorama's heading is the first one at or after its stamp, so that a live run learns as its replay does.
  void on_odometry(const nav_msgs::msg::Odometry& message) {
    const auto pose = conversions::to_isometry(message.pose().pose());
    if (!pose || !to_learn_ || conversions::stamp_ns(message) < conversions::stamp_ns(*to_learn_)) return;
    const auto panorama_message = std::exchange(to_learn_, nullptr);
    const std::int64_t stamp_ns = conversions::stamp_ns(*panorama_message);
    if (conversions::stamp_ns(message) - stamp_ns > kMaxApart_ns) return;
    const Eigen::Vector3d ahead = pose->linear().col(0);
    const double yaw_rad = std::atan2(ahead.y(), ahead.x());
    if (!mask_.wants(stamp_ns, yaw_rad)) return;
    const auto panorama = conversions::grey_or_bgr(*panorama_message);
    if (find_fault(*panorama)) return;
    if (mask_.add(stamp_ns, *panorama, yaw_rad)) set_seen(mask_.seen());
  }

  bool learns_mask() const { return parameters_.learn_vehicle_mask && parameters_.vehicle_mask.empty(); }

  /// Waits for a heading, unless an earlier one does.
  void learn_from(const std::shared_ptr<const sensor_msgs::msg::Image>& message) {
    if (!learns_mask()) return;
    const bool is_waited_for =
        to_learn_ && conversions::stamp_ns(*message) - conversions::stamp_ns(*to_learn_) <= kMaxApart_ns;
    if (!is_waited_for) to_learn_ = message;
  }

  void set_seen(const cv::Mat& seen) {
    seen_ = seen.clone();
    compass_->set_seen(seen_);
    const auto message = conversions::make_image(last_stamp_ns_.value_or(0), "", "mono8", seen_.cols, seen_.rows);
    seen_.copyTo(conversions::pixels(*message));
    mask_output_.publish(message);
  }

  void on_panorama(const std::shared_ptr<const sensor_msgs::msg::Image>& shared) {
    const sensor_msgs::msg::Image& message = *shared;
    const std::int64_t stamp_ns = conversions::stamp_ns(message);
    const auto order = stamps_.add(stamp_ns);
    if (order == vision::StampOrder::kNotLater) {
      return context_.log().warn_throttled("stamp", "{}: stamp not later than the previous one; panorama skipped",
                                           context_.resolved_name(topics::kPanorama));
    }
    if (order == vision::StampOrder::kSetBack) begin_anew();
    const auto panorama = conversions::grey_or_bgr(message);
    if (!panorama) {
      return context_.log().warn_throttled("unusable", "{} {}; panorama skipped",
                                           context_.resolved_name(topics::kPanorama), panorama.reason());
    }
    const auto before_ns = std::exchange(last_stamp_ns_, stamp_ns);
    take_mounting(message.header().frame_id());
    if (const auto fault = watch_.add(*panorama); fault && before_ns && !find_fault(*panorama)) {
      return tell({.from_stamp_ns = *before_ns, .stamp_ns = stamp_ns, .reason = "the panorama " + *fault},
                  message.header().frame_id());
    }
    learn_from(shared);
    const bool has_point_reader = context_.has_reader(topics::kPanoramaPoints);
    if (has_point_reader) compass_->keep_earlier_points();
    const auto change = compass_->track(stamp_ns, *panorama);
    if (has_point_reader) points_.publish(to_message(stamp_ns, compass_->points(), message.header().frame_id()));
    if (change) return tell(*change, message.header().frame_id());
    if (const auto fault = find_fault(*panorama)) {
      context_.log().warn_throttled(*fault, "{} {}", context_.resolved_name(topics::kPanorama), *fault);
    }
  }

  /// The clock was set back: no turn since a panorama of the time before has a meaning.
  void begin_anew() {
    last_stamp_ns_.reset();
    to_learn_ = nullptr;
    make_compass(base_from_panorama_);
  }

  /// Recreates the compass if the camera mounting in /tf_static differs from the current one.
  void take_mounting(const std::string& frame) {
    const auto base_from_panorama =
        transforms_.lookup(parameters_.base_frame, frame, "assuming an upright, forward-looking panoramic camera");
    if (!base_from_panorama || base_from_panorama->linear().isApprox(base_from_panorama_, 1e-9)) return;
    make_compass(base_from_panorama->linear());
    if (vision::tilt_of_panorama(base_from_panorama_) != vision::PanoramaTilt::kOnItsSide) return;
    context_.log().warn(
        "{} lies on its side in {}: turns are uncertain, and places are recognised at one heading only. If the camera "
        "stands upright, /tf_static must have its optical frame: x right, y down, z ahead",
        frame, parameters_.base_frame);
  }

  void tell(const AzimuthChange& change, const std::string& frame) {
    panvo_msgs::msg::AzimuthChange message;
    message.header().stamp(conversions::to_stamp(change.stamp_ns));
    message.header().frame_id(frame);
    message.from_stamp(conversions::to_stamp(change.from_stamp_ns));
    message.azimuth_change_rad(change.change_rad);
    message.variance_rad2(change.variance_rad2);
    message.side_parallax_rad(change.side_parallax_rad);
    message.motion_azimuth_rad(change.motion_azimuth_rad);
    message.motion_azimuth_variance_rad2(change.motion_azimuth_variance_rad2);
    message.valid(change.valid);
    message.reason(change.reason);
    azimuth_change_.publish(std::move(message));
    if (!change.valid && is_valid_) context_.log().warn_throttled("no turn", "no valid turn: {}", change.reason);
    if (change.valid && !is_valid_) context_.log().info_throttled("turns", "turns are valid again");
    is_valid_ = change.valid;
  }

  runtime::Context& context_;
  const ComponentParameters parameters_;
  conversions::StageTimer timer_;
  runtime::Output<panvo_msgs::msg::AzimuthChange> azimuth_change_;
  runtime::Output<panvo_msgs::msg::PanoramaPoints> points_;
  runtime::Output<sensor_msgs::msg::Image> mask_output_;

  conversions::TransformListener transforms_;
  Eigen::Matrix3d base_from_panorama_;
  vision::PanoramaWatch watch_;
  std::optional<PanoramicCompass> compass_;
  std::shared_ptr<const sensor_msgs::msg::Image> to_learn_;  // until its heading is known
  vision::VehicleMask mask_;
  cv::Mat seen_;                  // empty: nothing is known of the vehicle
  vision::StampSequence stamps_;  // of the panoramas
  std::optional<std::int64_t> last_stamp_ns_;
  bool is_valid_ = true;
};

PANVO_REGISTER_COMPONENT(PanoramicCompassComponent)

}  // namespace panvo::panoramic_compass
