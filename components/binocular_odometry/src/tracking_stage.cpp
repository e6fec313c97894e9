// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/tracking_stage.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "coarse_turn.hpp"
#include "disparity_offset.hpp"
#include "front_end.hpp"
#include "motion_model.hpp"
#include "motion_ransac.hpp"
#include "pair_check.hpp"
#include "panvo/vision/patch_template.hpp"
#include "panvo/vision/stereo_geometry.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "swap_check.hpp"
#include "track.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::PatchTemplate;
using vision::Stage;

constexpr double kReachPerLevel_px = 6.0;  // half a patch: beyond, alignment may lock on to another structure
constexpr size_t kScouts = 60;             // seed tracks for the coarse motion, with a margin for outliers
constexpr double kAstray_px = 3.0;         // deviation from the coarse motion above which a track is searched again
constexpr double kFarOff_px = 6.0;         // deviation after that above which a track is dropped
constexpr double kFarthestDisparity_px = -1.0;  // infinity, with a margin for calibration errors
constexpr double kLargestZoom = 1.5;            // of a patch relative to its host, before a new host is chosen
constexpr double kCrowded_px = 8;               // nearer tracks share the same patch
constexpr double kNoiseFloor_px = 0.15;         // interpolation, calibration, non-planar surfaces
constexpr int kGuideInliers = 8;                // minimum for a coarse motion
constexpr double kEnough = 0.9;                 // of max_features: above, no new features are detected
constexpr double kGuideRatio = 0.4;             // minimum ratio of inliers to candidates

vision::StereoMatcher::Range disparity_range(const vision::RectifiedStereo& stereo,
                                             const TrackingParameters& parameters) {
  return {kFarthestDisparity_px, stereo.camera.fx / parameters.nearest_depth_baselines};
}

}  // namespace

class TrackingStage::Implementation {
 public:
  Implementation(const vision::RectifiedStereo& stereo, const Parameters& parameters, vision::StageObserver* observer)
      : stereo_(stereo),
        parameters_(parameters.tracking),
        motion_parameters_(parameters.motion),
        observer_(observer),
        check_(stereo.camera),
        matcher_(stereo.camera, disparity_range(stereo, parameters_), parameters_.smallest_correlation),
        swap_check_(stereo.camera, disparity_range(stereo, parameters_), parameters_.smallest_correlation),
        alignment_(stereo.camera),
        front_end_(make_front_end(parameters_)),
        cell_px_(static_cast<int>(std::ceil(
            std::sqrt(static_cast<double>(stereo.camera.width) * stereo.camera.height / parameters_.max_features)))) {}

  TrackedFrame track(const StereoFrame& frame) {
    TrackedFrame result;
    result.stamp_ns = frame.stamp_ns;
    row_errors_.clear();
    result.fault = check(frame);
    if (!result.fault.empty()) return result;
    build_pyramids(frame);
    describe();

    const DisparityOffset known_offset = offset_;

    // Seed tracks are searched in a wide area first; their coarse motion predicts the positions of the others.
    std::vector<Track> tracks;
    auto motion = follow_widely(kScouts, tracks);
    if (!motion && has_tracks()) {  // possibly a jerk: retry all tracks from the global image shift
      expected_motion_.linear() = coarse_turn(stereo_.camera, *previous_left_, *left_);
      motion = follow_widely(tracks_.size(), tracks);
    }
    if (!motion && has_tracks()) {  // or the predicted translation is wrong: retry without it, to recover
      const Eigen::Vector3d expected = expected_motion_.translation();
      expected_motion_.translation().setZero();
      motion = follow_widely(tracks_.size(), tracks);
      if (!motion) expected_motion_.translation() = expected;
    }
    Eigen::Isometry3d current_from_previous = expected_motion_;
    if (motion) {
      match_others(tracks, *motion);
      current_from_previous = learn_offset(tracks, *motion);
    } else {
      tracks.clear();  // no consistent motion: restart with new tracks
    }
    result.tracked = static_cast<int>(tracks.size());
    const int seen_by_both = with_disparity(tracks);
    guide_from_current_ = guide_from_previous_ * current_from_previous.inverse();
    thin_out(tracks);
    renew_hosts(tracks);
    detect(tracks);
    result.detected = static_cast<int>(tracks.size());
    result.matched = with_disparity(tracks);
    result.fault = check_for_swap(tracks).value_or("");
    if (result.fault.empty()) result.fault = find_disagreement(result.tracked, seen_by_both).value_or("");
    if (!result.fault.empty()) {
      offset_ = known_offset;
      return result;
    }

    align_eyes();
    result.row_misalignment_px = alignment_.misalignment().largest_row_shift_px(stereo_.camera);
    result.disparity_offset_px = offset_.px();
    for (const Track& track : tracks) result.observations.push_back(track.seen);
    keep(frame.stamp_ns, std::move(tracks), motion ? &current_from_previous : nullptr);
    return result;
  }

 private:
  std::string check(const StereoFrame& frame) {
    const Stage stage(observer_, "check");
    const auto fault = check_.find_fault(frame);
    check_.remember(frame);
    // If a recording restarts, only its first frame is lost.
    const std::int64_t before_ns = std::exchange(last_stamp_ns_, frame.stamp_ns);
    if (std::exchange(seen_any_, true) && frame.stamp_ns <= before_ns) {
      return "stamp " + std::to_string(frame.stamp_ns) + " ns is not later than the previous stamp, " +
             std::to_string(before_ns) + " ns";
    }
    if (fault) return *fault;
    // Time since the last good frame; after a jump back in time, the previous interval is kept.
    if (frame.stamp_ns > good_stamp_ns_) interval_ns_ = frame.stamp_ns - good_stamp_ns_;
    expected_motion_ = has_tracks() ? motion_model_.predict(interval_ns_) : Eigen::Isometry3d::Identity();
    return {};
  }

  bool has_tracks() const { return !tracks_.empty(); }

  void build_pyramids(const StereoFrame& frame) {
    const Stage stage(observer_, "pyramid");
    left_ = std::make_shared<const vision::ImagePyramid>(frame.left, parameters_.pyramid_levels);
    right_ = vision::ImagePyramid(frame.right, std::min(2, parameters_.pyramid_levels));
  }

  void describe() {
    const Stage stage(observer_, "describe");
    front_end_->describe(*left_);
  }

  std::optional<Eigen::Isometry3d> follow_widely(size_t count, std::vector<Track>& tracks) {
    tracks = match_widely(count);
    return coarse_motion(tracks);
  }

  // Matches about `count` tracks over all pyramid levels; the rest become others_.
  std::vector<Track> match_widely(size_t count) {
    const Stage stage(observer_, "match_widely");
    const Eigen::Isometry3d current_from_guide = expected_motion_ * guide_from_previous_.inverse();
    const size_t stride = std::max<size_t>(1, tracks_.size() / std::max<size_t>(1, count));
    std::vector<Track> found;
    others_.clear();
    for (size_t i = 0; i < tracks_.size(); ++i) {
      Track track = tracks_[i];
      const auto expected =
          i % stride == 0 ? expect(stereo_, track, current_from_guide * track.guide_from_host) : std::nullopt;
      const auto where = expected ? front_end_->match(track, expected->pixel) : std::nullopt;
      if (where && align(track, *expected, *where)) {
        found.push_back(std::move(track));
      } else {
        others_.push_back(tracks_[i]);
      }
    }
    for (Track& track : found) match_left_right(track);
    return found;
  }

  // From coarse to fine; levels where alignment fails (near the border, no texture) are skipped.
  bool align(Track& track, const ExpectedPatch& expected, const Whereabouts& where) const {
    const Eigen::Matrix2d host_from_current = expected.current_from_host.inverse();
    Eigen::Vector2d pixel = where.pixel;
    for (int level = std::min(where.level, left_->levels() - 1); level >= 0; --level) {
      const double scale = 1 << level;
      const auto patch = PatchTemplate::sample((*track.host)[level], track.host_pixel / scale, host_from_current);
      const auto found =
          patch ? patch->align((*left_)[level], pixel / scale, PatchTemplate::Search::kPlane, kReachPerLevel_px)
                : std::nullopt;
      if (found) pixel = found->position * scale;
      if (level > 0) continue;
      if (!found || found->correlation < parameters_.smallest_correlation) return false;
      track.seen.sigma_px = std::sqrt(kNoiseFloor_px * kNoiseFloor_px + 0.5 * found->variance.sum());
    }
    track.seen.pixel.head<2>() = pixel;
    track.seen.pixel.z() = expected.disparity_px + offset_.px();
    track.gradient = expected.gradient;
    return true;
  }

  void match_left_right(Track& track) const {
    const Eigen::Vector2d pixel = track.seen.pixel.head<2>();
    const auto match = matcher_.refine(*left_, right_, pixel, track.seen.pixel.z(), track.gradient);
    track.seen.has_disparity = match.has_value();
    if (match) take(*match, track);
  }

  static void take(const vision::StereoMatch& match, Track& track) {
    track.seen.has_disparity = true;
    track.seen.pixel.z() = match.disparity_px;
    track.seen.sigma_disparity_px = std::sqrt(kNoiseFloor_px * kNoiseFloor_px + match.variance_px2);
    track.gradient = match.gradient;
  }

  // Tracks with a disparity in the last good frame.
  std::vector<SeenTwice> seen_twice(const std::vector<Track>& tracks) const {
    std::vector<SeenTwice> points;
    auto known = tracks_.begin();
    for (const Track& track : tracks) {
      while (known->id < track.id) ++known;  // both ascend, and every track is in tracks_
      if (known->seen.has_disparity) points.push_back({known->seen, track.seen});
    }
    return points;
  }

  // Coarse motion of the tracking stage: only used to predict feature positions.
  std::optional<Eigen::Isometry3d> coarse_motion(const std::vector<Track>& tracks) const {
    const Stage stage(observer_, "coarse_motion");
    std::vector<PointPair> pairs;
    for (const auto& [previous, current] : seen_twice(tracks)) {
      pairs.push_back({offset_.without(previous.pixel), offset_.without(current.pixel), current.has_disparity});
    }
    const std::array guesses{expected_motion_, Eigen::Isometry3d::Identity()};
    const auto motion = estimate_motion(stereo_, pairs, guesses, motion_parameters_);
    if (!motion || motion->inliers < kGuideInliers) return std::nullopt;
    if (static_cast<double>(motion->inliers) < kGuideRatio * static_cast<double>(pairs.size())) return std::nullopt;
    return motion->current_from_previous;
  }

  // Refines the coarse motion with all tracks and updates the disparity offset.
  Eigen::Isometry3d learn_offset(const std::vector<Track>& tracks, const Eigen::Isometry3d& current_from_previous) {
    const Stage stage(observer_, "learn_offset");
    std::vector<SeenTwice> points = seen_twice(tracks);
    std::erase_if(points, [](const SeenTwice& point) { return !point.current.has_disparity; });
    return offset_.learn(stereo_, points, current_from_previous);
  }

  // Matches the remaining tracks at the positions predicted by the coarse motion, and seed tracks that deviate from it
  // again.
  void match_others(std::vector<Track>& tracks, const Eigen::Isometry3d& current_from_previous) {
    const Stage stage(observer_, "match_others");
    const Eigen::Isometry3d current_from_guide = current_from_previous * guide_from_previous_.inverse();
    std::vector<Track> kept;
    for (Track& track : tracks) {
      const auto expected = expect(stereo_, track, current_from_guide * track.guide_from_host);
      if (!expected) continue;
      const bool is_astray = (expected->pixel - track.seen.pixel.head<2>()).norm() > kAstray_px;
      if (!is_astray || find(track, *expected)) kept.push_back(std::move(track));
    }
    for (Track& track : others_) {
      const auto expected = expect(stereo_, track, current_from_guide * track.guide_from_host);
      if (expected && find(track, *expected)) kept.push_back(std::move(track));
    }
    std::sort(kept.begin(), kept.end(), [](const Track& a, const Track& b) { return a.id < b.id; });
    tracks.swap(kept);
  }

  // The coarse motion is accurate to about a pixel: full resolution finds nearly all tracks, half resolution the rest.
  bool find(Track& track, const ExpectedPatch& expected) const {
    if (!align(track, expected, {expected.pixel, 0}) && !align(track, expected, {expected.pixel, 1})) return false;
    if ((track.seen.pixel.head<2>() - expected.pixel).norm() > kFarOff_px) return false;
    match_left_right(track);
    return true;
  }

  static void thin_out(std::vector<Track>& tracks, cv::Size size) {
    vision::CellGrid grid(size, static_cast<int>(kCrowded_px));
    std::erase_if(tracks, [&grid](const Track& track) {  // ascending id: the oldest is kept
      const Eigen::Vector2d pixel = track.seen.pixel.head<2>();
      if (!grid.is_free(pixel)) return true;
      grid.take(pixel);
      return false;
    });
  }
  void thin_out(std::vector<Track>& tracks) const { thin_out(tracks, (*left_)[0].size()); }

  // After a large change of scale, the host patch is blurred or aliased: the current frame becomes the new host.
  void renew_hosts(std::vector<Track>& tracks) {
    const Stage stage(observer_, "renew_hosts");
    const Eigen::Isometry3d current_from_guide = guide_from_current_.inverse();
    for (Track& track : tracks) {
      if (!track.seen.has_disparity) continue;
      const auto expected = expect(stereo_, track, current_from_guide * track.guide_from_host);
      const double zoom = expected ? std::sqrt(expected->current_from_host.determinant()) : 0.0;
      if (zoom < kLargestZoom && zoom > 1.0 / kLargestZoom) continue;
      const auto match =
          matcher_.measure(*left_, right_, track.seen.pixel.head<2>(), track.seen.pixel.z(), track.gradient);
      if (match) host_here(track, *match);
    }
  }

  void host_here(Track& track, const vision::StereoMatch& match) {
    take(match, track);
    row_errors_.push_back(matcher_.row_error(*left_, right_, track.seen.pixel.head<2>(), match));
    track.host = left_;
    track.host_pixel = track.seen.pixel.head<2>();
    track.host_plane = vision::surface_plane(stereo_, offset_.without(track.seen.pixel), match.gradient);
    track.guide_from_host = guide_from_current_;
  }

  void detect(std::vector<Track>& tracks) {
    const Stage stage(observer_, "detect");
    vision::CellGrid grid((*left_)[0].size(), cell_px_);
    for (const Track& track : tracks) grid.take(track.seen.pixel.head<2>());
    attempts_ = 0;
    const auto enough = static_cast<size_t>(kEnough * parameters_.max_features);
    if (tracks.size() >= enough) return;
    for (const Feature& feature : front_end_->detect(grid)) {
      ++attempts_;
      const auto match = matcher_.search(*left_, right_, feature.pixel);
      if (!match) continue;
      Track track;
      track.id = next_id_ + static_cast<std::int64_t>(attempts_);
      track.seen.track_id = track.id;
      track.seen.pixel.head<2>() = feature.pixel;
      track.seen.sigma_px = kNoiseFloor_px;
      track.descriptor = feature.descriptor;
      host_here(track, *match);
      tracks.push_back(std::move(track));
    }
  }

  // Each patch is used once, when it becomes a host: repeated row errors of the same patch are correlated.
  void align_eyes() {
    const Stage stage(observer_, "align_eyes");
    for (const auto& error : row_errors_) {
      if (error) alignment_.add(error->ideal_right_pixel, error->error_px, std::hypot(kNoiseFloor_px, error->sigma_px));
    }
    alignment_.settle();
    matcher_.allow_for(alignment_.misalignment());
  }

  std::optional<std::string> check_for_swap(const std::vector<Track>& tracks) const {
    const Stage stage(observer_, "check_for_swap");
    const auto tried = static_cast<double>(attempts_) + static_cast<double>(tracks_.size());
    return swap_check_.find_fault(with_disparity(tracks), tried, matcher_, *left_, right_,
                                  [&] { return front_end_->detect(vision::CellGrid((*left_)[0].size(), cell_px_)); });
  }

  static int with_disparity(const std::vector<Track>& tracks) {
    return static_cast<int>(
        std::count_if(tracks.begin(), tracks.end(), [](const Track& track) { return track.seen.has_disparity; }));
  }

  // `current_from_previous` is null if no motion was measured: a predicted motion must not update the velocity.
  void keep(std::int64_t stamp_ns, std::vector<Track> tracks, const Eigen::Isometry3d* current_from_previous) {
    if (current_from_previous != nullptr) motion_model_.update(*current_from_previous, interval_ns_);
    guide_from_previous_ = guide_from_current_;
    next_id_ += attempts_ + 1;
    good_stamp_ns_ = stamp_ns;
    tracks_ = std::move(tracks);
    previous_left_ = left_;
  }

  vision::RectifiedStereo stereo_;
  TrackingParameters parameters_;
  MotionParameters motion_parameters_;
  vision::StageObserver* observer_;
  PairCheck check_;
  vision::StereoMatcher matcher_;
  SwapCheck swap_check_;
  vision::EpipolarCalibration alignment_;
  std::vector<std::optional<vision::RowError>> row_errors_;
  std::unique_ptr<FrontEnd> front_end_;
  int cell_px_;

  // State of the last good frame.
  std::vector<Track> tracks_;  // ascending id
  MotionModel motion_model_;
  DisparityOffset offset_;
  Eigen::Isometry3d guide_from_previous_ = Eigen::Isometry3d::Identity();
  std::int64_t good_stamp_ns_ = 0;
  std::int64_t interval_ns_ = 100'000'000;
  std::int64_t last_stamp_ns_ = 0;  // of any frame
  bool seen_any_ = false;
  std::int64_t next_id_ = 0;

  std::shared_ptr<const vision::ImagePyramid> previous_left_;

  // State of the current frame.
  std::shared_ptr<const vision::ImagePyramid> left_;
  vision::ImagePyramid right_;
  Eigen::Isometry3d expected_motion_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d guide_from_current_ = Eigen::Isometry3d::Identity();
  std::vector<Track> others_;
  std::int64_t attempts_ = 0;
};

TrackingStage::TrackingStage(const vision::RectifiedStereo& stereo, const Parameters& parameters,
                             vision::StageObserver* observer) {
  if (const auto problems = vision::validate(stereo); !problems.empty()) {
    std::string message = "invalid rectified calibration:";
    for (const auto& problem : problems) message += "\n  - " + problem;
    throw std::invalid_argument(message);
  }
  implementation_ = std::make_unique<Implementation>(stereo, parameters, observer);
}

TrackingStage::~TrackingStage() = default;
TrackingStage::TrackingStage(TrackingStage&&) noexcept = default;
TrackingStage& TrackingStage::operator=(TrackingStage&&) noexcept = default;

TrackedFrame TrackingStage::track(const StereoFrame& frame) { return implementation_->track(frame); }

}  // namespace panvo::binocular_odometry
