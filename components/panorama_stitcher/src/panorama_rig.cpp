// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/panorama_rig.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::panorama_stitcher {
namespace {

std::optional<HeadView> see(const vision::CameraModel& model, double blind_spot_rad, const Eigen::Vector3d& point) {
  const auto pixel = model.project(point);
  if (!pixel) return std::nullopt;
  const auto& camera = model.camera().pinhole;
  const double border_px =
      std::min({pixel->x(), pixel->y(), camera.width - 1 - pixel->x(), camera.height - 1 - pixel->y()});
  const double theta_rad = std::atan2(std::hypot(point.x(), point.y()), point.z());
  // conversion from px to rad at the image centre
  const double to_border_rad = border_px / std::max(camera.fx, camera.fy);
  const double to_blind_spot_rad = blind_spot_rad > 0.0 ? theta_rad - blind_spot_rad : std::numbers::pi;
  return HeadView{*pixel, std::min({to_border_rad, to_blind_spot_rad, model.widest_rad() - theta_rad})};
}

std::optional<HeadView> see(const vision::Equirectangular& panorama, double /*blind_spot_rad*/,
                            const Eigen::Vector3d& point) {
  return HeadView{panorama.project(point), std::numbers::pi};
}

}  // namespace

std::optional<HeadView> Head::see(const Eigen::Vector3d& direction_in_panorama, double radius_m) const {
  const Eigen::Matrix3d head_from_panorama = panorama_from_head.linear().transpose();
  const Eigen::Vector3d point =
      radius_m > 0.0 ? Eigen::Vector3d(radius_m * direction_in_panorama - panorama_from_head.translation())
                     : direction_in_panorama;
  auto view = std::visit(
      [&](const auto& seeing) { return panorama_stitcher::see(seeing, blind_spot_rad, head_from_panorama * point); },
      lens);
  if (!view || !(view->margin_rad >= 0.0)) return std::nullopt;
  view->pixel += Eigen::Vector2d(region_px.x, region_px.y);
  return view;
}

std::size_t PanoramaRig::images() const {
  std::size_t count = 0;
  for (const auto& head : heads) count = std::max(count, head.image + 1);
  return count;
}

}  // namespace panvo::panorama_stitcher
