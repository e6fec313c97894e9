// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/localizer.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/localizer/soundness.hpp"
#include "panvo/vision/angle.hpp"

/// Processing of landmark sightings and external poses.
namespace panvo::localizer {
namespace {

constexpr double kStampSigma_s = 0.01;     // of an image's arrival stamp, in addition to the clock's offset
constexpr double kCameraFromBase_m = 1.0;  // from base_link, about which the vehicle turns in the landmark's frame
constexpr double kUnsaidYaw_rad = 3.0;
// For the components left open by an external pose: a click on a flat map.
constexpr double kUnsaidHeight_m = 10.0;
constexpr double kUnsaidTilt_rad = 0.2;
constexpr double kDriftRatio = 0.03;  // two landmarks agree within the drift between them

}  // namespace

Correction Localizer::add(const LandmarkSighting& received) {
  Correction correction;
  const auto rejected = [&](std::string reason) {
    correction.kind = CorrectionKind::kRejected;
    correction.reason = std::move(reason);
    return correction;
  };
  if (const auto fault = fault_of(received.landmark_from_base, received.covariance)) return rejected(*fault);
  const LandmarkSighting timed = with_uncertain_clock(received);
  const LandmarkSighting sighting = with_uncertain_mount(timed);
  const auto at = chain_.at(in_odometry_time(sighting.stamp_ns));
  if (!at) return rejected("no odometry stored for that time");
  const auto landmark = graph_.landmark(sighting.landmark_id);
  if (!landmark) return rejected(fmt::format("landmark {} is not known", sighting.landmark_id));
  correction.map_from_base_before = correction.map_from_base_after = graph_.carried(*at).map_from_base;
  mounting_.add(timed, *at);  // the path along a pass shows the mounting, wherever the landmark is
  const Verdict verdict = judge(sighting, *landmark, *at);
  correction.chi_square = verdict.chi_square;
  if (!verdict.objection.empty()) {
    take(verdict);
    return rejected(verdict.objection);
  }

  const bool was_unknown = !is_located_ || localized(chain_.latest()).state == State::kLost;
  const bool joins = !is_joined_ && graph_.is_known(sighting.landmark_id);
  LocalPoseGraph corrected = graph_;
  if (verdict.cut_ns) corrected.cut(*verdict.cut_ns);
  if (joins) {
    const Eigen::Isometry3d measured = landmark->map_from_base * sighting.landmark_from_base;
    corrected.place(measured * correction.map_from_base_before.inverse());
  }
  if (!corrected.add_pass(sighting, *at, parameters_.same_pass_m)) {
    if (verdict.cut_ns) return rejected("contradicts a more precise panorama of the same pass");
    take(verdict);
    correction.kind = CorrectionKind::kBetterKnown;
    correction.reason = "a panorama of the same pass is more precise";
    return correction;
  }
  if (!corrected.solve()) return rejected("the pose graph could not be solved");
  graph_ = std::move(corrected);
  take(verdict);
  if (joins) is_located_ = is_joined_ = true;
  doubtful_ns_.reset();
  conflicting_.reset();  // doubts about an earlier one are not confirmed by this one
  if (was_unknown || joins) found_at_way_m_ = at->way_m;
  if (!azimuth_ns_) check_.confirm_pose(at->pose.stamp_ns);  // with a compass, the panoramas decide
  correction.kind = CorrectionKind::kApplied;
  correction.map_from_base_after = graph_.carried(*at).map_from_base;
  if (joins) {
    check_.add_correction(at->pose.stamp_ns);
  } else {
    check_.add_place({at->pose.stamp_ns, verdict.off_m, vision::horizontal_sigma(sighting.covariance),
                      graph_.is_known(sighting.landmark_id) ? INT64_MIN : landmark->stamp_ns});
  }
  latest_ = localized(chain_.latest());
  return correction;
}

/// Adds what errors of the stamps make of the pose: the motion of the vehicle in that time, now and when the landmark was
/// built. An offset of the clock displaces both alike: of a landmark of this journey that is seen again in the same
/// direction, nothing of it is left, unless the clock was stepped in between; a landmark of an earlier journey was not
/// displaced.
LandmarkSighting Localizer::with_uncertain_clock(const LandmarkSighting& sighting) const {
  LandmarkSighting wider = sighting;
  const auto twist = chain_.twist(in_odometry_time(sighting.stamp_ns));
  if (!twist) return wider;
  const Eigen::Isometry3d& seen = sighting.landmark_from_base;
  wider.velocity_m_s = twist->head<3>();
  vision::Vector6d moved;
  moved << seen.linear() * twist->head<3>(), seen.linear() * twist->tail<3>();
  const auto built = built_twists_.find(sighting.landmark_id);
  if (built != built_twists_.end() && !is_clock_doubtful_) {
    const Eigen::Vector3d then = built->second.head<3>(), turning = built->second.tail<3>();
    moved.head<3>() -= then + turning.cross(seen.translation());
    moved.tail<3>() -= turning;
  }
  const double sigma_s = clock_sigma_s();
  wider.covariance += sigma_s * sigma_s * moved * moved.transpose() +
                      2.0 * vision::stamp_covariance(seen, *twist, std::min(sigma_s, kStampSigma_s));
  if (!is_clock_known()) wider.covariance += by_time(*chain_.at(in_odometry_time(sighting.stamp_ns)), last_set_s_);
  return wider;
}

double Localizer::clock_sigma_s() const {
  return is_clock_doubtful_ ? kUnknownClock_s : std::sqrt(clock_.variance_s2());
}

/// What the offset of the clock adds to a position, in the map.
vision::Matrix6d Localizer::by_clock(const Eigen::Vector3d& velocity_m_s) const {
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = std::pow(clock_sigma_s(), 2) * velocity_m_s * velocity_m_s.transpose();
  return covariance;
}

/// Adds what a panoramic camera that was rotated on its mount since the landmark was built makes of the pose.
LandmarkSighting Localizer::with_uncertain_mount(const LandmarkSighting& sighting) const {
  const double turned_rad = mounts_.turned_rad(sighting.landmark_id);
  LandmarkSighting wider = sighting;
  wider.covariance(vision::kYaw, vision::kYaw) += turned_rad * turned_rad;
  wider.covariance.topLeftCorner<2, 2>() += std::pow(kCameraFromBase_m * turned_rad, 2) * Eigen::Matrix2d::Identity();
  return wider;
}

bool Localizer::set_initial_pose(const PoseInMap& pose, std::int64_t stamp_ns) {
  const auto at = chain_.at(stamp_ns);
  if (!at || !pose.map_from_base.matrix().allFinite() || !pose.covariance.allFinite()) return false;
  PoseInMap said = pose;
  vision::Vector6d unsaid_sigma;
  unsaid_sigma << kUnsaidHeight_m, kUnsaidHeight_m, kUnsaidHeight_m, kUnsaidTilt_rad, kUnsaidTilt_rad, kUnsaidYaw_rad;
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (said.covariance(i, i) == 0.0) said.covariance(i, i) = unsaid_sigma(i) * unsaid_sigma(i);
  }
  if (fault_of(said.map_from_base, said.covariance)) return false;
  LocalPoseGraph corrected = graph_;
  if (is_located_ && is_joined_ && !graph_.has_only_start()) {
    corrected.cut(at->pose.stamp_ns);
  } else {
    corrected.place(said.map_from_base * graph_.carried(*at).map_from_base.inverse());
  }
  corrected.set_initial_pose(said, *at);
  if (!corrected.solve()) return false;
  graph_ = std::move(corrected);
  is_located_ = is_joined_ = true;
  doubtful_ns_.reset();
  asking_.reset();
  conflicting_.reset();
  check_.add_correction(at->pose.stamp_ns);
  found_at_way_m_ = at->way_m;
  latest_ = localized(chain_.latest());
  return true;
}

/// Whether a sighting is to be applied. Changes nothing: see take().
Localizer::Verdict Localizer::judge(const LandmarkSighting& sighting, const KnownLandmark& landmark,
                                    const OdometrySample& at) const {
  Verdict verdict;
  verdict.dissent = conflicting_;
  const Eigen::Isometry3d measured = landmark.map_from_base * sighting.landmark_from_base;
  const bool is_placed = is_joined_ || !graph_.is_known(sighting.landmark_id);
  if (is_placed) {
    auto here = graph_.carried(at);
    if (graph_.is_known(sighting.landmark_id)) here.covariance += graph_.since_known(at);
    const vision::Vector6d error = vision::pose_error(here.map_from_base, measured);
    const vision::Matrix6d spread =
        here.covariance + vision::compose_covariance(landmark.map_from_base, landmark.covariance,
                                                     sighting.landmark_from_base, sighting.covariance);
    verdict.chi_square = error.dot(spread.ldlt().solve(error));
    verdict.off_m = error.head<2>().norm();
  }
  const bool is_expected = is_placed && verdict.chi_square <= parameters_.gate_chi_square;
  if (is_expected && sighting.stands_alone) {
    verdict.dissent.reset();
    return verdict;
  }
  const bool is_far = is_placed && sighting.stands_alone;
  const PendingRelocalization now{
      sighting, measured * at.pose.odom_from_base.inverse(), at.way_m, verdict.off_m, is_far, at.pose.stamp_ns};
  verdict.asking = now;
  const bool is_confirmed = asking_ && confirms(now, *asking_);
  if (is_far) return judge_far(std::move(verdict), now, is_confirmed);
  if (sighting.stands_alone) {
    const bool is_vouched_for = asking_ && vouches(*asking_, now);
    if (!is_confirmed && !is_vouched_for)
      verdict.objection = "first sighting, waiting for confirmation by a second view";
  } else if (!is_placed) {
    verdict.objection = "low-inlier match, and the expected position is unknown";
  } else if (!is_expected) {
    verdict.objection = "low-inlier match, and outside the gate";
  } else if (!is_confirmed) {
    verdict.objection = "low-inlier match, waiting for confirmation by the next panorama";
  } else {
    verdict.dissent.reset();
  }
  return verdict;
}

/// For a sighting outside the gate. Odometry errs beyond the second gate only if it missed a motion of the vehicle. But
/// a misplaced landmark would look the same: two landmarks must agree.
Localizer::Verdict Localizer::judge_far(Verdict verdict, const PendingRelocalization& now, bool is_confirmed) const {
  const auto far = fmt::format("chi-square {:.0f}, gate {:.0f}", verdict.chi_square, parameters_.gate_chi_square);
  if (!is_confirmed) {
    verdict.objection = far + ": waiting for confirmation by a second view";
    return verdict;
  }
  if (verdict.chi_square <= parameters_.second_look_gate_ratio * parameters_.gate_chi_square) return verdict;
  const bool is_other = conflicting_ && conflicting_->sighting.landmark_id != now.sighting.landmark_id;
  if (!is_other || !agree(*conflicting_, now)) {
    verdict.dissent = now;
    verdict.objection = far + ": waiting for confirmation by a second landmark";
    return verdict;
  }
  verdict.asking.reset();
  verdict.cut_ns = std::min(doubtful_ns_.value_or(now.at_ns), now.at_ns);  // the sighting shows the vehicle after it
  return verdict;
}

void Localizer::take(const Verdict& verdict) {
  asking_ = verdict.asking;
  conflicting_ = verdict.dissent;
}

/// Whether a sighting repeats an earlier one of the same pass. One of few points does not confirm one that stands alone.
bool Localizer::confirms(const PendingRelocalization& now, const PendingRelocalization& before) const {
  const bool is_weaker = now.sighting.stands_alone && !before.sighting.stands_alone;
  return !is_weaker && before.sighting.landmark_id == now.sighting.landmark_id && follows(now, before);
}

/// Whether another place, seen shortly before and recognised by many points, gives the same pose.
bool Localizer::vouches(const PendingRelocalization& before, const PendingRelocalization& now) const {
  return before.sighting.stands_alone && before.sighting.landmark_id != now.sighting.landmark_id &&
         follows(now, before);
}

/// Whether a sighting comes soon after another one and gives the same pose.
bool Localizer::follows(const PendingRelocalization& now, const PendingRelocalization& before) const {
  return before.sighting.stamp_ns < now.sighting.stamp_ns &&
         std::abs(now.way_m - before.way_m) < parameters_.same_pass_m && agree(before, now);
}

/// Whether two sightings give the same pose of odom in the map, except for the drift between them.
bool Localizer::agree(const PendingRelocalization& before, const PendingRelocalization& now) const {
  const auto at = chain_.at(in_odometry_time(now.sighting.stamp_ns));
  if (!at) return false;
  const auto apart =
      vision::pose_error(before.map_from_odom * at->pose.odom_from_base, now.map_from_odom * at->pose.odom_from_base);
  const double drift_m = kDriftRatio * std::abs(now.way_m - before.way_m);
  return apart.head<3>().norm() < parameters_.second_look_m + drift_m &&
         apart.tail<3>().norm() < parameters_.second_look_deg * vision::kDegree;
}

}  // namespace panvo::localizer
