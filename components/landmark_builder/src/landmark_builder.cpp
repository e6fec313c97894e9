// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_builder.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/vision/grey.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::landmark_builder {
namespace {

constexpr double kKeepStep_m = 0.6;   // between two kept panoramas
constexpr double kKeepPath_m = 35.0;  // a junction is returned only after it is passed
constexpr double kNearNeighbour_m = 0.5;
constexpr double kMaxWait_m = 100.0;
const cv::Size kThumbnail(540, 270);

/// Grey levels that outlive the image, whose pixels belong to a message.
cv::Mat kept_grey(const cv::Mat& image) {
  cv::Mat grey = vision::to_grey(image);
  return grey.data == image.data ? grey.clone() : grey;
}

}  // namespace

LandmarkBuilder::LandmarkBuilder(const BuilderParameters& parameters, std::uint64_t seed,
                                 const Eigen::Isometry3d& base_from_panorama, cv::Size panorama_size,
                                 vision::StageObserver* observer)
    : parameters_(parameters),
      observer_(observer),
      base_from_panorama_(base_from_panorama),
      detector_(parameters.junction, base_from_panorama, panorama_size, observer),
      filter_(parameters.filter),
      rule_(parameters.rule),
      describer_(parameters.description, seed) {}

std::vector<landmarks::PanoramicLandmark> LandmarkBuilder::step(const PosedPanorama& panorama,
                                                                landmarks::MapReplica& map) {
  const Eigen::Vector3d position = panorama.odom_from_base.translation();
  if (last_position_) {
    travelled_m_ += (position - *last_position_).norm();
  } else {
    rule_.begin(panorama.stamp_ns);
  }
  last_position_ = position;
  map_from_odom_ = panorama.map_from_odom;
  keep(panorama);
  view_ = detector_.detect(panorama.image, panorama.odom_from_base);
  std::vector<landmarks::PanoramicLandmark> built;
  while (!waiting_.empty() && has_waited(waiting_.front(), panorama.stamp_ns)) build_waiting(map, built);
  const auto take = [&](const Kept& chosen, bool is_junction) {
    if (!is_taken(chosen, map)) return;
    if (parameters_.rule.wait_for_clock_s > 0.0 && !is_clock_known_) {
      waiting_.push_back({chosen.travelled_m, chosen.stamp_ns, is_junction});
    } else if (auto landmark = build(chosen, is_junction, map)) {
      built.push_back(std::move(*landmark));
    }
  };
  for (const PassedJunction& junction : filter_.add(panorama.stamp_ns, position.head<2>(), view_.seen)) {
    take(nearest_to_stamp(junction.nearest_stamp_ns), true);
  }
  // by the distance rule, far enough back to have panoramas on both sides; not while a junction is pending
  const double back_m = travelled_m_ - parameters_.max_neighbour_distance_m;
  if (!filter_.is_pending() && is_due(map, back_m)) take(nearest_to_travelled(back_m), false);
  return built;
}

std::vector<landmarks::PanoramicLandmark> LandmarkBuilder::finish(landmarks::MapReplica& map) {
  std::vector<landmarks::PanoramicLandmark> built;
  while (!waiting_.empty() && !kept_.empty()) build_waiting(map, built);
  return built;
}

/// Builds the landmark that has waited longest, unless its panorama is gone or another landmark stands there by now.
void LandmarkBuilder::build_waiting(landmarks::MapReplica& map, std::vector<landmarks::PanoramicLandmark>& built) {
  const Waiting waiting = waiting_.front();
  waiting_.pop_front();
  const Kept& chosen = nearest_to_travelled(waiting.travelled_m);
  if (std::abs(chosen.travelled_m - waiting.travelled_m) >= kKeepStep_m || !is_taken(chosen, map)) return;
  if (auto landmark = build(chosen, waiting.is_junction, map)) built.push_back(std::move(*landmark));
}

bool LandmarkBuilder::is_taken(const Kept& chosen, const landmarks::MapReplica& map) const {
  const Eigen::Vector3d place = map_from_odom_ * chosen.odom_from_base.translation();
  return rule_.takes(map, place.head<2>(), chosen.travelled_m);
}

bool LandmarkBuilder::has_waited(const Waiting& landmark, std::int64_t now_ns) const {
  const double most_m = parameters_.rule.max_spacing_m > 0.0 ? parameters_.rule.max_spacing_m : kMaxWait_m;
  return is_clock_known_ || travelled_m_ - landmark.travelled_m > most_m ||
         vision::seconds(landmark.stamp_ns, now_ns) > parameters_.rule.wait_for_clock_s;
}

bool LandmarkBuilder::is_due(const landmarks::MapReplica& map, double travelled_m) const {
  const bool is_soon = !waiting_.empty() && travelled_m - waiting_.back().travelled_m < parameters_.rule.max_spacing_m;
  return !is_soon && rule_.is_due(map, travelled_m);
}

void LandmarkBuilder::keep(const PosedPanorama& panorama) {
  if (!kept_.empty() && travelled_m_ - kept_.back().travelled_m < kKeepStep_m) return;
  Kept kept{panorama.stamp_ns,       kept_grey(panorama.image), {},
            panorama.odom_from_base, panorama.covariance,       travelled_m_};
  if (parameters_.thumbnail_quality > 0) cv::resize(panorama.image, kept.thumbnail, kThumbnail, 0, 0, cv::INTER_AREA);
  kept_.push_back(std::move(kept));
  const double around_m = parameters_.max_neighbour_distance_m + kKeepStep_m;
  std::erase_if(kept_, [&](const Kept& old) {
    const bool is_needed = std::ranges::any_of(waiting_, [&](const Waiting& landmark) {
      return std::abs(old.travelled_m - landmark.travelled_m) <= around_m;
    });
    return travelled_m_ - old.travelled_m > kKeepPath_m && !is_needed;
  });
}

void LandmarkBuilder::set_poses(const PoseOf& odom_from_base) {
  std::erase_if(kept_, [&](Kept& kept) {
    const auto pose = odom_from_base(kept.stamp_ns);
    if (pose) kept.odom_from_base = *pose;
    return !pose;
  });
}

const LandmarkBuilder::Kept& LandmarkBuilder::nearest_to_stamp(std::int64_t stamp_ns) const {
  return *std::min_element(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) {
    return std::abs(a.stamp_ns - stamp_ns) < std::abs(b.stamp_ns - stamp_ns);
  });
}

const LandmarkBuilder::Kept& LandmarkBuilder::nearest_to_travelled(double travelled_m) const {
  return *std::min_element(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) {
    return std::abs(a.travelled_m - travelled_m) < std::abs(b.travelled_m - travelled_m);
  });
}

std::vector<const LandmarkBuilder::Kept*> LandmarkBuilder::neighbours_of(const Kept& chosen) const {
  std::vector<const Kept*> neighbours;
  for (int i = 0; i < parameters_.neighbours; ++i) {
    // alternately before and after, the farthest first
    const double pairs = std::ceil(0.5 * parameters_.neighbours);
    const double distance_m = parameters_.max_neighbour_distance_m * (pairs - i / 2) / pairs;
    const Kept& neighbour = nearest_to_travelled(chosen.travelled_m + (i % 2 == 0 ? -distance_m : distance_m));
    const double apart_m = std::abs(neighbour.travelled_m - chosen.travelled_m);
    if (apart_m < kNearNeighbour_m || apart_m > parameters_.max_neighbour_distance_m + 1.0) continue;
    if (std::find(neighbours.begin(), neighbours.end(), &neighbour) == neighbours.end())
      neighbours.push_back(&neighbour);
  }
  return neighbours;
}

std::optional<landmarks::PanoramicLandmark> LandmarkBuilder::build(const Kept& chosen, bool is_junction,
                                                                   landmarks::MapReplica& map) {
  if (landmarks::find_fault(chosen.grey)) return std::nullopt;
  const vision::Stage all(observer_, "build");
  landmarks::PanoramicLandmark landmark;
  landmark.id = map.next_id();
  landmark.stamp_ns = chosen.stamp_ns;
  landmark.map_from_base = map_from_odom_ * chosen.odom_from_base;
  landmark.covariance = vision::rotate_covariance(map_from_odom_.linear(), chosen.covariance);
  landmark.base_from_panorama = base_from_panorama_;
  landmark.is_junction = is_junction;
  {
    const vision::Stage stage(observer_, "describe");
    landmark.description = describer_.describe(chosen.grey);
  }
  {
    const vision::Stage stage(observer_, "keypoints");
    landmark.keypoints = landmarks::detect_keypoints(chosen.grey, parameters_.keypoints, seen_);
  }
  {
    const vision::Stage stage(observer_, "triangulate");
    const Eigen::Isometry3d landmark_from_odom = (chosen.odom_from_base * base_from_panorama_).inverse();
    std::vector<NeighbourPanorama> neighbours;
    for (const Kept* kept : neighbours_of(chosen)) {
      neighbours.push_back({landmark_from_odom * kept->odom_from_base * base_from_panorama_,
                            landmarks::detect_keypoints(kept->grey, parameters_.keypoints, seen_)});
    }
    triangulate_keypoints(landmark.keypoints, neighbours, parameters_.triangulation);
  }
  if (!chosen.thumbnail.empty()) {
    cv::imencode(".jpg", chosen.thumbnail, landmark.thumbnail,
                 {cv::IMWRITE_JPEG_QUALITY, parameters_.thumbnail_quality});
  }
  map.add(landmark);
  rule_.taken(chosen.travelled_m);
  return landmark;
}

}  // namespace panvo::landmark_builder
