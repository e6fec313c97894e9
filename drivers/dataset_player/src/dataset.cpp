// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "layouts.hpp"
#include "panvo/calibration_files/mount.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/interfaces/stamp_range.hpp"

namespace panvo::dataset_player {

namespace fs = std::filesystem;

Dataset open_dataset(const fs::path& directory, const ReadOptions& options) {
  if (directory.empty()) throw DatasetError("no data set given; specify its folder");
  if (!fs::exists(directory)) throw DatasetError(fmt::format("{}: does not exist; check the path", directory.string()));
  if (!fs::is_directory(directory)) {
    throw DatasetError(fmt::format("{}: is a file; specify the folder of the data set", directory.string()));
  }
  const auto read = looks_like_euroc(directory)     ? read_euroc
                    : looks_like_kitti(directory)   ? read_kitti
                    : looks_like_folders(directory) ? read_folders
                                                    : nullptr;
  if (read != nullptr) return with_dataset_error([&] { return read(directory, options); });
  throw DatasetError(
      fmt::format("{}: contains no data set of a known layout; looked for\n"
                  "  - EuRoC/ASL: mav0/cam0/data.csv\n"
                  "  - KITTI odometry: calib.txt, image_0 and image_1 (or image_2 and image_3)\n"
                  "  - left/right folders: left/*.png or *.jpg, right/*, and a calibration (stereo_params.xml, "
                  "left.yaml and right.yaml, or "
                  "stereo.yaml)",
                  directory.string()));
}

Eigen::Isometry3d base_from_optical() { return Eigen::Isometry3d(calibration_files::base_from_forward()); }

ImageSize stereo_image_size(const std::vector<StereoFrame>& frames) {
  constexpr std::size_t kTries = 10;  // pairs to try, since the first images may be damaged
  ImageDecoder decoder;
  std::string first_problem;
  const auto decode = [&](const fs::path& file, cv::Mat& image) {
    const auto problem = decoder.decode(file, Colour::kAsStored, image);
    if (problem && first_problem.empty()) first_problem = *problem;
    return !problem;
  };
  for (std::size_t i = 0; i < std::min(kTries, frames.size()); ++i) {
    cv::Mat left, right;
    if (!decode(frames[i].left, left) || !decode(frames[i].right, right)) continue;
    if (left.size() != right.size()) {
      throw DatasetError(
          fmt::format("{}: is {} x {} px, but {} is {} x {} px; the images of both cameras must have one size",
                      frames[i].left.string(), left.cols, left.rows, frames[i].right.string(), right.cols, right.rows));
    }
    return {left.cols, left.rows};
  }
  throw DatasetError(first_problem + "; none of the first pairs can be decoded: copy the data set again");
}

void expect_image_size(const vision::PinholeCamera& camera, const fs::path& calibration_file,
                       const std::vector<StereoFrame>& frames) {
  const auto size = stereo_image_size(frames);
  if (size.width == camera.width && size.height == camera.height) return;
  throw DatasetError(fmt::format(
      "{}: the calibration is for images of {} x {} px, but those in {} are {} x {} px; use the calibration of "
      "this camera for this size",
      calibration_file.string(), camera.width, camera.height, frames.front().left.parent_path().string(), size.width,
      size.height));
}

std::int64_t stamp_at(std::uint64_t place, double rate_hz, const fs::path& image) {
  const double stamp_ns = static_cast<double>(place) * 1e9 / rate_hz;
  if (stamp_ns < static_cast<double>(interfaces::kEndOfStamps_ns)) return std::llround(stamp_ns);
  throw DatasetError(fmt::format(
      "{}: at {:g} Hz, image {} would be later than stamps can be; number the images from 0, set a higher rate_hz, "
      "or add times",
      image.string(), rate_hz, place));
}

namespace {

/// The images of a folder by number. Throws DatasetError for images without a number or with equal numbers.
std::vector<ImageFile> numbered_images(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw DatasetError(fmt::format("{}: is missing; both cameras are needed", folder.string()));
  auto images = list_images(folder);
  if (images.empty())
    throw DatasetError(fmt::format("{}: contains no images (png, jpg, pgm, ppm, bmp, tif)", folder.string()));
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!images[i].number) {
      throw DatasetError(fmt::format("{}: the name does not end in a number; use equal numbers in both folders",
                                     images[i].path.string()));
    }
    if (i > 0 && images[i].number == images[i - 1].number) {
      throw DatasetError(fmt::format("{}: has the same number as {}; remove one", images[i].path.string(),
                                     images[i - 1].path.string()));
    }
  }
  return images;
}

}  // namespace

PairedFolders pair_by_number(const fs::path& left_folder, const fs::path& right_folder,
                             std::vector<std::string>& notes) {
  const auto left = numbered_images(left_folder);
  const auto right = numbered_images(right_folder);
  PairedFolders folders;
  std::size_t alone = 0;
  fs::path first_alone;
  for (std::size_t l = 0, r = 0; l < left.size() || r < right.size(); ++folders.places) {
    const bool take_left = r == right.size() || (l < left.size() && *left[l].number <= *right[r].number);
    const bool take_right = l == left.size() || (r < right.size() && *right[r].number <= *left[l].number);
    if (take_left && take_right) {
      folders.pairs.push_back({folders.places, *left[l].number, left[l].path, right[r].path});
    } else if (alone++ == 0) {
      first_alone = take_left ? left[l].path : right[r].path;
    }
    if (take_left) ++l;
    if (take_right) ++r;
  }
  if (folders.pairs.empty()) {
    throw DatasetError(fmt::format("{}: no image has the number of an image in {}; use equal numbers in both folders",
                                   left_folder.string(), right_folder.string()));
  }
  if (alone > 0) {
    notes.push_back(fmt::format("{} of {} frames have only one image and are skipped, the first: {}", alone,
                                folders.places, first_alone.string()));
  }
  return folders;
}

}  // namespace panvo::dataset_player
