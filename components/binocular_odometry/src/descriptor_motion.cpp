// SPDX-License-Identifier: Apache-2.0
#include "descriptor_motion.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "motion_ransac.hpp"
#include "track_search.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr int kFeatures = 1000;               // most of them are in one frame only
constexpr int kDescriptorLayers = 3;          // scales per octave [Lowe 2004]: the scale of a point may double
constexpr double kDescriptorContrast = 0.02;  // half of Lowe's value, for low-contrast roads
constexpr float kMaxRatio = 0.8F;             // Lowe's, to the second best
// Without a prediction, chance agreement must be excluded. Wrong matches agree with no common motion.
constexpr int kMinInliers = 15;
constexpr double kMinRatio = 0.3;
constexpr double kSigma_px = 0.5;    // of a SIFT feature in half-size images
constexpr int kMinIterations = 400;  // finds a motion that a quarter of the points agree on, with 99.8 %

/// Pairs of features that are each other's best match.
std::vector<cv::DMatch> mutual_matches(const cv::Mat& previous, const cv::Mat& current) {
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> forward;
  std::vector<cv::DMatch> backward;
  matcher.knnMatch(previous, current, forward, 2);
  matcher.match(current, previous, backward);
  std::vector<cv::DMatch> matches;
  for (const auto& best : forward) {
    if (best.size() < 2 || best[0].distance > kMaxRatio * best[1].distance) continue;
    if (backward[static_cast<std::size_t>(best[0].trainIdx)].trainIdx == best[0].queryIdx) matches.push_back(best[0]);
  }
  return matches;
}

/// The feature with its disparity; nullopt without a match in the right image.
std::optional<Observation> locate(const StereoPyramids& images, const vision::StereoMatcher& matcher,
                                  const cv::KeyPoint& keypoint) {
  const Eigen::Vector2d pixel(keypoint.pt.x, keypoint.pt.y);
  const auto match = matcher.search(*images.left, images.right, pixel);
  if (!match) return std::nullopt;
  Track track;
  track.seen.pixel.head<2>() = pixel;
  track.seen.sigma_px = kSigma_px;
  set_disparity(track, *match);
  return track.seen;
}

}  // namespace

DescriptorMotion::DescriptorMotion(const vision::RectifiedStereo& stereo, const MotionParameters& parameters)
    : stereo_(stereo),
      parameters_(parameters),
      detector_(cv::SIFT::create(kFeatures, kDescriptorLayers, kDescriptorContrast)) {
  parameters_.ransac_iterations = std::max(parameters_.ransac_iterations, kMinIterations);
}

DescriptorMotion::Features DescriptorMotion::describe(const vision::ImagePyramid& image) const {
  // OpenCV's detector doubles its input
  const int level = std::min(1, image.levels() - 1);
  Features features;
  detector_->detectAndCompute(image[level], cv::noArray(), features.keypoints, features.descriptors);
  for (auto& keypoint : features.keypoints) keypoint.pt *= static_cast<float>(1 << level);
  return features;
}

std::optional<DescriptorMotion::Found> DescriptorMotion::find(const StereoPyramids& previous,
                                                              const StereoPyramids& current,
                                                              const vision::StereoMatcher& matcher,
                                                              const DisparityOffset& offset) const {
  const Features before = describe(*previous.left), now = describe(*current.left);
  if (before.keypoints.size() < kMinInliers || now.keypoints.size() < kMinInliers) return std::nullopt;
  std::vector<FramePair> matches;
  std::vector<PointPair> pairs;
  for (const auto& match : mutual_matches(before.descriptors, now.descriptors)) {
    const auto then = locate(previous, matcher, before.keypoints[static_cast<std::size_t>(match.queryIdx)]);
    const auto here = locate(current, matcher, now.keypoints[static_cast<std::size_t>(match.trainIdx)]);
    if (!then || !here) continue;
    matches.push_back({*then, *here});
    pairs.push_back({offset.without(then->pixel), offset.without(here->pixel), true});
  }
  const std::array guesses{Eigen::Isometry3d::Identity()};
  const auto motion = estimate_motion(stereo_, pairs, guesses, parameters_);
  if (!motion || motion->inliers < kMinInliers) return std::nullopt;
  if (static_cast<double>(motion->inliers) < kMinRatio * static_cast<double>(pairs.size())) return std::nullopt;
  Found found{motion->current_from_previous, {}};
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (motion->is_inlier[i]) found.matches.push_back(matches[i]);
  }
  return found;
}

}  // namespace panvo::binocular_odometry
