// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/camchain_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/vision/pose.hpp"
#include "yaml_document.hpp"

namespace panvo::calibration {
namespace {

using vision::LensModel;

constexpr double kRotationTolerance = 1e-3;
constexpr const char* kKind = "a Kalibr camchain YAML with cam0, cam1, ...";

std::optional<vision::KalibrForm> kalibr_form(LensModel model) {
  return vision::visit_lens(model, [](const auto& formula) { return formula.kKalibr; });
}

/// The model with Kalibr's names of a camera. A distortion of "none" stands for any with coefficients that are zero.
LensModel model_of(const YamlDocument& camera) {
  const std::string projection = camera.text("camera_model");
  const std::string distortion = camera.text("distortion_model");
  std::set<std::string> projections, distortions;
  for (const auto model : vision::kLensModels) {
    const auto form = kalibr_form(model);
    if (!form) continue;
    projections.emplace(form->camera_model);
    if (form->camera_model != projection) continue;
    if (distortion == "none" || form->distortion_model == distortion) return model;
    distortions.insert(fmt::format("{}-{}", projection, form->distortion_model));
  }
  if (distortions.empty())
    camera.fail("camera_model",
                fmt::format("'{}' is not supported; calibrate with {}", projection, fmt::join(projections, " or ")));
  camera.fail("distortion_model", fmt::format("'{}' is not supported with camera_model {}; calibrate with {}",
                                              distortion, projection, fmt::join(distortions, " or ")));
}

/// How Kalibr writes the lens of a camera. Throws CalibrationError if it cannot.
vision::KalibrForm checked_form(const NamedCamera& camera) {
  const auto& lens = camera.camera.lens;
  const auto form = kalibr_form(lens.model);
  const auto fail = [&](const std::string& what) {
    throw CalibrationError(fmt::format("{}: Kalibr {}; calibrate with another --model", camera.name, what));
  };
  if (!form) fail(fmt::format("has no lens model {}", vision::ros_name(lens.model)));
  const auto coefficients = vision::lens_coefficients(lens.model);
  for (std::size_t i = form->distortion_count + form->intrinsic_count; i < coefficients.size(); ++i) {
    if (lens.distortion.at(i) == 0.0) continue;
    fail(fmt::format("has no {} in {}-{}", coefficients[i].name, form->camera_model, form->distortion_model));
  }
  return *form;
}

vision::LensCamera read_lens(const YamlDocument& camera) {
  const LensModel model = model_of(camera);
  const auto form = *kalibr_form(model);
  const bool is_distorted = camera.text("distortion_model") != "none";
  const auto size = camera.numbers("resolution", 2);
  const auto intrinsics = camera.numbers("intrinsics", form.intrinsic_count + 4);
  const auto focal = intrinsics.begin() + static_cast<std::ptrdiff_t>(form.intrinsic_count);
  const vision::PinholeCamera pinhole{
      focal[0], focal[1], focal[2], focal[3], static_cast<int>(size[0]), static_cast<int>(size[1])};
  if (pinhole.width <= 0 || pinhole.height <= 0) camera.fail("resolution", "must be width and height in px");
  if (!(pinhole.fx > 0.0 && pinhole.fy > 0.0)) camera.fail("intrinsics", "must have positive focal lengths");
  auto coefficients = is_distorted ? camera.numbers("distortion_coeffs", form.distortion_count)
                                   : std::vector<double>(form.distortion_count, 0.0);
  coefficients.insert(coefficients.end(), intrinsics.begin(), focal);
  try {
    return vision::lens_camera(vision::ros_name(model), coefficients, pinhole);
  } catch (const std::invalid_argument& error) {
    camera.fail("distortion_model", std::string(": the camera ") + error.what());
  }
}

Eigen::Isometry3d read_step(const YamlDocument& camera) {
  const auto values = camera.numbers("T_cn_cnm1", 16);
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > kRotationTolerance ||
      rotation.determinant() < 0.0)
    camera.fail("T_cn_cnm1", "is not a rigid transform (4 x 4, row by row)");
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.linear() = vision::nearest_rotation(rotation);
  step.translation() = matrix.topRightCorner<3, 1>();
  return step;
}

std::string rows_of(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row)
    text += fmt::format("  - [{:.10g}, {:.10g}, {:.10g}, {:.10g}]\n", pose.matrix()(row, 0), pose.matrix()(row, 1),
                        pose.matrix()(row, 2), pose.matrix()(row, 3));
  return text;
}

}  // namespace

std::vector<NamedCamera> read_camchain(const std::filesystem::path& file) {
  const YamlDocument chain(file, kKind);
  std::vector<NamedCamera> cameras;
  for (std::size_t i = 0;; ++i) {
    const std::string name = fmt::format("cam{}", i);
    if (!chain.has(name.c_str())) break;
    const YAML::Node node = chain.at(name.c_str());
    if (!node.IsMap()) chain.fail(name.c_str(), "must be a map of `key: value` lines");
    const YamlDocument camera(file, node);
    NamedCamera named{name, {read_lens(camera)}};
    if (i > 0) named.camera.camera_from_reference = read_step(camera) * cameras.back().camera.camera_from_reference;
    cameras.push_back(named);
  }
  if (cameras.empty()) throw CalibrationError(fmt::format("{}: cam0 is missing; expected {}", file.string(), kKind));
  return cameras;
}

std::string camchain_text(const std::vector<NamedCamera>& cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto& [lens, camera_from_reference] = cameras[i].camera;
    const auto form = checked_form(cameras[i]);
    const auto coefficients = vision::ros_coefficients(lens);
    const auto intrinsics = coefficients.begin() + static_cast<std::ptrdiff_t>(form.distortion_count);
    const auto end = intrinsics + static_cast<std::ptrdiff_t>(form.intrinsic_count);
    text += fmt::format("cam{}:\n", i);
    if (i > 0)
      text += "  T_cn_cnm1:\n" + rows_of(camera_from_reference * cameras[i - 1].camera.camera_from_reference.inverse());
    const auto& p = lens.pinhole;
    text += fmt::format("  camera_model: {}\n  distortion_model: {}\n  distortion_coeffs: [{:.12g}]\n",
                        form.camera_model, form.distortion_model, fmt::join(coefficients.begin(), intrinsics, ", "));
    text += fmt::format("  intrinsics: [{:.12g}{}{:.12g}, {:.12g}, {:.12g}, {:.12g}]\n  resolution: [{}, {}]\n",
                        fmt::join(intrinsics, end, ", "), form.intrinsic_count > 0 ? ", " : "", p.fx, p.fy, p.cx, p.cy,
                        p.width, p.height);
    text += fmt::format("  rostopic: /{}/image_raw\n", cameras[i].name);
  }
  return text;
}

}  // namespace panvo::calibration
