// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/image_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "panvo/dataset_player/image_file.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::places {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlank = " \t\r";
constexpr const char* kExpected = "poses are lines image,x_m,y_m,heading_deg, or TUM or KITTI with one line per image";

struct Line {
  std::size_t number = 0;
  std::vector<std::string> words;
};

[[noreturn]] void fail(const fs::path& file, std::size_t line, const std::string& problem) {
  throw FolderError(fmt::format("{}:{}: {}; {}", file.string(), line, problem, kExpected));
}

/// At commas, if there are any: then words, such as the names of images, may have spaces.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  std::string word;
  if (text.find(',') == std::string::npos) {
    while (stream >> word) words.push_back(word);
    return words;
  }
  while (std::getline(stream, word, ',')) {
    const auto begin = std::min(word.find_first_not_of(kBlank), word.size());
    words.push_back(word.substr(begin, word.find_last_not_of(kBlank) + 1 - begin));
  }
  return words;
}

std::vector<Line> read_lines(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw FolderError(file.string() + ": cannot be read; name a file of poses");
  std::vector<Line> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // the mark of UTF-8
    Line line{number, split(text)};
    const auto is_empty = [](const std::string& word) { return word.empty(); };
    if (std::all_of(line.words.begin(), line.words.end(), is_empty) || line.words[0].starts_with('#')) continue;
    lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> number_of(const std::string& word) {
  std::size_t used = 0;
  try {
    const double value = std::stod(word, &used);
    return used == word.size() && std::isfinite(value) ? std::optional(value) : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::vector<double> numbers(const fs::path& file, const Line& line, std::size_t first) {
  std::vector<double> values;
  for (std::size_t i = first; i < line.words.size(); ++i) {
    const auto value = number_of(line.words[i]);
    if (!value) fail(file, line.number, "'" + line.words[i] + "' is not a number");
    values.push_back(*value);
  }
  return values;
}

Eigen::Isometry3d planar_pose(double x, double y, double heading_deg) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  pose.linear() = Eigen::AngleAxisd(heading_deg * vision::kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

Eigen::Isometry3d tum_pose(const fs::path& file, const Line& line, const std::vector<double>& values) {
  Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  if (std::abs(rotation.norm() - 1.0) > 0.01) fail(file, line.number, "the quaternion is not of length 1");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(values[1], values[2], values[3]);
  pose.linear() = rotation.normalized().toRotationMatrix();
  return pose;
}

/// From optical axes (x right, y down, z forward) to those of a vehicle (x forward, y left, z up).
Eigen::Isometry3d kitti_pose(const std::vector<double>& values) {
  Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column)
      camera.matrix()(row, column) = values[static_cast<std::size_t>(4 * row + column)];
  }
  camera.linear() = vision::nearest_rotation(camera.linear());
  Eigen::Isometry3d base_from_optical = Eigen::Isometry3d::Identity();
  base_from_optical.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return base_from_optical * camera * base_from_optical.inverse();
}

/// Lines that begin with the name of an image.
void set_named_poses(const fs::path& file, const std::vector<Line>& lines, std::vector<FolderImage>& images) {
  std::map<std::string, FolderImage*> by_name;
  for (auto& image : images) by_name[image.file.filename().string()] = &image;
  bool is_any_named = false;
  for (const auto& line : lines) {
    const auto found = by_name.find(line.words[0]);
    if (found == by_name.end()) continue;  // names of columns, or an image that is not there any more
    is_any_named = true;
    if (line.words.size() < 4) fail(file, line.number, "a pose needs image, x, y and heading");
    const auto values = numbers(file, {line.number, {line.words.begin(), line.words.begin() + 4}}, 1);
    found->second->map_from_base = planar_pose(values[0], values[1], values[2]);
  }
  if (!is_any_named) throw FolderError(fmt::format("{}: names none of the images; {}", file.string(), kExpected));
}

/// One line per image, in order.
void set_listed_poses(const fs::path& file, const std::vector<Line>& lines, std::vector<FolderImage>& images) {
  if (lines.size() != images.size()) {
    throw FolderError(
        fmt::format("{}: has {} poses for {} images; give one per image, in order of the names, or name the images",
                    file.string(), lines.size(), images.size()));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto values = numbers(file, lines[i], 0);
    if (values.size() == 8) {
      images[i].time_s = values[0];
      images[i].map_from_base = tum_pose(file, lines[i], values);
    } else if (values.size() == 12) {
      images[i].map_from_base = kitti_pose(values);
    } else {
      fail(file, lines[i].number, fmt::format("{} numbers, 8 (TUM) or 12 (KITTI) expected", values.size()));
    }
  }
}

}  // namespace

std::vector<FolderImage> read_image_folder(const fs::path& folder, const fs::path& poses) {
  if (!fs::is_directory(folder)) throw FolderError(folder.string() + ": is not a folder; name a folder with panoramas");
  std::vector<FolderImage> images;
  for (const auto& image : dataset_player::list_images(folder)) images.push_back({image.path, {}, {}});
  if (images.empty()) throw FolderError(folder.string() + ": holds no images; name a folder with .jpg or .png files");
  fs::path file = poses;
  for (const char* name : {"poses.csv", "poses.txt"}) {
    if (file.empty() && fs::exists(folder / name)) file = folder / name;
  }
  if (file.empty()) return images;
  auto lines = read_lines(file);
  if (lines.empty()) throw FolderError(file.string() + ": holds no poses; write one line per image");
  const auto begins_with_number = [](const Line& line) { return number_of(line.words[0]).has_value(); };
  // The first line may hold names of columns: the others tell.
  const bool is_listed = std::all_of(lines.begin() + (lines.size() > 1 ? 1 : 0), lines.end(), begins_with_number);
  if (is_listed && !begins_with_number(lines.front())) lines.erase(lines.begin());
  is_listed ? set_listed_poses(file, lines, images) : set_named_poses(file, lines, images);
  return images;
}

}  // namespace panvo::places
