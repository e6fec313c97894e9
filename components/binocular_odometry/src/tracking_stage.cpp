// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/tracking_stage.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "coarse_motion.hpp"
#include "coarse_turn.hpp"
#include "descriptor_motion.hpp"
#include "descriptor_tries.hpp"
#include "disparity_offset.hpp"
#include "front_end.hpp"
#include "host_frame.hpp"
#include "motion_model.hpp"
#include "pair_check.hpp"
#include "panvo/vision/stamp_sequence.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "scene_check.hpp"
#include "stereo_pyramids.hpp"
#include "swap_check.hpp"
#include "track.hpp"
#include "track_search.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::Stage;

constexpr std::size_t kSeedTracks = 60;    // for the coarse motion, with a margin for outliers
constexpr double kMaxDisparity_px = -1.0;  // infinity, with a margin for calibration errors
constexpr int kCrowded_px = 8;             // nearer tracks share the same patch
constexpr double kEnough = 0.9;            // of max_features: above, no new features are detected
constexpr std::int64_t kUsualInterval_ns = 100'000'000;

vision::StereoMatcher::Range disparity_range(const vision::RectifiedStereo& stereo,
                                             const TrackingParameters& parameters) {
  return {kMaxDisparity_px, stereo.camera.fx / parameters.nearest_depth_baselines};
}

/// State after the last good frame. A bad frame does not change it.
struct TrackingState {
  TrackingState(const vision::PinholeCamera& camera, const vision::StereoMatcher& aligned)
      : alignment(camera), matcher(aligned) {}

  std::vector<Track> tracks;             // ascending id
  std::int64_t next_id = 1;              // of a track
  std::optional<StereoPyramids> images;  // nullopt before the first good frame
  std::int64_t stamp_ns = 0;
  std::int64_t interval_ns = kUsualInterval_ns;                      // to the good frame before
  Eigen::Isometry3d odom_from_left = Eigen::Isometry3d::Identity();  // dead reckoning, to predict where features are
  MotionModel motion_model;
  DisparityOffset offset;
  vision::EpipolarCalibration alignment;
  vision::StereoMatcher matcher;  // allows for the misalignment found so far
};

/// What the check of the next frame needs of all frames before, good or bad.
struct Arrivals {
  explicit Arrivals(const vision::PinholeCamera& camera) : pairs(camera) {}

  PairCheck pairs;
  // Two stamps tell a clock that was set back: a late frame is alone as a rule, and each one that is lost moves the scene
  // farther from the last good frame.
  vision::StampSequence stamps{2};
};

/// Tracks of the last good frame in the next one, and the motion between the two.
struct Followed {
  std::vector<Track> tracks;
  std::vector<FramePair> matches;  // by descriptors, if the tracks could not be followed
  Eigen::Isometry3d current_from_previous = Eigen::Isometry3d::Identity();
  bool is_measured = false;  // false: predicted only, without tracks
  bool tried_descriptors = false;
  DisparityOffset offset;
};

int with_disparity(const std::vector<Track>& tracks) {
  return static_cast<int>(
      std::count_if(tracks.begin(), tracks.end(), [](const Track& track) { return track.seen.has_disparity; }));
}

/// Keeps the oldest of tracks that have run together. Ascending id.
std::vector<Track> thinned_out(std::vector<Track> tracks, cv::Size image_size) {
  vision::CellGrid grid(image_size, kCrowded_px);
  std::erase_if(tracks, [&grid](const Track& track) {
    const Eigen::Vector2d pixel = track.seen.pixel.head<2>();
    if (!grid.is_free(pixel)) return true;
    grid.take(pixel);
    return false;
  });
  return tracks;
}

}  // namespace

class TrackingStage::Implementation {
 public:
  Implementation(const vision::RectifiedStereo& stereo, const Parameters& parameters, vision::StageObserver* observer)
      : stereo_(stereo),
        parameters_(parameters.tracking),
        motion_parameters_(parameters.motion),
        observer_(observer),
        swap_check_(stereo.camera, disparity_range(stereo, parameters_), parameters_.min_correlation),
        front_end_(make_front_end(parameters_)),
        descriptor_motion_(stereo, motion_parameters_),
        cell_px_(static_cast<int>(std::ceil(
            std::sqrt(static_cast<double>(stereo.camera.width) * stereo.camera.height / parameters_.max_features)))),
        arrivals_(stereo.camera),
        state_(stereo.camera, {stereo.camera, disparity_range(stereo, parameters_), parameters_.min_correlation}) {}

  TrackedFrame track(const StereoFrame& frame) {
    TrackedFrame result;
    result.stamp_ns = frame.stamp_ns;
    result.is_late = arrivals_.stamps.add(frame.stamp_ns) == vision::StampOrder::kNotLater;
    result.fault = result.is_late ? late_fault(frame.stamp_ns) : find_fault(frame).value_or("");
    arrivals_.pairs.remember(frame);  // bad frames, too
    if (!result.fault.empty()) return result;

    const StereoPyramids images = build_pyramids(frame);
    describe(images);
    const std::int64_t interval_ns = interval_until(frame.stamp_ns);
    Followed followed = follow(images, interval_ns, tries_.are_allowed(frame.stamp_ns));
    result.tracked = static_cast<int>(followed.tracks.size());
    const int seen_by_both = with_disparity(followed.tracks);

    std::vector<Track> tracks = thinned_out(std::move(followed.tracks), (*images.left)[0].size());
    HostFrame host(stereo_, images, state_.matcher, followed.offset,
                   state_.odom_from_left * followed.current_from_previous.inverse());
    reanchor_tracks(host, tracks);
    const auto before = static_cast<int>(tracks.size());
    const std::size_t tried = detect(host, tracks);
    result.detected = static_cast<int>(tracks.size());
    result.matched = with_disparity(tracks);
    result.fault = find_mismatch(images, result, tried,
                                 {result.tracked, seen_by_both, before + static_cast<int>(tried), result.matched})
                       .value_or("");
    if (followed.tried_descriptors) tries_.tried(frame.stamp_ns, !followed.is_measured || !result.fault.empty());
    if (!result.fault.empty()) return result;

    for (const Track& track : tracks) result.observations.push_back(track.seen);
    if (followed.is_measured) result.current_from_previous = followed.current_from_previous;
    result.matches = apart_from_tracks(std::move(followed.matches), tracks);
    align_cameras(host.row_errors());
    if (followed.is_measured) state_.motion_model.update(followed.current_from_previous, interval_ns);
    state_.offset = followed.offset;
    state_.odom_from_left = host.odom_from_current();
    state_.next_id += static_cast<std::int64_t>(tried);
    state_.tracks = std::move(tracks);
    state_.images = images;
    state_.stamp_ns = frame.stamp_ns;
    state_.interval_ns = interval_ns;
    result.row_misalignment_px = state_.alignment.misalignment().max_row_shift_px(stereo_.camera);
    result.disparity_offset_px = state_.offset.px();
    return result;
  }

 private:
  std::optional<std::string> find_fault(const StereoFrame& frame) const {
    const Stage stage(observer_, "check");
    return arrivals_.pairs.find_fault(frame);
  }

  std::string late_fault(std::int64_t stamp_ns) const {
    return "stamp " + std::to_string(stamp_ns) + " ns is not later than the previous stamp, " +
           std::to_string(*arrivals_.stamps.latest_ns()) + " ns";
  }

  StereoPyramids build_pyramids(const StereoFrame& frame) const {
    const Stage stage(observer_, "pyramid");
    return {std::make_shared<const vision::ImagePyramid>(frame.left, parameters_.pyramid_levels),
            vision::ImagePyramid(frame.right, std::min(2, parameters_.pyramid_levels))};
  }

  void describe(const StereoPyramids& images) const {
    const Stage stage(observer_, "describe");
    front_end_->describe(*images.left);
  }

  /// Time since the last good frame; after a jump back in time, the interval before it.
  std::int64_t interval_until(std::int64_t stamp_ns) const {
    return state_.images && stamp_ns > state_.stamp_ns ? stamp_ns - state_.stamp_ns : state_.interval_ns;
  }

  /// Follows the tracks of the last good frame: first some of them, in a wide area; their motion predicts the others.
  Followed follow(const StereoPyramids& images, std::int64_t interval_ns, bool may_match_descriptors) const {
    Followed followed;
    followed.offset = state_.offset;
    if (state_.tracks.empty()) return followed;
    const auto match_by_descriptors = [&]() -> std::optional<DescriptorMotion::Found> {
      if (!may_match_descriptors) return std::nullopt;
      followed.tried_descriptors = true;
      return match_descriptors(images);
    };
    const TrackSearch search(stereo_, parameters_.min_correlation, images, state_.matcher, state_.offset.px(),
                             *front_end_);
    Eigen::Isometry3d expected = state_.motion_model.predict(interval_ns);
    Attempt attempt = try_motion(search, expected, kSeedTracks);
    if (!attempt.motion) {  // possibly a jerk: retry all tracks from the global image shift
      expected.linear() = coarse_turn(stereo_.camera, *state_.images->left, *images.left);
      attempt = try_motion(search, expected, state_.tracks.size());
    }
    if (!attempt.motion) {  // or the predicted translation is wrong: retry without it, to recover
      const Eigen::Isometry3d turn(expected.linear());
      attempt = try_motion(search, turn, state_.tracks.size());
    }
    if (!attempt.motion) {  // or the frames are too far apart to follow patches: match descriptors
      if (auto found = match_by_descriptors()) {
        expected = found->current_from_previous;
        attempt = try_motion(search, expected, state_.tracks.size());
        if (!attempt.motion) attempt.motion = expected;
        followed.matches = std::move(found->matches);
      }
    }
    followed.current_from_previous = expected;
    if (!attempt.motion) return followed;  // no consistent motion: restart with new tracks

    followed.is_measured = true;
    {
      const Stage stage(observer_, "match_others");
      followed.tracks =
          search.search_nearby(std::move(attempt.tracks), *attempt.motion * state_.odom_from_left.inverse());
    }
    if (followed.matches.empty() && are_few(followed.tracks.size())) {
      if (auto found = match_by_descriptors()) followed.matches = std::move(found->matches);
    }
    const Stage stage(observer_, "learn_offset");
    std::vector<FramePair> points = seen_twice(state_.tracks, followed.tracks);
    std::erase_if(points, [](const FramePair& point) { return !point.current.has_disparity; });
    followed.current_from_previous = followed.offset.learn(stereo_, points, *attempt.motion);
    return followed;
  }

  std::optional<DescriptorMotion::Found> match_descriptors(const StereoPyramids& images) const {
    const Stage stage(observer_, "match_descriptors");
    return descriptor_motion_.find(*state_.images, images, state_.matcher, state_.offset);
  }

  /// Whether few tracks are left of many, so that, with the wrong ones among them, they may not determine the motion.
  bool are_few(std::size_t tracks) const {
    return tracks < 3 * static_cast<std::size_t>(motion_parameters_.min_inliers) && 4 * tracks < state_.tracks.size();
  }

  struct Attempt {
    TrackSearch::Split tracks;
    std::optional<Eigen::Isometry3d> motion;  // current_from_previous that they agree on
  };

  Attempt try_motion(const TrackSearch& search, const Eigen::Isometry3d& expected, std::size_t count) const {
    Attempt attempt;
    {
      const Stage stage(observer_, "match_widely");
      attempt.tracks = search.search_widely(state_.tracks, count, expected * state_.odom_from_left.inverse());
    }
    const Stage stage(observer_, "coarse_motion");
    attempt.motion = coarse_motion(stereo_, seen_twice(state_.tracks, attempt.tracks.found), state_.offset, expected,
                                   motion_parameters_);
    return attempt;
  }

  void reanchor_tracks(HostFrame& host, std::vector<Track>& tracks) const {
    const Stage stage(observer_, "reanchor_tracks");
    host.renew(tracks);
  }

  /// Adds tracks in cells without any. Returns the number of features tried.
  std::size_t detect(HostFrame& host, std::vector<Track>& tracks) const {
    const Stage stage(observer_, "detect");
    if (tracks.size() >= static_cast<std::size_t>(kEnough * parameters_.max_features)) return 0;
    vision::CellGrid grid = empty_grid();
    for (const Track& track : tracks) grid.take(track.seen.pixel.head<2>());
    const std::vector<Feature> features = front_end_->detect(grid);
    host.add(features, state_.next_id, tracks);
    return features.size();
  }

  /// Matches at the place of a track would count its point twice.
  std::vector<FramePair> apart_from_tracks(std::vector<FramePair> matches, const std::vector<Track>& tracks) const {
    vision::CellGrid grid(cv::Size(stereo_.camera.width, stereo_.camera.height), kCrowded_px);
    for (const Track& track : tracks) grid.take(track.seen.pixel.head<2>());
    std::erase_if(matches, [&](const FramePair& match) {
      const Eigen::Vector2d pixel = match.current.pixel.head<2>();
      if (!grid.is_free(pixel)) return true;
      grid.take(pixel);
      return false;
    });
    return matches;
  }

  vision::CellGrid empty_grid() const { return {cv::Size(stereo_.camera.width, stereo_.camera.height), cell_px_}; }

  /// Left and right images swapped, or not of one scene.
  std::optional<std::string> find_mismatch(const StereoPyramids& images, const TrackedFrame& frame, std::size_t tried,
                                           const FeatureCounts& counts) {
    const Stage stage(observer_, "check_for_swap");
    const auto searched = static_cast<double>(tried + state_.tracks.size());
    const auto swap = swap_check_.find_fault(frame.matched, searched, state_.matcher, *images.left, images.right,
                                             [&] { return front_end_->detect(empty_grid()); });
    return swap ? swap : scene_check_.find_fault(counts, frame.stamp_ns);
  }

  void align_cameras(std::span<const std::optional<vision::RowError>> row_errors) {
    const Stage stage(observer_, "align_eyes");
    for (const auto& error : row_errors) {
      if (!error) continue;
      state_.alignment.add(error->ideal_right_pixel, error->error_px, std::hypot(kNoiseFloor_px, error->sigma_px));
    }
    state_.alignment.settle();
    state_.matcher.allow_for(state_.alignment.misalignment());
  }

  const vision::RectifiedStereo stereo_;
  const TrackingParameters parameters_;
  const MotionParameters motion_parameters_;
  vision::StageObserver* const observer_;
  const SwapCheck swap_check_;
  const std::unique_ptr<FrontEnd> front_end_;
  const DescriptorMotion descriptor_motion_;
  const int cell_px_;

  Arrivals arrivals_;
  DescriptorTries tries_;
  SceneCheck scene_check_;
  TrackingState state_;
};

TrackingStage::TrackingStage(const vision::RectifiedStereo& stereo, const Parameters& parameters,
                             vision::StageObserver* observer) {
  vision::expect_valid(stereo);
  implementation_ = std::make_unique<Implementation>(stereo, parameters, observer);
}

TrackingStage::~TrackingStage() = default;
TrackingStage::TrackingStage(TrackingStage&&) noexcept = default;
TrackingStage& TrackingStage::operator=(TrackingStage&&) noexcept = default;

TrackedFrame TrackingStage::track(const StereoFrame& frame) { return implementation_->track(frame); }

}  // namespace panvo::binocular_odometry
