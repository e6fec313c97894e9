// SPDX-License-Identifier: Apache-2.0
#include "satellites.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "georeference_file.hpp"
#include "localizer_messages.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/service.hpp"
#include "robot_localization/srv/FromLL.h"
#include "robot_localization/srv/ToLL.h"

namespace panvo::localizer {
namespace {

using namespace robot_localization::srv;  // NOLINT(google-build-using-namespace): the requests and responses

constexpr interfaces::Service<FromLL_Request, FromLL_Response> kFromLL{"fromLL"};
constexpr interfaces::Service<ToLL_Request, ToLL_Response> kToLL{"toLL"};
constexpr double kFarthest_m = 100e3;  // from the first position: no vehicle's day
constexpr double kNotableScale = 0.003;
constexpr double kSureSigmas = 4.0;
constexpr std::int64_t kKeepPeriod_ns = 10'000'000'000;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Satellites::Satellites(runtime::Context& context, const ComponentParameters& parameters, Localizer& localizer)
    : context_(context),
      parameters_(parameters),
      localizer_(localizer),
      transforms_(context),
      enhanced_(context.output(topics::kGnssEnhanced)),
      tf_(context.output(topics::kTf)) {
  context.input(topics::kGnssFix, [this](const auto& message) { on_fix(*message); });
  serve();
  if (!parameters.georeference_file.empty()) read_georeference();
}

void Satellites::on_fix(const sensor_msgs::msg::NavSatFix& message) {
  if (!parameters_.use_gnss || base_frame_.empty()) return;
  const auto position = to_position(message, altitude_m_);
  if (!position) return refuse(position.reason());
  const auto base_from_antenna =
      antenna_.find(context_.resolved_name(topics::kGnssFix), base_frame_, message.header().frame_id(), transforms_,
                    context_.log(), "the antenna is at " + base_frame_);
  if (!base_from_antenna) return refuse(base_from_antenna.reason());
  altitude_m_ = position->point.altitude_m;
  if (!plane_) plane_.emplace(position->point);
  const double far_m = plane_->enu(position->point).norm();
  if (far_m < kFarthest_m) {
    far_.reset();
  } else if (!begins_anew(position->point)) {
    return refuse(fmt::format("is {:.0f} km from the first position", 1e-3 * far_m));
  }
  waiting_.push_back({conversions::stamp_ns(message), plane_->enu(position->point), position->covariance,
                      base_from_antenna->translation()});
  if (waiting_.size() > kMaxWaiting) {
    waiting_.pop_front();
    refuse("has a stamp far ahead of the odometry's: are the clocks synchronised?");
  }
}

/// For a position far from the first one. A second one there shows that the first one was wrong, such as the last one
/// of a receiver that was carried away switched off; unless the odometry or an earlier journey confirmed it.
bool Satellites::begins_anew(const vision::GeoPoint& point) {
  const bool is_second = far_ && far_->enu(point).norm() < kFarthest_m;
  far_.emplace(point);
  if (!is_second || is_origin_known_ || localizer_.has_enu()) return false;
  plane_ = std::exchange(far_, std::nullopt);
  waiting_.clear();
  localizer_.forget_trial_of_fixes();
  return true;
}

bool Satellites::work_off() {
  bool has_learned = false;
  for (auto fix = waiting_.begin(); fix != waiting_.end();) {
    if (localizer_.latest().stamp_ns < fix->stamp_ns) {
      ++fix;  // a single wrong stamp does not hold up the others
      continue;
    }
    const auto outcome = localizer_.add(*fix);
    fix = waiting_.erase(fix);
    tell(outcome);
    has_learned |= outcome.use == FixUse::kUsed || outcome.use == FixUse::kBegun;
  }
  return has_learned;
}

void Satellites::tell(const FixOutcome& outcome) {
  const auto topic = context_.resolved_name(topics::kGnssFix);
  if (outcome.use == FixUse::kBegun) {
    context_.log().info("{}: agrees with the odometry; used from now on", topic);
  } else if (outcome.use == FixUse::kOnTrial && !outcome.reason.empty()) {
    context_.log().warn_throttled("gnss trial", "{} is not used: {}", topic, outcome.reason);
  } else if (outcome.use == FixUse::kRejected) {
    context_.log().warn_throttled("gnss rejected", "{}: a position is not used: {}", topic, outcome.reason);
  }
  const double excess = localizer_.scale().value - 1.0;
  const bool is_sure = std::abs(excess) > kSureSigmas * localizer_.scale().sigma;
  if (has_told_scale_ || !localizer_.has_enu() || std::abs(excess) < kNotableScale || !is_sure) return;
  has_told_scale_ = true;
  context_.log().warn(
      "by satellites, the stereo odometry measures {:.1f} % too {}; compensated: calibrate the stereo camera",
      100.0 * std::abs(excess), excess > 0.0 ? "far" : "short");
}

void Satellites::publish(std::int64_t stamp_ns, const std::string& base_frame) {
  base_frame_ = base_frame;
  if (!localizer_.has_enu()) return;
  enhanced_.publish(to_fix(localizer_.latest_in_enu(), *plane_, stamp_ns, base_frame));
  geometry_msgs::msg::TransformStamped transform;
  transform.header().stamp(conversions::to_stamp(stamp_ns));
  // As a child: the map may have another parent, such as the frame of a fleet.
  transform.header().frame_id(parameters_.map_frame);
  transform.child_frame_id(parameters_.enu_frame);
  transform.transform(conversions::to_transform(localizer_.map_from_enu().map_from_base));
  tf2_msgs::msg::TFMessage message;
  message.transforms().push_back(std::move(transform));
  tf_.publish(std::move(message));
  keep_georeference(localizer_.latest());
}

void Satellites::read_georeference() {
  const auto& file = parameters_.georeference_file;
  context_.about_to_read(file);
  try {
    const auto known = localizer::read_georeference(file);
    if (!known) return;
    if (known->map_frame != parameters_.map_frame) {
      return context_.log().warn("{}: ignored: of frame '{}'", file, known->map_frame);
    }
    plane_.emplace(known->origin);
    altitude_m_ = known->origin.altitude_m;
    is_origin_known_ = true;
    localizer_.set_known_enu(known->map_from_enu);
    context_.log().info("{}: in the stored map, positions by satellites show where the vehicle is", file);
  } catch (const std::runtime_error& error) {
    context_.log().warn("{}", error.what());
  }
}

void Satellites::keep_georeference(const LocalizedPose& pose) {
  const bool is_known = pose.state == State::kTracking || pose.state == State::kRelocalised;
  if (parameters_.georeference_file.empty() || !is_known) return;
  if (kept_ns_ && std::abs(pose.stamp_ns - *kept_ns_) < kKeepPeriod_ns) return;
  kept_ns_ = pose.stamp_ns;
  try {
    write_georeference(parameters_.georeference_file,
                       {parameters_.map_frame, plane_->origin(), localizer_.map_from_enu()});
  } catch (const std::runtime_error& error) {
    context_.log().warn_throttled("georeference", "{}", error.what());
  }
}

/// Before there are positions by satellites, the answer is NaN: the services have no field for an error.
void Satellites::serve() {
  context_.serve(kFromLL, [this](const FromLL_Request& request) {
    const auto& asked = request.ll_point();
    Eigen::Vector3d point = Eigen::Vector3d::Constant(kUnknown);
    if (localizer_.has_enu()) {
      const double altitude_m = std::isfinite(asked.altitude()) ? asked.altitude() : plane_->origin().altitude_m;
      point = localizer_.map_from_enu().map_from_base * plane_->enu({asked.latitude(), asked.longitude(), altitude_m});
    }
    FromLL_Response response;
    response.map_point().x(point.x());
    response.map_point().y(point.y());
    response.map_point().z(point.z());
    return response;
  });
  context_.serve(kToLL, [this](const ToLL_Request& request) {
    vision::GeoPoint point{kUnknown, kUnknown, kUnknown};
    const auto& asked = request.map_point();
    if (localizer_.has_enu())
      point = plane_->geodetic(localizer_.map_from_enu().map_from_base.inverse() *
                               Eigen::Vector3d(asked.x(), asked.y(), asked.z()));
    ToLL_Response response;
    response.ll_point().latitude(point.latitude_deg);
    response.ll_point().longitude(point.longitude_deg);
    response.ll_point().altitude(point.altitude_m);
    return response;
  });
}

void Satellites::refuse(const std::string& reason) {
  const auto topic = context_.resolved_name(topics::kGnssFix);
  if (context_.rejections().add(topic, reason)) context_.log().warn("{} {}; message skipped", topic, reason);
}

}  // namespace panvo::localizer
