// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/alignment.hpp"

#include <stdexcept>

namespace panvo::evaluation {
namespace {

// A path with a smaller extent has no meaningful direction.
constexpr double kMinExtentM = 1e-6;

double extent_m(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d centre = points.rowwise().mean();  // evaluated once, not per column
  return (points.colwise() - centre).colwise().norm().maxCoeff();
}

std::optional<MapFromOdom> align_positions(std::span<const PosePair> pairs, bool with_scale) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd in_odom(3, count);
  Eigen::Matrix3Xd in_map(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    in_odom.col(i) = pairs[static_cast<std::size_t>(i)].odom_from_base.translation();
    in_map.col(i) = pairs[static_cast<std::size_t>(i)].map_from_base.translation();
  }
  if (extent_m(in_odom) < kMinExtentM || extent_m(in_map) < kMinExtentM) return std::nullopt;
  const Eigen::Matrix4d similarity = Eigen::umeyama(in_odom, in_map, with_scale);
  MapFromOdom result;
  result.scale = with_scale ? similarity.topLeftCorner<3, 3>().col(0).norm() : 1.0;
  result.rigid.linear() = similarity.topLeftCorner<3, 3>() / result.scale;
  result.rigid.translation() = similarity.topRightCorner<3, 1>();
  return result;
}

}  // namespace

std::string_view to_string(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kStart:
      return "start";
    case Alignment::kSe3:
      return "se3";
    case Alignment::kSim3:
      return "sim3";
  }
  throw std::logic_error("invalid alignment");
}

Eigen::Isometry3d MapFromOdom::operator*(const Eigen::Isometry3d& odom_from_base) const {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  map_from_base.linear() = rigid.linear() * odom_from_base.linear();
  map_from_base.translation() = scale * (rigid.linear() * odom_from_base.translation()) + rigid.translation();
  return map_from_base;
}

std::optional<MapFromOdom> align(std::span<const PosePair> pairs, Alignment alignment) {
  if (pairs.empty()) return std::nullopt;
  switch (alignment) {
    case Alignment::kNone:
      return MapFromOdom{};
    case Alignment::kStart:
      return MapFromOdom{1.0, pairs.front().map_from_base * pairs.front().odom_from_base.inverse()};
    case Alignment::kSe3:
      return align_positions(pairs, false);
    case Alignment::kSim3:
      return align_positions(pairs, true);
  }
  return std::nullopt;
}

}  // namespace panvo::evaluation
