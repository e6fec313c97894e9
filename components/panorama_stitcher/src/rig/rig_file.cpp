// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/rig_file.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "panvo/calibration_files/camera_info.hpp"
#include "panvo/calibration_files/mount.hpp"
#include "panvo/calibration_files/rigid_transform.hpp"

namespace panvo::panorama_stitcher {
namespace {

using calibration_files::YamlMap;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kMaxImages = 6;
constexpr int kMaxPixels = 1 << 16;

/// Reads a pose as for cameras on the vehicle. The optical frame of the panorama looks forward.
Eigen::Isometry3d read_mounted(YamlMap& map) {
  const auto mount = calibration_files::read_mount(map);
  const Eigen::Matrix3d rig_from_panorama = calibration_files::base_from_forward();
  Eigen::Isometry3d panorama_from_head = Eigen::Isometry3d::Identity();
  panorama_from_head.linear() =
      rig_from_panorama.transpose() * calibration_files::rotation_of(mount) * rig_from_panorama;
  panorama_from_head.translation() = rig_from_panorama.transpose() * mount.position_m;
  return panorama_from_head;
}

/// Reads a pose as a matrix, as written by calibration tools, or as a mount.
Eigen::Isometry3d read_pose(YamlMap& map) {
  if (!map.has("panorama_from_head")) return read_mounted(map);
  for (const char* key : {"position_m", "yaw_deg", "pitch_deg", "roll_deg"}) {
    if (map.has(key)) map.reject(key, "conflicts with panorama_from_head; remove one of them");
  }
  return calibration_files::read_rigid_transform(map, "panorama_from_head");
}

std::optional<vision::Equirectangular> read_equirectangular(YamlMap& map) {
  if (map.has("camera_info")) map.reject("camera_info", "does not apply to an equirectangular image; remove it");
  const std::size_t problems = map.problems();
  const auto [width, height] = map.size_px("equirectangular_px", 2);
  if (map.problems() > problems) return std::nullopt;
  if (width == 2 * height) return vision::Equirectangular{width, height};
  map.reject("equirectangular_px", "must be twice as wide as high; crop or pad the camera's image to the full sphere");
  return std::nullopt;
}

std::optional<vision::CameraModel> read_camera(YamlMap& map, double field_of_view_rad) {
  const std::string name = map.text("camera_info");
  if (name.empty()) return std::nullopt;
  try {
    const auto lens = calibration_files::read_camera_info(map.file().parent_path() / name).lens();
    return vision::CameraModel(lens, field_of_view_rad);
  } catch (const calibration_files::FileError& error) {
    map.include("camera_info", error);
  } catch (const std::invalid_argument& error) {
    map.reject("camera_info", fmt::format("{}: the camera {}", name, error.what()));
  }
  return std::nullopt;
}

/// Reads the lens and the size of the images that it is calibrated for.
std::optional<std::variant<vision::CameraModel, vision::Equirectangular>> read_lens(YamlMap& map, cv::Size& size_px) {
  const double field_of_view_deg = map.number("field_of_view_deg", {1.0, 360.0, "degrees"}, 0.0);
  if (map.has("equirectangular_px")) {
    const auto sphere = read_equirectangular(map);
    if (sphere) size_px = {sphere->columns, sphere->rows};
    return sphere;
  }
  const auto camera = read_camera(map, kDegree * field_of_view_deg);
  if (camera) size_px = {camera->camera().pinhole.width, camera->camera().pinhole.height};
  return camera;
}

/// Reads the head's region in its image; default: the whole image. `lens_px` is empty if the lens is wrong.
void read_region(YamlMap& map, cv::Size lens_px, Head& head) {
  head.image_size_px = lens_px;
  head.region_px = {{0, 0}, lens_px};
  const bool has_region = map.has("region_px");
  const bool has_size = map.has("image_size_px");
  if (has_size && !has_region) map.reject("image_size_px", "needs region_px: [left, top, width, height] as well");
  if (has_region && !has_size) map.reject("region_px", "needs image_size_px: [width, height] as well");
  if (!has_region || !has_size) return;
  const std::size_t problems = map.problems();
  const auto region = map.numbers("region_px", 4, {0, kMaxPixels, "px"});
  const auto [width, height] = map.size_px("image_size_px");
  if (map.problems() > problems) return;
  head.image_size_px = {width, height};
  head.region_px = {static_cast<int>(region[0]), static_cast<int>(region[1]), static_cast<int>(region[2]),
                    static_cast<int>(region[3])};
  if (!lens_px.empty() && head.region_px.size() != lens_px) {
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
  const int image = map.integer("image", 0, kMaxImages - 1, static_cast<int>(index));
  cv::Size lens_px;
  const auto lens = read_lens(map, lens_px);
  const double blind_spot_deg = map.number("blind_spot_deg", {0.0, 359.0, "degrees"}, 0.0);
  const auto pose = read_pose(map);
  Head head{name,
            static_cast<std::size_t>(image),
            {},
            {},
            lens ? *lens : vision::Equirectangular{2, 1},
            0.5 * kDegree * blind_spot_deg,
            pose};
  read_region(map, lens_px, head);
  if (!lens) return std::nullopt;
  return head;
}

void read_panorama(YamlMap& map, RigFile& file) {
  auto& rig = file.rig;
  rig.frame_id = map.text("frame_id", rig.frame_id);
  rig.blend_rad = kDegree * map.number("blend_deg", {0.0, 90.0, "degrees"}, 6.0);
  rig.radius_m = map.number("radius_m", {0.0, 1e6, "m"}, 0.0);
  std::vector<double> seen_deg{-90.0, 90.0};
  if (map.has("seen_elevation_deg")) {
    const std::size_t problems = map.problems();
    seen_deg = map.numbers("seen_elevation_deg", 2, {-90.0, 90.0, "degrees"});
    if (map.problems() == problems && !(seen_deg[0] < seen_deg[1]))
      map.reject("seen_elevation_deg",
                 "must be [lowest, highest] elevation, from -90 (straight down) to 90 (straight up)");
  }
  rig.highest_rad = -kDegree * seen_deg[1];
  rig.lowest_rad = -kDegree * seen_deg[0];
  file.seen_elevation_at = map.where("seen_elevation_deg");
}

/// Heads that share an image must state the same size, and image numbers must have no gaps.
void check_images(const PanoramaRig& rig, YamlMap& map) {
  for (std::size_t image = 0; image < rig.images(); ++image) {
    const Head* first = nullptr;
    for (const auto& head : rig.heads) {
      if (head.image != image) continue;
      if (first != nullptr && first->image_size_px != head.image_size_px) {
        map.reject("heads", fmt::format("has '{}' and '{}', which share image {}, but state different sizes; correct "
                                        "image_size_px",
                                        first->name, head.name, image));
      }
      first = &head;
    }
    if (first == nullptr)
      map.reject("heads", fmt::format("has no head with image {}, but one with a higher number; number images without "
                                      "gaps",
                                      image));
  }
}

}  // namespace

RigFile read_rig_file(const std::filesystem::path& path) {
  YamlMap map(path, "a rig file such as config/rigs/dual_fisheye/panorama.yaml");
  RigFile file;
  YamlMap panorama = map.map("panorama");
  read_panorama(panorama, file);
  auto heads = map.maps("heads");
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (const auto head = read_head(heads[i], i)) file.rig.heads.push_back(*head);
  }
  if (map.problems() == 0) check_images(file.rig, map);
  map.finish();
  return file;
}

}  // namespace panvo::panorama_stitcher
