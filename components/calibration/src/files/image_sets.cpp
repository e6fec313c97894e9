// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/image_sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

namespace fs = std::filesystem;

using ByName = std::map<std::string, fs::path>;

bool is_image(const fs::path& file) {
  static const std::set<std::string> kEndings{".png", ".jpg", ".jpeg", ".bmp", ".pgm",
                                              ".ppm", ".tif", ".tiff", ".webp"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return kEndings.contains(ending);
}

void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw CalibrationError(folder.string() + ": is not a folder; specify the folder of the images");
}

ByName images_in(const fs::path& folder) {
  ByName files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file() && is_image(entry.path())) files[entry.path().stem().string()] = entry.path();
  }
  return files;
}

/// Images in a camera's folder, or in its subfolder data/ (EuRoC).
ByName camera_images(const fs::path& folder) {
  auto files = images_in(folder);
  return files.empty() ? images_in(folder / "data") : files;
}

ByName with_prefix(const ByName& files, const std::string& prefix) {
  ByName found;
  for (const auto& [name, file] : files) {
    if (name.starts_with(prefix)) found[name.substr(prefix.size())] = file;
  }
  return found;
}

ImageSets join(const std::vector<std::string>& cameras, const std::vector<ByName>& files) {
  ImageSets images{cameras, {}};
  std::map<std::string, std::vector<fs::path>> sets;
  for (std::size_t camera = 0; camera < files.size(); ++camera) {
    for (const auto& [name, file] : files[camera]) {
      auto& set = sets[name];
      set.resize(files.size());
      set[camera] = file;
    }
  }
  for (auto& [name, set] : sets) images.sets.push_back({name, set});
  return images;
}

void read_set(const ImageSets::Set& set, const BoardDetector& detector, std::vector<fs::path>& first_files,
              Observations& observations) {
  View view{set.name, {}, {}};
  for (std::size_t camera = 0; camera < set.files.size(); ++camera) {
    const auto& file = set.files[camera];
    Sighting sighting;
    const cv::Mat grey = file.empty() ? cv::Mat() : cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    if (grey.empty()) {
      sighting.missing = file.empty() ? "no image of that name" : "cannot be read as an image";
    } else {
      auto& size = observations.image_sizes[camera];
      if (size.empty()) {
        size = grey.size();
        first_files[camera] = file;
      }
      if (size != grey.size())
        throw CalibrationError(fmt::format("{}: size is {} x {} px, but {} is {} x {} px; use images of one size",
                                           file.string(), grey.cols, grey.rows, first_files[camera].string(),
                                           size.width, size.height));
      sighting = detector.detect(grey);
    }
    view.seen.push_back(std::move(sighting.corners));
    view.missing.push_back(std::move(sighting.missing));
  }
  observations.views.push_back(std::move(view));
}

}  // namespace

ImageSets find_stereo_images(const fs::path& folder) {
  check_folder(folder);
  ByName left, right;
  for (const char* inside : {"", "mav0"}) {
    for (const auto& [one, other] : {std::pair("left", "right"), std::pair("cam0", "cam1")}) {
      if (!left.empty() && !right.empty()) break;
      left = camera_images(folder / inside / one);
      right = camera_images(folder / inside / other);
    }
  }
  if (left.empty() || right.empty()) {
    const auto files = images_in(folder);
    left = with_prefix(files, "left");
    right = with_prefix(files, "right");
  }
  if (left.empty() || right.empty())
    throw CalibrationError(fmt::format(
        "{}: found {} left and {} right images; expected files left*.png and right*.png, or folders left and right "
        "(or cam0 and cam1) with equal file names",
        folder.string(), left.size(), right.size()));
  if (std::none_of(left.begin(), left.end(), [&](const auto& item) { return right.contains(item.first); }))
    throw CalibrationError(fmt::format(
        "{}: no left and right image have equal names (the first are '{}' and '{}'); give simultaneous images equal "
        "names",
        folder.string(), left.begin()->second.filename().string(), right.begin()->second.filename().string()));
  return join({"left", "right"}, {left, right});
}

ImageSets find_rig_images(const fs::path& folder, const std::vector<std::string>& cameras) {
  check_folder(folder);
  std::vector<std::string> names = cameras;
  if (names.empty()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.is_directory() && !camera_images(entry.path()).empty())
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
  }
  if (names.size() < 2)
    throw CalibrationError(
        fmt::format("{}: found {} image folders; expected two or more, one for each camera and named after it",
                    folder.string(), names.size()));
  std::vector<ByName> files;
  for (const auto& name : names) {
    files.push_back(camera_images(folder / name));
    if (files.back().empty())
      throw CalibrationError(
          (folder / name).string() +
          ": contains no images; expected a folder for each camera, named after its camera_info file");
  }
  return join(names, files);
}

Observations detect_boards(const ImageSets& images, const Board& board,
                           const std::function<void(std::size_t done, std::size_t of)>& progress) {
  const BoardDetector detector(board);
  Observations observations;
  observations.cameras = images.cameras;
  observations.image_sizes.resize(images.cameras.size());
  observations.board_points = board.points();
  std::vector<fs::path> first_files(images.cameras.size());
  for (std::size_t i = 0; i < images.sets.size(); ++i) {
    read_set(images.sets[i], detector, first_files, observations);
    progress(i + 1, images.sets.size());
  }
  for (std::size_t camera = 0; camera < images.cameras.size(); ++camera) {
    if (observations.image_sizes[camera].empty())
      throw CalibrationError(images.cameras[camera] +
                             ": none of its files can be read as an image; check that they are complete");
  }
  return observations;
}

}  // namespace panvo::calibration
