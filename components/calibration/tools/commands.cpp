// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "panvo/calibration/board_painting.hpp"
#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration/camchain_file.hpp"
#include "panvo/calibration/rectified_pair.hpp"
#include "panvo/calibration_files/stereo_pair.hpp"
#include "panvo/calibration_files/write_file.hpp"
#include "steps.hpp"

namespace panvo::calibration {
namespace {

namespace fs = std::filesystem;
using calibration_files::CameraInfo;
using calibration_files::read_camera_info;
using calibration_files::stereo_camera_infos;
using calibration_files::write_camera_info;
using calibration_files::write_file;

RigOptions options_of(const Arguments& arguments, std::size_t cameras) {
  RigOptions options;
  options.models.assign(cameras, model_of(arguments));
  options.lenses.assign(cameras, std::nullopt);
  return options;
}

void begin_with(const std::vector<CameraInfo>& infos, RigOptions& options) {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    options.lenses[i] = infos[i].lens();
    options.models[i] = options.lenses[i]->model;
  }
}

std::size_t reference_of(const Arguments& arguments, const std::vector<std::string>& cameras) {
  if (arguments.reference.empty()) return 0;
  const auto found = std::find(cameras.begin(), cameras.end(), arguments.reference);
  if (found == cameras.end())
    throw CalibrationError(fmt::format("--reference {}: no such camera; use the name of one of the folders, e.g. '{}'",
                                       arguments.reference, cameras[0]));
  return static_cast<std::size_t>(found - cameras.begin());
}

/// The board, which must not be symmetric: two cameras could number its corners from different ends, so that their
/// relative rotation would be ambiguous.
Board unmistakable_board(const Arguments& arguments) {
  const Board board = parse_board(arguments.board);
  if (board.is_symmetric())
    throw CalibrationError(fmt::format(
        "--board {}: looks the same upside down, so that cameras with different orientations may number its corners "
        "differently; use one with an even and an odd count (9x6), or a ChArUco board",
        arguments.board));
  return board;
}

Eigen::Matrix<double, 6, 1> mount_of(const Arguments& arguments) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(arguments.mount.data());
}

void note_written(const fs::path& folder, const std::string& files) {
  std::printf("\nwritten to %s: %s, report.html, coverage and residuals as SVG\n", folder.c_str(), files.c_str());
}

void write_infos(const std::pair<CameraInfo, CameraInfo>& infos, const fs::path& folder) {
  write_camera_info(folder / "left.yaml", infos.first);
  write_camera_info(folder / "right.yaml", infos.second);
}

void write_rig(const std::vector<NamedCamera>& cameras, std::size_t reference, const Arguments& arguments) {
  for (const auto& [name, camera] : cameras)
    write_camera_info(arguments.out / (name + ".yaml"), calibration_files::single_camera_info(name, camera.lens));
  write_file(arguments.out / "extrinsics.yaml", extrinsics_text(cameras, reference, mount_of(arguments)));
}

}  // namespace

void calibrate_stereo(const Arguments& arguments) {
  Report report;
  report.board = parse_board(arguments.board);
  const auto folder = images_of(arguments, report.board, {}, {"left", "right"});
  report.title = "Stereo calibration of " + fs::weakly_canonical(folder).filename().string();
  report.seen = detect(find_stereo_images(folder), report.board);
  auto options = options_of(arguments, 2);
  if (!arguments.calibration.empty()) begin_with(read_calibrations(arguments.calibration, report.seen), options);
  report.calibration = calibrate(report.seen, options);
  const auto& cameras = report.calibration.rig.cameras;
  report.pair = rectify(cameras[0], cameras[1]);
  report.epipolar = epipolar_errors(report.calibration.used, cameras[0].lens, cameras[1].lens, *report.pair);
  make_folder(arguments.out);
  write_infos(stereo_camera_infos(cameras[0].lens, cameras[1].lens, *report.pair), arguments.out);
  write_report(report, arguments.out);
  note_written(arguments.out, "left.yaml, right.yaml");
}

void calibrate_rig(const Arguments& arguments) {
  Report report;
  report.board = unmistakable_board(arguments);
  const auto folder = images_of(arguments, report.board, {});
  report.title = "Calibration of the rig " + fs::weakly_canonical(folder).filename().string();
  const auto images = find_rig_images(folder, arguments.cameras);
  report.reference = reference_of(arguments, images.cameras);
  report.seen = detect(images, report.board);
  auto options = options_of(arguments, images.cameras.size());
  options.reference = report.reference;
  report.calibration = calibrate(report.seen, options);
  make_folder(arguments.out);
  const auto cameras = named_cameras(report.calibration);
  write_rig(cameras, report.reference, arguments);
  const auto elevations = seen_elevations_deg(cameras);
  if (elevations) write_file(arguments.out / "panorama.yaml", panorama_text(cameras, report.reference, *elevations));
  write_report(report, arguments.out);
  if (!elevations) std::printf("\nno panorama.yaml: the cameras do not cover the full horizon\n");
  note_written(arguments.out, elevations ? "NAME.yaml of each camera, extrinsics.yaml, panorama.yaml"
                                         : "NAME.yaml of each camera, extrinsics.yaml");
}

void calibrate_extrinsics(const Arguments& arguments) {
  Report report;
  report.board = unmistakable_board(arguments);
  const auto folder = images_of(arguments, report.board, ViewGoals::of_poses());
  report.title = "Camera poses of " + fs::weakly_canonical(folder).filename().string();
  const auto images = find_rig_images(folder, arguments.cameras);
  report.reference = reference_of(arguments, images.cameras);
  report.seen = detect(images, report.board);
  auto options = options_of(arguments, images.cameras.size());
  begin_with(read_calibrations(arguments.calibration, report.seen), options);
  options.are_lenses_held = true;
  options.reference = report.reference;
  report.calibration = calibrate(report.seen, options);
  make_folder(arguments.out);
  write_rig(named_cameras(report.calibration), report.reference, arguments);
  write_report(report, arguments.out);
  note_written(arguments.out, "extrinsics.yaml, NAME.yaml of each camera");
}

bool check_stereo(const Arguments& arguments) {
  const Board board = parse_board(arguments.board);
  const auto observations = detect(find_stereo_images(arguments.images), board);
  const auto infos = read_calibrations(arguments.calibration, observations);
  const auto pair = calibration_files::stereo_pair(infos[0], infos[1]);
  const auto errors = epipolar_errors(observations, pair.calibration.left, pair.calibration.right, pair.rectified);
  const auto summary = summarise(errors);
  if (summary.corners == 0)
    throw CalibrationError(fmt::format("{}: no pair shows the board in both images; check the counts of --board",
                                       arguments.images.string()));
  std::printf("epipolar residual: rms %.3f px, mean %+.3f px, largest %.2f px, of %zu corners\n", summary.rms_px,
              summary.mean_px, summary.max_px, summary.corners);
  if (summary.rms_px <= arguments.limit_px) {
    std::printf("%s is still valid (limit %.2f px)\n", arguments.calibration.c_str(), arguments.limit_px);
    return true;
  }
  std::fprintf(
      stderr,
      "panvo calibrate: %s: rows are %.2f px off (limit %.2f px): the calibration is stale or belongs to other "
      "cameras; recalibrate: panvo calibrate stereo\n",
      arguments.calibration.c_str(), summary.rms_px, arguments.limit_px);
  return false;
}

void draw(const Arguments& arguments) {
  const Board board = parse_board(arguments.board);
  write_file(arguments.out, draw_board(board));
  std::printf("written: %s. Print it at 100 %%, measure a square, and give the measured side in --board\n",
              arguments.out.c_str());
}

void convert(const Arguments& arguments) {
  std::error_code error;
  const auto& input = arguments.images;
  if (!fs::is_directory(input, error)) {
    const auto cameras = read_camchain(input);
    make_folder(arguments.out);
    write_rig(cameras, 0, arguments);
    std::printf("written to %s: NAME.yaml of each camera, extrinsics.yaml", arguments.out.c_str());
    if (cameras.size() == 2) {
      try {
        const auto& [left, right] = std::tie(cameras[0].camera, cameras[1].camera);
        write_infos(stereo_camera_infos(left.lens, right.lens, rectify(left, right)), arguments.out);
        std::printf(", left.yaml (cam0), right.yaml (cam1)");
      } catch (const CalibrationError& problem) {
        std::printf("; no left.yaml and right.yaml: %s", problem.what());
      }
    }
    std::printf("\n");
    return;
  }
  std::vector<NamedCamera> cameras;
  if (fs::exists(input / "extrinsics.yaml", error)) {
    cameras = read_extrinsics(input / "extrinsics.yaml");
  } else {
    const auto pair =
        calibration_files::stereo_pair(read_camera_info(input / "left.yaml"), read_camera_info(input / "right.yaml"));
    const auto& [left, right, right_from_left] = pair.calibration;
    cameras = {{"left", {left}}, {"right", {right, right_from_left}}};
  }
  write_file(arguments.out, camchain_text(cameras));
  std::printf("written: %s\n", arguments.out.c_str());
}

}  // namespace panvo::calibration
