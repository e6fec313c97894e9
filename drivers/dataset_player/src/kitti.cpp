// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <functional>
#include <map>

#include "calibration_values.hpp"
#include "layouts.hpp"
#include "panvo/dataset_player/ground_truth.hpp"
#include "panvo/interfaces/check.hpp"
#include "text_file.hpp"

namespace panvo::dataset_player {
namespace {

namespace fs = std::filesystem;

constexpr double kKittiRateHz = 10.0;

struct Eyes {
  const char* left_folder;
  const char* right_folder;
  const char* left_projection;
  const char* right_projection;
};
constexpr Eyes kGrey{"image_0", "image_1", "P0:", "P1:"};
constexpr Eyes kColoured{"image_2", "image_3", "P2:", "P3:"};

/// Reads the projection matrices of calib.txt, from the frame of camera 0 to pixels of each rectified camera.
std::map<std::string, RowMajor34d> read_projections(const TextFile& file) {
  std::map<std::string, RowMajor34d> projections;
  for (const auto& line : file.lines()) {
    if (line.fields.front().size() != 3 || line.fields.front().front() != 'P') continue;
    RowMajor34d projection;
    for (int i = 0; i < 12; ++i) projection(i / 4, i % 4) = file.number(line, static_cast<std::size_t>(i) + 1);
    if (projection(0, 0) == 0.0 || projection(1, 1) == 0.0)
      file.fail(line, "has a focal length of zero; copy calib.txt again");
    projections[line.fields.front()] = projection;
  }
  return projections;
}

/// Position of camera 0 in the frame of the camera with this projection, m.
Eigen::Vector3d translation(const RowMajor34d& projection) {
  return projection.leftCols<3>().inverse() * projection.col(3);
}

/// Reads the camera geometry. The pair is already rectified; base_link is at camera 0, to which poses.txt refers.
void read_calibration(const fs::path& path, const Eyes& eyes, StereoRecording& stereo) {
  const TextFile file(path, TextFile::Separator::kBlank);
  const auto projections = read_projections(file);
  for (const char* name : {eyes.left_projection, eyes.right_projection}) {
    if (!projections.contains(name))
      throw DatasetError(fmt::format("{}: has no line {} for {}", path.string(), name, eyes.left_folder));
    if (!(translation(projections.at(name)).cwiseAbs().maxCoeff() <= interfaces::kMaxCoordinate_m)) {  // nor NaN
      throw DatasetError(
          fmt::format("{}: {} places no camera near camera 0; copy calib.txt again", path.string(), name));
    }
  }
  const auto& left = projections.at(eyes.left_projection);
  const auto& right = projections.at(eyes.right_projection);
  const auto size = stereo_image_size(stereo.frames);
  const auto camera = [&](const RowMajor34d& p) {
    return vision::PinholeCamera{p(0, 0), p(1, 1), p(0, 2), p(1, 2), size.width, size.height};
  };
  auto& calibration = stereo.calibration;
  calibration.left.pinhole = camera(left);
  calibration.right.pinhole = camera(right);
  // The colour cameras are a few mm off camera 0's row and plane, but their images are rectified: they differ only in
  // X.
  calibration.right_from_left.translation().x() = translation(right).x() - translation(left).x();
  stereo.rectified = rectified_geometry(calibration, path);
  stereo.base_from_left = base_from_optical() * Eigen::Translation3d(-translation(left));
}

/// Returns a function for the stamp of a pair: from times.txt, line i for image i, or from the frame rate without that
/// file.
std::function<std::int64_t(const NumberedPair&)> read_clock(const fs::path& times_path, const ReadOptions& options,
                                                            std::vector<std::string>& notes) {
  if (fs::exists(times_path)) {
    return [times_path, stamps_ns = read_kitti_times(times_path)](const NumberedPair& pair) {
      if (pair.number < stamps_ns.size()) return stamps_ns[pair.number];
      throw DatasetError(
          fmt::format("{}: has {} times, but none for image {}; copy the file again, or remove it to play at {} Hz",
                      times_path.string(), stamps_ns.size(), pair.left.filename().string(), kKittiRateHz));
    };
  }
  if (options.rate_hz <= 0.0)
    notes.push_back(fmt::format("no times.txt: {} Hz is assumed (parameter rate_hz)", kKittiRateHz));
  const double rate_hz = options.rate_hz > 0.0 ? options.rate_hz : kKittiRateHz;
  return [rate_hz](const NumberedPair& pair) { return stamp_at(pair.number, rate_hz, pair.left); };
}

}  // namespace

bool looks_like_kitti(const fs::path& directory) {
  return fs::exists(directory / "calib.txt") || fs::is_directory(directory / "image_0") ||
         fs::is_directory(directory / "image_2");
}

Dataset read_kitti(const fs::path& directory, const ReadOptions& options) {
  Dataset dataset;
  dataset.kind = "KITTI odometry";
  dataset.directory = directory;
  const bool grey = fs::is_directory(directory / kGrey.left_folder) || fs::is_directory(directory / kGrey.right_folder);
  const Eyes& eyes = grey ? kGrey : kColoured;
  const auto folders = pair_by_number(directory / eyes.left_folder, directory / eyes.right_folder, dataset.notes);

  const auto stamp_of = read_clock(directory / "times.txt", options, dataset.notes);
  const auto poses_path = find_kitti_ground_truth(directory);
  const auto poses = poses_path ? read_kitti_poses(*poses_path) : std::vector<Eigen::Isometry3d>();

  StereoRecording stereo;
  for (const auto& pair : folders.pairs) {
    const auto stamp_ns = stamp_of(pair);
    stereo.frames.push_back({stamp_ns, pair.left, pair.right});
    if (pair.number < poses.size()) dataset.ground_truth.push_back({stamp_ns, poses[pair.number]});
  }
  if (poses_path && dataset.ground_truth.size() < stereo.frames.size()) {
    dataset.notes.push_back(fmt::format("{} has {} poses: the last {} of {} frames have no ground truth",
                                        poses_path->string(), poses.size(),
                                        stereo.frames.size() - dataset.ground_truth.size(), stereo.frames.size()));
  }
  read_calibration(directory / "calib.txt", eyes, stereo);
  dataset.stereo = std::move(stereo);
  return dataset;
}

}  // namespace panvo::dataset_player
