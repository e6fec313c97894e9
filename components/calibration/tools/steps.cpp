// SPDX-License-Identifier: Apache-2.0
#include "steps.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/calibration_files/write_file.hpp"

namespace panvo::calibration {

namespace fs = std::filesystem;

vision::LensModel model_of(const Arguments& arguments) {
  if (const auto model = vision::find_lens_model(arguments.model)) return *model;
  throw CalibrationError("--model " + arguments.model + ": unknown lens model");
}

fs::path images_of(const Arguments& arguments, const Board& board, const ViewGoals& goals,
                   const std::vector<std::string>& names) {
  if (!arguments.images.empty()) return arguments.images;
  auto live = arguments.live;
  live.out = arguments.out / "images";
  live.names = names;
  live.goals = goals;
  gather_images(live, board);
  return live.out;
}

Observations detect(const ImageSets& images, const Board& board) {
  const bool is_terminal = isatty(STDERR_FILENO) == 1;
  auto observations = detect_boards(images, board, [&](std::size_t done, std::size_t of) {
    if (is_terminal) std::fprintf(stderr, "\rdetecting the board: %zu of %zu", done, of);
  });
  if (is_terminal) std::fputs("\r\033[K", stderr);
  return observations;
}

std::vector<calibration_files::CameraInfo> read_calibrations(const fs::path& folder, const Observations& observations) {
  std::vector<calibration_files::CameraInfo> infos;
  for (std::size_t i = 0; i < observations.cameras.size(); ++i) {
    const fs::path file = folder / (observations.cameras[i] + ".yaml");
    infos.push_back(calibration_files::read_camera_info(file));
    const auto& size = observations.image_sizes[i];
    const auto& info = infos.back();
    if (info.width != size.width || info.height != size.height)
      throw CalibrationError(fmt::format(
          "{}: image_width and image_height: the calibration is for {} x {} px, but the images of {} are {} x {} px; "
          "calibrate at the size of the camera's images",
          file.string(), info.width, info.height, observations.cameras[i], size.width, size.height));
  }
  return infos;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw CalibrationError(fmt::format("{}: cannot create the folder; choose another with --out", folder.string()));
}

std::vector<NamedCamera> named_cameras(const RigCalibration& calibration) {
  std::vector<NamedCamera> cameras;
  for (std::size_t i = 0; i < calibration.rig.cameras.size(); ++i)
    cameras.push_back({calibration.used.cameras[i], calibration.rig.cameras[i]});
  return cameras;
}

void write_report(const Report& report, const fs::path& folder) {
  for (std::size_t i = 0; i < report.calibration.used.cameras.size(); ++i) {
    const auto& name = report.calibration.used.cameras[i];
    calibration_files::write_file(folder / ("coverage_" + name + ".svg"), coverage_svg(report, i));
    calibration_files::write_file(folder / ("residuals_" + name + ".svg"), residual_svg(report, i));
  }
  calibration_files::write_file(folder / "report.html", to_page(report));
  std::fputs(to_text(report).c_str(), stdout);
}

}  // namespace panvo::calibration
