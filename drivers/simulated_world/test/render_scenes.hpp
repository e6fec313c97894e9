// SPDX-License-Identifier: Apache-2.0
// Small scenes and a camera for the tests of the renderer.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/simulated_world/camera_rays.hpp"
#include "panvo/simulated_world/renderer.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::simulated_world {

/// The campus's materials; only those of the test scenes are painted, as the others take seconds.
inline std::shared_ptr<const Palette> scene_palette(Season season = Season::kSummer, bool wet = false) {
  const std::vector<std::string> used{"asphalt", "brick_red", "car_paint", "glass", "grass", "leaves_broad", "marking"};
  return std::make_shared<const Palette>(1, "", season, wet, used);
}
inline std::shared_ptr<const Palette> campus_palette() {
  static const auto made = scene_palette();
  return made;
}
inline std::uint16_t campus_material(std::string_view name) { return campus_palette()->find(name); }

/// A matte, even material, apart from its texture.
inline std::uint16_t plain_material() {
  const auto plain = campus_material("marking");
  const Material& one = campus_palette()->materials()[plain];
  if (one.overlay || one.has_holes || one.gloss > 0.0f || one.translucency > 0.0f)
    throw std::runtime_error("the marking is not a plain material");
  return plain;
}
inline constexpr Tint kWhite{255, 255, 255, 0}, kBlack{0, 0, 0, 0};  // without texture

inline std::shared_ptr<Scene> empty_scene() {
  static const auto sky = std::make_shared<const Sky>(1);
  auto scene = std::make_shared<Scene>();
  scene->palette = campus_palette();
  scene->sky = sky;
  return scene;
}

/// A square of `side` m facing along `normal`, rotated by `angle` in its plane.
inline void add_square(Mesh& mesh, const Eigen::Vector3f& middle, const Eigen::Vector3f& normal, float side, Tint tint,
                       float angle = 0.0f, std::string_view name = {}) {
  const Eigen::Vector3f across =
      Eigen::AngleAxisf(angle, normal.normalized()) * Eigen::Vector3f(normal.unitOrthogonal() * (0.5f * side));
  const Eigen::Vector3f along = normal.normalized().cross(across);
  mesh.add_quad(middle - across - along, middle + across - along, middle + across + along, middle - across + along,
                name.empty() ? plain_material() : campus_material(name), Eigen::Vector2f::Zero(), tint);
}

/// A camera at `place` that looks along world +x, turned left by `yaw`.
inline Eigen::Isometry3d looking(const Eigen::Vector3d& place, double yaw = 0.0) {
  Eigen::Matrix3d world_from_ahead;
  world_from_ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * world_from_ahead;
  pose.translation() = place;
  return pose;
}
inline Shot still(const Eigen::Isometry3d& pose, std::uint32_t visibility = kToStereo) {
  return {pose, pose, visibility};
}

inline vision::LensCamera camera() {
  vision::LensCamera camera;
  camera.pinhole = {230.0, 231.0, 162.5, 118.25, 320, 240};
  camera.distortion = {-0.28, 0.074, 0.0002, -0.0003, 0.0};
  return camera;
}

/// The pixel at which the camera sees a point.
inline Eigen::Vector2d pixel_of(const Eigen::Vector3d& point_in_camera) {
  return vision::CameraModel(camera()).project(point_in_camera).value();
}

inline float grey(const cv::Mat& image, int row, int column) {
  const auto colour = image.at<cv::Vec3f>(row, column);
  return (colour[0] + colour[1] + colour[2]) / 3.0f;
}

inline Light plain_light() {
  Light light;
  light.haze_per_m = 0.0f;
  return light;
}

/// A plain with a box on it; the only model is a car.
inline std::shared_ptr<Scene> yard() {
  auto scene = empty_scene();
  Mesh mesh;
  add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, {}, 0.0f, "asphalt");
  Eigen::Isometry3f box = Eigen::Isometry3f::Identity();
  box.translation() = Eigen::Vector3f(8.0f, 0.5f, 1.0f);
  mesh.add_box(box, {1.0f, 2.0f, 2.0f}, campus_material("brick_red"));
  scene->fixed.push_back(mesh);
  Mesh car;
  Eigen::Isometry3f body = Eigen::Isometry3f::Identity();
  body.translation() = Eigen::Vector3f(0.0f, 0.0f, 0.8f);
  car.add_box(body, {4.0f, 1.8f, 1.2f}, campus_material("car_paint"));
  scene->models.push_back(car);
  return scene;
}

inline MovingPlacement car_at(float x, float y, std::uint32_t visibility = kToAll) {
  MovingPlacement mover;
  mover.at_opening.model = 0;
  mover.at_opening.world_from_model = Eigen::Translation3f(x, y, 0.0f) * Eigen::Affine3f::Identity();
  mover.at_opening.visibility = visibility;
  mover.world_from_model_closed = mover.at_opening.world_from_model;
  return mover;
}

}  // namespace panvo::simulated_world
