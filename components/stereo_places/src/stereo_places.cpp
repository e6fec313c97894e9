// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/stereo_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/stereo_places/view_overlap.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/image_check.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::Keypoint;
using landmarks::PanoramicLandmark;
using position_corrector::BasePose;
using position_corrector::LandmarkMatch;
using position_corrector::MatchState;
using position_corrector::PositionCorrection;

constexpr double kExpectedSigmas = 2.0;    // a sighting within agrees with the expected pose
constexpr double kExpected_m = 0.3;        // or within this
constexpr double kCommonError = 0.02;      // of the distance from the place
constexpr std::size_t kMinKeypoints = 30;  // a place with fewer points is not recognised anyway

/// Adds what all points of a place have in common, such as a bias of their depths: it does not average out, and grows with
/// the distance from the place.
BasePose with_common_errors(const BasePose& pose) {
  const double sigma_m = kCommonError * pose.landmark_from_base.translation().norm();
  BasePose wider = pose;
  wider.covariance.topLeftCorner<3, 3>() += sigma_m * sigma_m * Eigen::Matrix3d::Identity();
  return wider;
}

double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return vision::so3_log(a.linear().transpose() * b.linear()).norm();
}

}  // namespace

landmarks::DescriptionSettings view_settings(const ViewKeypointParameters& parameters) {
  // The tools for landmarks read the settings of a panorama's description; a view has only its histogram.
  auto settings = landmarks::description_settings(landmarks::DescriptionParameters{}, 1);
  settings["camera"] = "stereo";
  settings["upright_keypoints"] = landmarks::settings_text(parameters.upright);
  return settings;
}

StereoPlaces::StereoPlaces(const Parameters& parameters, const vision::RectifiedStereo& stereo,
                           const Eigen::Isometry3d& base_from_left,
                           std::shared_ptr<position_corrector::SpilledLandmarks> keypoints,
                           vision::StageObserver* observer)
    : parameters_(parameters),
      stereo_(stereo),
      base_from_left_(base_from_left),
      observer_(observer),
      picture_(stereo.camera),
      depths_(stereo),
      offset_(stereo,
              parameters.search.bearing_sigma_px * reduction(stereo.camera, parameters.keypoints) / stereo.camera.fx),
      keypoints_(std::move(keypoints)),
      library_(keypoints_),
      search_(parameters.search, stereo.camera, reduction(stereo.camera, parameters.keypoints), observer),
      run_(parameters.run) {}

bool StereoPlaces::add(PanoramicLandmark landmark) {
  if (library_.set_pose(landmark.id, landmark.map_from_base, landmark.covariance)) return false;
  keep(std::move(landmark));
  return true;
}

void StereoPlaces::keep(PanoramicLandmark landmark) {
  search_.add(landmark);
  keypoints_->put(landmark.id, landmark.keypoints);
  library_.add(std::move(landmark));
}

bool StereoPlaces::set_pose(const landmarks::LandmarkPose& pose) {
  return library_.set_pose(pose.id, pose.map_from_base, pose.covariance);
}

bool StereoPlaces::is_due(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base, double way_m) const {
  if (!last_) return true;
  const auto& rule = parameters_.rule;
  const bool is_set_back = stamp_ns < last_->stamp_ns;  // the clock: the time since the last view is unknown
  if (!is_set_back && static_cast<double>(stamp_ns - last_->stamp_ns) < rule.step_s * 1e9) return false;
  return way_m - last_->way_m >= rule.step_m ||
         turn_between(last_->odom_from_base, odom_from_base) >= rule.step_deg * vision::kDegree;
}

ViewResult StereoPlaces::step(const StereoView& view, std::uint32_t next_id) {
  ViewResult result;
  result.match.stamp_ns = view.stamp_ns;
  if (const auto fault = vision::find_fault(view.left)) {
    result.match.state = MatchState::kUnusable;
    result.match.reason = *fault;
    return result;
  }
  auto keypoints = [&] {
    const vision::Stage stage(observer_, "keypoints");
    return detect_view_keypoints(view.left, stereo_.camera, parameters_.keypoints);
  }();
  offset_.add(keypoints, view.odom_from_base * base_from_left_);
  const auto found = search(view, keypoints);
  result.match.candidates = found.candidates;
  result.match.kept_after_histogram = result.match.kept_after_large = found.verified;
  result.match.landmark_id = found.nearest;
  result.match.reason = found.reason;
  if (found.verified > 0) result.match.state = MatchState::kRejected;
  if (found.place) {
    recognise(view, *found.place, result);
  } else if (!run_.landmark(view.way_m)) {
    end_pass(result);
  }
  if (!found.place && is_new_place(view)) build(view, next_id, keypoints, result);
  last_ = Compared{view.stamp_ns, view.odom_from_base, view.way_m, std::move(keypoints)};
  return result;
}

SearchResult StereoPlaces::search(const StereoView& view, const std::vector<Keypoint>& keypoints) const {
  std::optional<ViewPrior> prior;
  if (view.pose.is_located) {
    prior = ViewPrior{view.pose.map_from_base * base_from_left_, vision::horizontal_sigma(view.pose.covariance),
                      std::sqrt(std::max(0.0, view.pose.covariance(vision::kYaw, vision::kYaw)))};
  }
  // An unexpected pose must be confirmed by a second sighting of the same place.
  const auto first = is_expected_ && view.pose.is_located ? std::nullopt : run_.landmark(view.way_m);
  return search_.find(keypoints, library_, prior, first, [&](std::uint32_t id) {
    const auto built = built_at_m_.find(id);
    return built == built_at_m_.end() || view.way_m - built->second >= parameters_.rule.leave_m;
  });
}

void StereoPlaces::recognise(const StereoView& view, const FoundPlace& place, ViewResult& result) {
  const auto& landmark = *place.landmark;
  const auto pose = position_corrector::to_base(place.pose, {landmark.base_from_panorama, base_from_left_});
  run_.add({view.stamp_ns, landmark.id, pose.landmark_from_base, view.odom_from_base, view.way_m},
           [&](std::uint32_t id) -> std::optional<Eigen::Isometry3d> {
             const auto* known = library_.find(id);
             return known == nullptr ? std::nullopt : std::optional(known->map_from_base);
           });
  auto& match = result.match;
  match.heading_rad = place.pose.heading_rad;
  match.inliers = place.inliers;
  match.reason = fmt::format("{} of {} matches agree (1e{:.0f} by chance)", place.evidence.agreeing,
                             place.evidence.matches, place.evidence.log10_expected);
  if (!run_.is_confirmed(view.pose.is_located)) {
    match.reason +=
        fmt::format("; sighting {} of a run over {:.1f} m, waiting for confirmation", run_.sightings(), run_.way_m());
    return;
  }
  match.state = MatchState::kLocked;
  match.pose = place.pose;
  if (pass_ && pass_->landmark_id != landmark.id) end_pass(result);
  if (!pass_ || pass_->inliers < match.inliers) pass_ = match;
  result.correction = correct(view, place, pose);
  set_reference(view.odom_from_base * base_from_left_ * place.pose.landmark_from_panorama.inverse(),
                library_.keypoints(landmark.id));
}

std::optional<PositionCorrection> StereoPlaces::correct(const StereoView& view, const FoundPlace& place,
                                                        const BasePose& pose) {
  const Eigen::Vector3d off =
      (place.landmark->map_from_base * pose.landmark_from_base).translation() - view.pose.map_from_base.translation();
  const double expected_m = std::max(kExpected_m, kExpectedSigmas * vision::horizontal_sigma(pose.covariance));
  is_expected_ = view.pose.is_located && off.head<2>().norm() < expected_m;
  const bool is_soon = corrected_at_m_ && view.way_m - *corrected_at_m_ < parameters_.rule.correction_m;
  if (is_expected_ && is_soon) return std::nullopt;
  corrected_at_m_ = view.way_m;
  PositionCorrection correction;
  correction.state = position_corrector::CorrectionState::kFull;
  correction.stamp_ns = view.stamp_ns;
  correction.landmark_id = place.landmark->id;
  correction.inliers = place.inliers;
  correction.pose = with_common_errors(pose);
  return correction;
}

void StereoPlaces::end_pass(ViewResult& result) {
  if (!pass_) return;
  result.passed = std::exchange(pass_, std::nullopt);
  result.passed->state = MatchState::kMatched;
  result.passed->reason.clear();
}

bool StereoPlaces::is_new_place(const StereoView& view) const {
  const Eigen::Isometry3d odom_from_view = view.odom_from_base * base_from_left_;
  const auto shares = [&] {
    return shared_view(reference_->points, stereo_.camera, reference_->odom_from_view.inverse() * odom_from_view);
  };
  if (reference_ && shares() >= parameters_.rule.min_shared) return false;
  const auto& rule = parameters_.rule;
  const auto near = library_.within(view.pose.map_from_base.translation(), rule.nearby_m);
  return std::none_of(near.begin(), near.end(), [&](const PanoramicLandmark* landmark) {
    const bool is_in_this_map = view.pose.is_located || built_at_m_.contains(landmark->id);
    return is_in_this_map &&
           turn_between(landmark->map_from_base, view.pose.map_from_base) < rule.nearby_deg * vision::kDegree;
  });
}

void StereoPlaces::build(const StereoView& view, std::uint32_t next_id, std::vector<Keypoint> keypoints,
                         ViewResult& result) {
  const vision::Stage stage(observer_, "build");
  const auto detected = keypoints.size();
  depths_.keep_measured(keypoints, view.left, view.right, offset_.px(), offset_.sigma_px());
  if (last_) {
    const Eigen::Isometry3d before_from_now =
        base_from_left_.inverse() * last_->odom_from_base.inverse() * view.odom_from_base * base_from_left_;
    keypoints = without_own_body(keypoints, last_->keypoints, before_from_now);
  }
  if (keypoints.size() < kMinKeypoints) {
    result.not_built =
        fmt::format("{} of {} keypoints have a point, {} needed", keypoints.size(), detected, kMinKeypoints);
    return;
  }
  PanoramicLandmark landmark;
  landmark.id = std::max(library_.next_id(), next_id);
  landmark.stamp_ns = view.stamp_ns;
  landmark.map_from_base = view.pose.map_from_base;
  landmark.covariance = view.pose.covariance;
  landmark.base_from_panorama = base_from_left_;
  landmark.description.histogram = grey_levels(view.left);
  landmark.keypoints = std::move(keypoints);
  landmark.thumbnail = picture_.draw(view.left);
  const Eigen::Isometry3d odom_from_view = view.odom_from_base * base_from_left_;
  set_reference(odom_from_view, landmark.keypoints);
  offset_.begin(landmark.keypoints, odom_from_view);
  built_at_m_[landmark.id] = view.way_m;
  keep(landmark);
  result.built = std::move(landmark);
}

void StereoPlaces::set_reference(const Eigen::Isometry3d& odom_from_view, const std::vector<Keypoint>& keypoints) {
  reference_ = Reference{{}, odom_from_view};
  for (const auto& keypoint : keypoints) {
    if (keypoint.has_point) reference_->points.push_back(keypoint.point_in_panorama.cast<double>());
  }
}

}  // namespace panvo::stereo_places
