// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/rig_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <stdexcept>

#include "camera_info_file.hpp"
#include "panvo/vision/pose.hpp"
#include "yaml_map.hpp"

namespace panvo::panorama_stitcher {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kMaxImages = 6;
constexpr int kMaxPixels = 1 << 16;

/// Rotation from rig axes (x forward, y left, z up) to those of a forward-looking optical frame.
Eigen::Matrix3d optical_from_rig() {
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return rotation;
}

/// Reads a pose from yaw (to the left), pitch (down) and roll (clockwise), as for cameras on the vehicle.
Eigen::Isometry3d read_turned(YamlMap& map) {
  const double yaw = kDegree * map.number("yaw_deg", 0.0, -360.0, 360.0);
  const double pitch = kDegree * map.number("pitch_deg", 0.0, -180.0, 180.0);
  const double roll = kDegree * map.number("roll_deg", 0.0, -360.0, 360.0);
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();
  panorama_from_head.linear() = optical_from_rig() * rotation * optical_from_rig().transpose();
  if (const auto position = map.numbers("position_m", 3); !position.empty())
    panorama_from_head.translation() = optical_from_rig() * Eigen::Vector3d(position[0], position[1], position[2]);
  return panorama_from_head;
}

/// Reads a 4 x 4 matrix, as written by calibration tools.
Eigen::Isometry3d read_matrix(YamlMap& map) {
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();
  const auto values = map.numbers("panorama_from_head", 16);
  if (values.empty()) return panorama_from_head;
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-3 || rotation.determinant() < 0.0 ||
      (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-9) {
    map.reject("panorama_from_head", "is not a rigid transform; give the 4 x 4 matrix row by row");
    return panorama_from_head;
  }
  panorama_from_head.linear() = vision::nearest_rotation(rotation);
  panorama_from_head.translation() = matrix.topRightCorner<3, 1>();
  return panorama_from_head;
}

Eigen::Isometry3d read_pose(YamlMap& map) {
  if (!map.has("panorama_from_head")) return read_turned(map);
  for (const char* key : {"position_m", "yaw_deg", "pitch_deg", "roll_deg"}) {
    if (map.has(key)) map.reject(key, "conflicts with panorama_from_head; remove one of them");
  }
  return read_matrix(map);
}

std::optional<std::variant<vision::CameraModel, vision::Equirectangular>> read_lens(YamlMap& map, cv::Size& size_px) {
  const double field_of_view_deg = map.number("field_of_view_deg", 0.0, 1.0, 360.0);
  if (map.has("equirectangular_px")) {
    const auto size = map.numbers("equirectangular_px", 2);
    if (map.has("camera_info")) map.reject("camera_info", "does not apply to an equirectangular image; remove it");
    if (size.empty()) return std::nullopt;
    size_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
    if (size_px.height >= 2 && size_px.width == 2 * size_px.height && size_px.width <= kMaxPixels)
      return vision::Equirectangular{size_px.width, size_px.height};
    map.reject("equirectangular_px",
               "must be twice as wide as high; crop or pad the camera's image to the full sphere");
    return std::nullopt;
  }
  map.require("camera_info");
  const std::string name = map.text("camera_info", "");
  if (name.empty()) return std::nullopt;
  const auto lens = read_camera_info(map.file().parent_path() / name, map.problems());
  if (!lens) return std::nullopt;
  size_px = {lens->pinhole.width, lens->pinhole.height};
  try {
    return vision::CameraModel(*lens, kDegree * field_of_view_deg);
  } catch (const std::invalid_argument& error) {
    map.reject("camera_info", fmt::format("{}: the camera {}", name, error.what()));
  }
  return std::nullopt;
}

/// Reads the head's region in its image; default: the whole image.
void read_region(YamlMap& map, cv::Size lens_px, Head& head) {
  head.image_size_px = lens_px;
  head.region_px = {{0, 0}, lens_px};
  const auto region = map.numbers("region_px", 4);
  const auto size = map.numbers("image_size_px", 2);
  if (region.empty() && size.empty()) return;
  if (region.empty() || size.empty()) {
    if (region.empty()) {
      map.reject("image_size_px", "needs region_px: [left, top, width, height] as well");
    } else {
      map.reject("region_px", "needs image_size_px: [width, height] as well");
    }
    return;
  }
  head.image_size_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  head.region_px = {static_cast<int>(region[0]), static_cast<int>(region[1]), static_cast<int>(region[2]),
                    static_cast<int>(region[3])};
  if (head.region_px.size() != lens_px) {
    map.reject("region_px", fmt::format("is {} x {} px, but the lens is calibrated for {} x {} px; calibrate it with "
                                        "images of the region's size",
                                        head.region_px.width, head.region_px.height, lens_px.width, lens_px.height));
  }
  if ((head.region_px & cv::Rect({0, 0}, head.image_size_px)) != head.region_px)
    map.reject("region_px", fmt::format("reaches beyond the image of {} x {} px; correct it or image_size_px",
                                        head.image_size_px.width, head.image_size_px.height));
}

std::optional<Head> read_head(YamlMap& map, std::size_t index) {
  const auto name = map.text("name", fmt::format("head_{}", index));
  const int image = map.integer("image", static_cast<int>(index), 0, kMaxImages - 1);
  cv::Size lens_px;
  const auto lens = read_lens(map, lens_px);
  const double blind_spot_deg = map.number("blind_spot_deg", 0.0, 0.0, 359.0);
  const auto pose = read_pose(map);
  Head head{name,
            static_cast<std::size_t>(image),
            {},
            {},
            lens ? *lens : vision::Equirectangular{2, 1},
            0.5 * kDegree * blind_spot_deg,
            pose};
  read_region(map, lens ? lens_px : cv::Size(), head);
  map.finish();
  if (!lens) return std::nullopt;
  return head;
}

void read_panorama(YamlMap& map, RigFile& file) {
  auto& rig = file.rig;
  rig.frame_id = map.text("frame_id", rig.frame_id);
  rig.blend_rad = kDegree * map.number("blend_deg", 6.0, 0.0, 90.0);
  rig.radius_m = map.number("radius_m", 0.0, 0.0, 1e6);
  auto seen_deg = map.numbers("seen_elevation_deg", 2);
  if (seen_deg.empty()) seen_deg = {-90.0, 90.0};
  if (!(seen_deg[0] >= -90.0 && seen_deg[0] < seen_deg[1] && seen_deg[1] <= 90.0))
    map.reject("seen_elevation_deg",
               "must be [lowest, highest] elevation, from -90 (straight down) to 90 (straight up)");
  rig.highest_rad = -kDegree * seen_deg[1];
  rig.lowest_rad = -kDegree * seen_deg[0];
  file.seen_elevation_at = map.where("seen_elevation_deg");
  map.finish();
}

/// Heads that share an image must state the same size, and image numbers must have no gaps.
void check_images(const std::filesystem::path& file, const PanoramaRig& rig, std::vector<std::string>& problems) {
  for (std::size_t image = 0; image < rig.images(); ++image) {
    const Head* first = nullptr;
    for (const auto& head : rig.heads) {
      if (head.image != image) continue;
      if (first != nullptr && first->image_size_px != head.image_size_px) {
        problems.push_back(
            fmt::format("{}: heads: '{}' and '{}' share image {}, but state different sizes; correct image_size_px",
                        file.string(), first->name, head.name, image));
      }
      first = &head;
    }
    if (first == nullptr)
      problems.push_back(
          fmt::format("{}: heads: no head has image {}, but one has a higher number; number images without gaps",
                      file.string(), image));
  }
}

}  // namespace

RigFile read_rig_file(const std::filesystem::path& path) {
  std::vector<std::string> problems;
  const YAML::Node tree = load_yaml(path);
  YamlMap root(path, tree, problems);
  RigFile file;
  root.require("heads");
  file.seen_elevation_at = root.where("panorama") + ": seen_elevation_deg";
  file.rig.blend_rad = 6.0 * kDegree;
  file.rig.highest_rad = -0.5 * std::numbers::pi;
  file.rig.lowest_rad = 0.5 * std::numbers::pi;
  if (root.has("panorama")) {
    YamlMap panorama(path, tree["panorama"], problems);
    read_panorama(panorama, file);
  }
  root.finish();
  const YAML::Node heads = tree["heads"];
  if (heads.IsDefined() && (!heads.IsSequence() || heads.size() == 0))
    root.reject("heads", "must be a list of at least one head");
  for (std::size_t i = 0; heads.IsDefined() && heads.IsSequence() && i < heads.size(); ++i) {
    YamlMap map(path, heads[i], problems);
    if (const auto head = read_head(map, i)) file.rig.heads.push_back(*head);
  }
  if (problems.empty()) check_images(path, file.rig, problems);
  if (!problems.empty()) throw RigFileError(fmt::format("{}", fmt::join(problems, "\n")));
  return file;
}

}  // namespace panvo::panorama_stitcher
