// SPDX-License-Identifier: Apache-2.0
#include "stored_landmark.hpp"
#include "panvo/interfaces/place_rules.hpp"

#include <algorithm>
#include <stdexcept>

namespace panvo::landmarks {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
constexpr std::int64_t kMostUses = 1'000'000'000;

PoseNumbers to_numbers(const Eigen::Isometry3d& a_from_b) {
  const Eigen::Vector3d t = a_from_b.translation();
  const Eigen::Quaterniond q = Eigen::Quaterniond(a_from_b.linear()).normalized();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Eigen::Isometry3d pose_from(const PoseNumbers& number) {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = Eigen::Quaterniond(number[6], number[3], number[4], number[5]).normalized().toRotationMatrix();
  a_from_b.translation() = Eigen::Vector3d(number[0], number[1], number[2]);
  return a_from_b;
}

Bytes covariance_bytes(const Eigen::Matrix<double, 6, 6>& covariance) {
  const RowMajor6d values = covariance;
  return to_bytes(std::span<const double>(values.data(), 36));
}

}  // namespace

StoredPose to_stored(std::int64_t id, const Eigen::Isometry3d& map_from_base,
                     const Eigen::Matrix<double, 6, 6>& covariance) {
  return {id, to_numbers(map_from_base), covariance_bytes(covariance)};
}

StoredLandmark to_stored(const PanoramicLandmark& landmark) {
  const auto& description = landmark.description;
  StoredLandmark stored;
  stored.id = landmark.id;
  stored.stamp_ns = landmark.stamp_ns;
  stored.is_junction = landmark.is_junction;
  stored.map_from_base = to_numbers(landmark.map_from_base);
  stored.covariance = covariance_bytes(landmark.covariance);
  stored.base_from_panorama = to_numbers(landmark.base_from_panorama);
  stored.histogram = to_bytes(std::span(description.histogram));
  stored.large = to_bytes(std::span(description.large));
  stored.small = to_bytes(std::span(description.small));
  stored.keypoint_count = static_cast<std::int64_t>(landmark.keypoints.size());
  stored.keypoints = to_bytes(std::span(landmark.keypoints));
  stored.thumbnail = landmark.thumbnail;
  return stored;
}

PanoramicLandmark from_stored(const StoredLandmark& stored) {
  PanoramicLandmark landmark;
  if (stored.id < 1 || stored.id > interfaces::kMaxLandmarkId) {
    throw std::range_error("its id is not in 1 to 4000000000");
  }
  landmark.id = static_cast<std::uint32_t>(stored.id);
  landmark.stamp_ns = stored.stamp_ns;
  landmark.is_junction = stored.is_junction != 0;
  landmark.map_from_base = pose_from(stored.map_from_base);
  landmark.base_from_panorama = pose_from(stored.base_from_panorama);
  const auto covariance = doubles_from(stored.covariance);
  auto histogram = floats_from(stored.histogram);
  auto large = features_from(stored.large);
  auto small = features_from(stored.small);
  if (!covariance || covariance->size() != 36 || !histogram || !large || !small) {
    throw std::range_error("contains invalid values");
  }
  landmark.covariance = Eigen::Map<const RowMajor6d>(covariance->data());
  landmark.description = {std::move(*histogram), std::move(*large), std::move(*small)};
  return landmark;
}

std::uint32_t use_number(std::int64_t stored) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(stored, 0, kMostUses));
}

std::uint32_t id_number(std::int64_t stored) {
  return stored < 0 || stored > interfaces::kMaxLandmarkId ? 0 : static_cast<std::uint32_t>(stored);
}

void add_run_row(std::vector<StoredRun>& runs, const std::string& run, const std::array<std::int64_t, 4>& row) {
  if (runs.empty() || runs.back().id != run) runs.push_back({run, use_number(row[0]), id_number(row[1]), {}});
  if (const auto id = id_number(row[2]); id != 0) runs.back().ids.emplace(id, id_number(row[3]));
}

void add_missed(std::vector<StoredRun>& runs, const std::string& run, std::int64_t id, std::int64_t missed) {
  const auto of = std::ranges::find(runs, run, &StoredRun::id);
  if (of != runs.end()) of->missed.emplace(id_number(id), use_number(missed));
}

std::uint64_t digest_of(const StoredLandmark& stored) {
  std::uint64_t digest = 0xcbf29ce484222325;
  const auto add = [&](const Bytes& bytes) {
    for (const auto byte : to_bytes(std::array{static_cast<double>(bytes.size())})) {
      digest = (digest ^ byte) * 0x100000001b3;
    }
    for (const auto byte : bytes) digest = (digest ^ byte) * 0x100000001b3;
  };
  const auto add_pose = [&](PoseNumbers pose) {
    for (auto& number : pose) number += 0.0;  // SQLite has no -0.0
    add(to_bytes(std::span<const double>(pose)));
  };
  for (const auto number : {stored.id, stored.stamp_ns, stored.is_junction, stored.keypoint_count}) {
    Bytes bytes;
    for (int shift = 0; shift < 64; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> shift));
    }
    add(bytes);
  }
  add_pose(stored.map_from_base);
  add_pose(stored.base_from_panorama);
  for (const auto* bytes :
       {&stored.covariance, &stored.histogram, &stored.large, &stored.small, &stored.keypoints, &stored.thumbnail}) {
    add(*bytes);
  }
  return digest;
}

}  // namespace panvo::landmarks
