// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/camchain_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <stdexcept>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"

namespace panvo::calibration {
namespace {

using calibration_files::YamlMap;
using vision::LensModel;

constexpr const char* kKind = "a Kalibr camchain YAML with cam0, cam1, ...";

std::optional<vision::KalibrForm> kalibr_form(LensModel model) {
  return vision::visit_lens(model, [](const auto& formula) { return formula.kKalibr; });
}

/// The model with Kalibr's names of a camera; nullopt, after a problem is added, if there is none. A distortion of "none"
/// stands for any with coefficients that are zero.
std::optional<LensModel> read_model(YamlMap& camera) {
  std::set<std::string> projections;
  for (const auto model : vision::kLensModels) {
    if (const auto form = kalibr_form(model)) projections.emplace(form->camera_model);
  }
  const std::string projection = camera.choice("camera_model", {projections.begin(), projections.end()});
  const std::string distortion = camera.text("distortion_model");
  std::set<std::string> distortions;
  for (const auto model : vision::kLensModels) {
    const auto form = kalibr_form(model);
    if (!form || form->camera_model != projection) continue;
    if (distortion == "none" || form->distortion_model == distortion) return model;
    distortions.insert(fmt::format("{}-{}", projection, form->distortion_model));
  }
  if (!distortions.empty() && !distortion.empty())
    camera.reject("distortion_model", fmt::format("is '{}', which is not supported with camera_model {}; calibrate "
                                                  "with {}",
                                                  distortion, projection, fmt::join(distortions, " or ")));
  return std::nullopt;
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

vision::LensCamera read_lens(YamlMap& camera) {
  const std::size_t problems = camera.problems();
  const auto model = read_model(camera);
  const auto [width, height] = camera.size_px("resolution");
  if (!model) return {};
  const auto form = *kalibr_form(*model);
  const auto intrinsics = camera.numbers("intrinsics", form.intrinsic_count + 4);
  const auto focal = intrinsics.begin() + static_cast<std::ptrdiff_t>(form.intrinsic_count);
  if (camera.problems() == problems && !(focal[0] > 0.0 && focal[1] > 0.0))
    camera.reject("intrinsics", "must have positive focal lengths");
  const bool is_distorted = camera.text("distortion_model") != "none";
  auto coefficients = is_distorted ? camera.numbers("distortion_coeffs", form.distortion_count)
                                   : std::vector<double>(form.distortion_count, 0.0);
  if (camera.problems() > problems) return {};
  coefficients.insert(coefficients.end(), intrinsics.begin(), focal);
  try {
    return vision::lens_camera(vision::ros_name(*model), coefficients,
                               {focal[0], focal[1], focal[2], focal[3], width, height});
  } catch (const std::invalid_argument& error) {
    camera.reject("distortion_model", fmt::format("cannot be used: the camera {}", error.what()));
    return {};
  }
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
  YamlMap chain(file, kKind);
  if (!chain.has("cam0")) chain.reject("cam0", fmt::format("is missing; expected {}", kKind));
  std::vector<NamedCamera> cameras;
  for (std::size_t i = 0; chain.has(fmt::format("cam{}", i)); ++i) {
    const std::string name = fmt::format("cam{}", i);
    YamlMap camera = chain.map(name);
    NamedCamera named{name, {read_lens(camera)}};
    if (i > 0)
      named.camera.camera_from_reference =
          calibration_files::read_rigid_transform(camera, "T_cn_cnm1") * cameras.back().camera.camera_from_reference;
    cameras.push_back(named);
  }
  chain.check();
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
