// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration_values.hpp"
#include "layouts.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"
#include "panvo/dataset_player/ground_truth.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "text_file.hpp"

namespace panvo::dataset_player {
namespace {

namespace fs = std::filesystem;
using calibration_files::YamlMap;

struct StampedImage {
  std::int64_t stamp_ns = 0;
  fs::path file;
};

/// The images listed in data.csv in order of time, whether their files exist or not.
std::vector<StampedImage> read_image_list(const fs::path& camera_folder) {
  const TextFile file(camera_folder / "data.csv", TextFile::Separator::kComma);
  std::vector<StampedImage> images;
  for (const auto& line : file.lines()) {
    const auto stamp_ns = file.nanoseconds(line, 0);
    if (!images.empty()) file.expect_later(line, images.back().stamp_ns, stamp_ns);
    const auto& name = file.text(line, 1);
    if (name.empty()) file.fail(line, "has no image file name in field 2; correct or remove the line");
    images.push_back({stamp_ns, camera_folder / "data" / name});
  }
  if (images.empty()) throw DatasetError(file.path().string() + ": lists no images; copy the data set again");
  return images;
}

vision::LensCamera read_eye(YamlMap& sensor) {
  if (const auto model = sensor.text("camera_model", "pinhole"); model != "pinhole") {
    sensor.reject("camera_model", "is '" + model + "'; the stereo cameras cam0 and cam1 must be pinhole");
  }
  const auto [width, height] = sensor.size_px("resolution");
  const auto intrinsics = sensor.numbers("intrinsics", 4);
  return lens(sensor, "distortion_coefficients", sensor.text("distortion_model", "radial-tangential"),
              {intrinsics[0], intrinsics[1], intrinsics[2], intrinsics[3], width, height});
}

std::int64_t median_period_ns(const std::vector<StampedImage>& images) {
  if (images.size() < 2) return 0;
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < images.size(); ++i) periods.push_back(images[i].stamp_ns - images[i - 1].stamp_ns);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

std::size_t nearest(const std::vector<StampedImage>& images, std::int64_t stamp_ns) {
  const auto after =
      std::lower_bound(images.begin(), images.end(), stamp_ns,
                       [](const StampedImage& image, std::int64_t stamp) { return image.stamp_ns < stamp; });
  if (after == images.begin()) return 0;
  const auto index = static_cast<std::size_t>(after - images.begin());
  if (after == images.end() || stamp_ns - images[index - 1].stamp_ns <= after->stamp_ns - stamp_ns) return index - 1;
  return index;
}

/// Pairs images that are mutually nearest in time and less than half a period apart; both get the left stamp. Usually
/// the stamps are equal, but some recorders stamp each camera separately.
std::vector<StereoFrame> pair_by_stamp(const std::vector<StampedImage>& left, const std::vector<StampedImage>& right,
                                       std::vector<std::string>& notes) {
  const auto period_ns = median_period_ns(left);
  std::vector<StereoFrame> frames;
  std::size_t alone = right.size(), missing_files = 0;
  std::int64_t max_gap_ns = 0;
  fs::path first_missing;
  for (std::size_t l = 0; l < left.size(); ++l) {
    const auto r = nearest(right, left[l].stamp_ns);
    const auto gap_ns = std::abs(right[r].stamp_ns - left[l].stamp_ns);
    if (nearest(left, right[r].stamp_ns) != l || (gap_ns > 0 && 2 * gap_ns >= period_ns)) {
      ++alone;
      continue;
    }
    --alone;
    const bool left_is_there = fs::exists(left[l].file);
    if (!left_is_there || !fs::exists(right[r].file)) {
      if (missing_files++ == 0) first_missing = left_is_there ? right[r].file : left[l].file;
      continue;
    }
    max_gap_ns = std::max(max_gap_ns, gap_ns);
    frames.push_back({left[l].stamp_ns, left[l].file, right[r].file});
  }
  if (alone > 0)
    notes.push_back(fmt::format("{} images of cam0 and cam1 have no partner at the same time and are skipped", alone));
  if (missing_files > 0) {
    notes.push_back(fmt::format("{} pairs lack an image file and are skipped, the first: {}", missing_files,
                                first_missing.string()));
  }
  if (max_gap_ns > 0) {
    notes.push_back(
        fmt::format("left and right stamps differ by up to {:.3f} ms; both images of a pair get the left stamp",
                    static_cast<double>(max_gap_ns) * 1e-6));
  }
  return frames;
}

StereoRecording read_stereo(const fs::path& root, std::vector<std::string>& notes) {
  for (const char* camera : {"cam0", "cam1"}) {
    if (!fs::is_directory(root / camera)) {
      throw DatasetError((root / camera).string() + ": is missing; both cameras (cam0 left, cam1 right) are needed");
    }
  }
  YamlMap left(root / "cam0" / "sensor.yaml", kSensorFile);
  YamlMap right(root / "cam1" / "sensor.yaml", kSensorFile);
  StereoRecording stereo;
  stereo.frames = pair_by_stamp(read_image_list(root / "cam0"), read_image_list(root / "cam1"), notes);
  if (stereo.frames.empty()) {
    throw DatasetError((root / "cam0" / "data.csv").string() + ": no image has a partner at the same time in " +
                       (root / "cam1" / "data.csv").string() + " with both files present; copy the data set again");
  }
  stereo.base_from_left = read_base_from_sensor(left);
  stereo.calibration.left = read_eye(left);
  stereo.calibration.right = read_eye(right);
  stereo.calibration.right_from_left = read_base_from_sensor(right).inverse() * stereo.base_from_left;
  left.check();
  right.check();
  stereo.rectified = rectified_geometry(stereo.calibration, right.file());
  expect_image_size(stereo.calibration.left.pinhole, left.file(), stereo.frames);
  return stereo;
}

std::optional<PanoramaRecording> read_panorama(const fs::path& folder, std::vector<std::string>& notes) {
  if (!fs::exists(folder / "sensor.yaml")) return std::nullopt;
  YamlMap sensor(folder / "sensor.yaml", kSensorFile);
  if (const auto model = sensor.text("camera_model", "none"); model != "equirectangular") {
    notes.push_back(fmt::format("{}: camera_model is '{}', not 'equirectangular': cam2 is not played",
                                sensor.file().string(), model));
    return std::nullopt;
  }
  PanoramaRecording panorama;
  const auto [width, height] = sensor.size_px("resolution");
  panorama.width = width;
  panorama.height = height;
  panorama.base_from_panorama = read_base_from_sensor(sensor);
  sensor.check();
  std::size_t missing_files = 0;
  for (const auto& image : read_image_list(folder)) {
    if (fs::exists(image.file)) {
      panorama.frames.push_back({image.stamp_ns, image.file});
    } else {
      ++missing_files;
    }
  }
  if (panorama.frames.empty())
    throw DatasetError((folder / "data").string() + ": contains none of the images listed in data.csv; copy it again");
  if (missing_files > 0)
    notes.push_back(fmt::format("{} panoramas of {} are missing and are skipped", missing_files, folder.string()));
  cv::Mat first;
  ImageDecoder decoder;
  if (const auto problem = decoder.decode(panorama.frames.front().image, Colour::kAsStored, first))
    throw DatasetError(*problem + "; copy it again");
  if (first.cols != panorama.width || first.rows != panorama.height) {
    sensor.reject("resolution",
                  fmt::format("is {} x {} px, but {} is {} x {} px; correct it", panorama.width, panorama.height,
                              panorama.frames.front().image.string(), first.cols, first.rows));
    sensor.check();
  }
  return panorama;
}

std::vector<GroundTruthPose> read_ground_truth(const fs::path& root, std::vector<std::string>& notes) {
  if (const auto file = find_euroc_ground_truth(root)) return read_euroc_poses(*file);
  if (fs::exists(root / "leica0")) {
    notes.push_back("leica0 holds positions of a prism, not poses of the body: it is not published as ground truth");
  }
  return {};
}

}  // namespace

fs::path euroc_root(const fs::path& directory) {
  return fs::is_directory(directory / "mav0") ? directory / "mav0" : directory;
}

Eigen::Isometry3d read_base_from_sensor(YamlMap& sensor) {
  const Eigen::Matrix4d matrix = calibration_files::read_rigid_matrix(sensor, "T_BS");
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  Eigen::Isometry3d base_from_sensor = Eigen::Isometry3d::Identity();
  base_from_sensor.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  base_from_sensor.translation() = matrix.topRightCorner<3, 1>();
  return base_from_sensor;
}

std::optional<PanoramaRecording> open_panorama(const fs::path& directory, std::vector<std::string>& notes) {
  return with_dataset_error([&] { return read_panorama(euroc_root(directory) / "cam2", notes); });
}

bool looks_like_euroc(const fs::path& directory) {
  return fs::is_directory(directory / "mav0") || fs::exists(directory / "cam0" / "data.csv") ||
         fs::exists(directory / "cam2" / "data.csv");
}

Dataset read_euroc(const fs::path& directory, const ReadOptions&) {
  const auto root = euroc_root(directory);
  Dataset dataset;
  dataset.kind = "EuRoC/ASL";
  dataset.directory = directory;
  dataset.panorama = open_panorama(directory, dataset.notes);
  // Panoramas alone are a valid recording. Without any camera, read_stereo() reports what is missing.
  if (!dataset.panorama || fs::exists(root / "cam0") || fs::exists(root / "cam1"))
    dataset.stereo = read_stereo(root, dataset.notes);
  dataset.imu = read_euroc_imu(root / "imu0");
  dataset.ground_truth = read_ground_truth(root, dataset.notes);
  return dataset;
}

}  // namespace panvo::dataset_player
