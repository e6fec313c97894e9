// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/camchain_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"

namespace panvo::calibration {
namespace {

using calibration_files::YamlMap;
using vision::LensModel;

constexpr const char* kKind = "a Kalibr camchain YAML with cam0, cam1, ...";

struct Intrinsics {
  double xi = 0.0;  ///< omni
  vision::PinholeCamera pinhole;
};

Intrinsics read_intrinsics(YamlMap& camera, bool is_omni) {
  const auto [width, height] = camera.size_px("resolution");
  const std::size_t problems = camera.problems();
  auto values = camera.numbers("intrinsics", is_omni ? 5 : 4);
  Intrinsics intrinsics;
  if (is_omni) {
    intrinsics.xi = values.front();
    values.erase(values.begin());
  }
  if (camera.problems() == problems && !(values[0] > 0.0 && values[1] > 0.0))
    camera.reject("intrinsics", "must have positive focal lengths");
  intrinsics.pinhole = {values[0], values[1], values[2], values[3], width, height};
  return intrinsics;
}

vision::LensCamera read_lens(YamlMap& camera) {
  const std::size_t problems = camera.problems();
  const bool is_omni = camera.choice("camera_model", {"pinhole", "omni"}) == "omni";
  const auto intrinsics = read_intrinsics(camera, is_omni);
  const std::string distortion = camera.text("distortion_model");
  auto coefficients = distortion == "none" ? std::vector<double>() : camera.numbers("distortion_coeffs", 4);
  if (is_omni && distortion != "radtan" && distortion != "none")
    camera.reject("distortion_model", fmt::format("is '{}', which is not supported with camera_model omni; calibrate "
                                                  "with omni-radtan",
                                                  distortion));
  if (camera.problems() > problems) return {};
  if (is_omni) {
    coefficients.resize(4, 0.0);
    coefficients.push_back(intrinsics.xi);
  }
  try {
    const std::string model = is_omni ? "mei" : distortion == "none" ? "" : distortion;
    return vision::lens_camera(model, coefficients, intrinsics.pinhole);
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
    const auto coefficients = vision::ros_coefficients(lens);
    const bool is_unknown =
        lens.model == LensModel::kRational || (lens.model == LensModel::kPlumbBob && coefficients[4] != 0.0);
    if (is_unknown)
      throw CalibrationError(fmt::format(
          "{}: Kalibr's radtan has neither k3 nor a rational polynomial; recalibrate without them", cameras[i].name));
    const bool is_omni = lens.model == LensModel::kMei;
    text += fmt::format("cam{}:\n", i);
    if (i > 0)
      text += "  T_cn_cnm1:\n" + rows_of(camera_from_reference * cameras[i - 1].camera.camera_from_reference.inverse());
    const auto& p = lens.pinhole;
    text += fmt::format("  camera_model: {}\n  distortion_model: {}\n  distortion_coeffs: [{:.12g}]\n",
                        is_omni ? "omni" : "pinhole", lens.model == LensModel::kEquidistant ? "equidistant" : "radtan",
                        fmt::join(coefficients.begin(), coefficients.begin() + 4, ", "));
    text += fmt::format("  intrinsics: [{}{:.12g}, {:.12g}, {:.12g}, {:.12g}]\n  resolution: [{}, {}]\n",
                        is_omni ? fmt::format("{:.12g}, ", lens.xi) : "", p.fx, p.fy, p.cx, p.cy, p.width, p.height);
    text += fmt::format("  rostopic: /{}/image_raw\n", cameras[i].name);
  }
  return text;
}

}  // namespace panvo::calibration
