// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/rig_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/calibration_files/camera_info.hpp"
#include "panvo/calibration_files/mount.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::calibration {
namespace {

using calibration_files::YamlMap;

constexpr double kDegree = std::numbers::pi / 180.0;

Eigen::Matrix<double, 6, 1> mount_of(const Eigen::Isometry3d& base_from_camera) {
  const Eigen::Matrix3d r = base_from_camera.linear() * calibration_files::base_from_forward().transpose();
  Eigen::Matrix<double, 6, 1> mount;
  mount << base_from_camera.translation(), std::atan2(r(2, 1), r(2, 2)) / kDegree,
      std::asin(std::clamp(-r(2, 0), -1.0, 1.0)) / kDegree, std::atan2(r(1, 0), r(0, 0)) / kDegree;
  return mount;
}

/// Rounds to the printed precision, to avoid -0.
double rounded(double value, double places) { return std::round(value * places) / places + 0.0; }

std::string numbers_of(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      text += fmt::format("{}{:.10g}", text.empty() ? "" : ", ", pose.matrix()(row, column) + 0.0);
  }
  return "[" + text + "]";
}

bool is_seen(const std::vector<vision::CameraModel>& models, const std::vector<NamedCamera>& cameras,
             const Eigen::Vector3d& direction) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto pixel = models[i].project(cameras[i].camera.camera_from_reference.linear() * direction);
    if (pixel && cameras[i].camera.lens.pinhole.contains(*pixel)) return true;
  }
  return false;
}

}  // namespace

std::optional<std::pair<double, double>> seen_elevations_deg(const std::vector<NamedCamera>& cameras) {
  std::vector<vision::CameraModel> models;
  for (const auto& camera : cameras) models.emplace_back(camera.camera.lens);
  const auto is_ring_seen = [&](int elevation_deg) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 2) {
      const double e = kDegree * elevation_deg;
      const double a = kDegree * azimuth_deg;
      if (!is_seen(models, cameras, {std::cos(e) * std::sin(a), -std::sin(e), std::cos(e) * std::cos(a)})) return false;
    }
    return true;
  };
  if (!is_ring_seen(0)) return std::nullopt;
  int lowest = 0;
  int highest = 0;
  while (lowest > -90 && is_ring_seen(lowest - 1)) --lowest;
  while (highest < 90 && is_ring_seen(highest + 1)) ++highest;
  // one degree of margin, since the stitcher samples more finely
  return std::pair<double, double>(lowest == -90 ? -90 : lowest + 1, highest == 90 ? 90 : highest - 1);
}

std::string extrinsics_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                            const Eigen::Matrix<double, 6, 1>& reference_mount) {
  const auto& m = reference_mount;
  const Eigen::Isometry3d base_from_reference = calibration_files::base_from_camera({m.head<3>(), m[5], m[4], m[3]});
  std::string text = fmt::format(
      "# Camera poses. reference_from_camera: 4 x 4, row by row, optical frames (x right, y down, z forward), m.\n"
      "# mount: driver parameter `mount`, on base_link (x forward, y left, z up): x, y, z in m; roll, pitch, yaw in "
      "degrees.\n"
      "reference: {}\ncameras:\n",
      cameras[reference].name);
  for (const auto& [name, camera] : cameras) {
    const Eigen::Isometry3d reference_from_camera = camera.camera_from_reference.inverse();
    const auto mount = mount_of(base_from_reference * reference_from_camera);
    text += fmt::format(
        "- name: {0}\n  camera_info: {0}.yaml\n  reference_from_camera: {1}\n  mount: [{2:.5f}, {3:.5f}, {4:.5f}, "
        "{5:.4f}, {6:.4f}, {7:.4f}]\n",
        name, numbers_of(reference_from_camera), rounded(mount[0], 1e5), rounded(mount[1], 1e5), rounded(mount[2], 1e5),
        rounded(mount[3], 1e4), rounded(mount[4], 1e4), rounded(mount[5], 1e4));
  }
  return text;
}

std::vector<NamedCamera> read_extrinsics(const std::filesystem::path& file) {
  YamlMap map(file, "an extrinsics.yaml of panvo calibrate");
  std::vector<NamedCamera> cameras;
  for (auto& entry : map.maps("cameras")) {
    NamedCamera camera{entry.text("name"), {}};
    camera.camera.camera_from_reference =
        calibration_files::read_rigid_transform(entry, "reference_from_camera").inverse();
    const std::string info = entry.text("camera_info");
    try {
      if (!info.empty()) camera.camera.lens = calibration_files::read_camera_info(file.parent_path() / info).lens();
    } catch (const calibration_files::FileError& error) {
      entry.include("camera_info", error);
    }
    cameras.push_back(camera);
  }
  map.check();
  return cameras;
}

std::string panorama_text(const std::vector<NamedCamera>& cameras, std::size_t reference,
                          std::pair<double, double> seen_elevation_deg) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& camera : cameras) middle += camera.camera.camera_from_reference.inverse().translation();
  middle /= static_cast<double>(cameras.size());
  std::string text = fmt::format(
      "# Panorama of calibrated heads: orientation of '{}', centred between the heads. "
      "Keys: components/panorama_stitcher/README.md.\n"
      "panorama:\n  frame_id: panorama_optical\n  radius_m: 15\n  seen_elevation_deg: [{:g}, {:g}]\nheads:\n",
      cameras[reference].name, seen_elevation_deg.first, seen_elevation_deg.second);
  for (const auto& [name, camera] : cameras) {
    Eigen::Isometry3d panorama_from_head = camera.camera_from_reference.inverse();
    panorama_from_head.translation() -= middle;
    text += fmt::format("- name: {0}\n  camera_info: {0}.yaml\n  panorama_from_head: {1}\n", name,
                        numbers_of(panorama_from_head));
  }
  return text;
}

}  // namespace panvo::calibration
