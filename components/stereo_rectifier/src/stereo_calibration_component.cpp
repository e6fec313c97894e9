// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "panvo/calibration_files/mount.hpp"
#include "panvo/calibration_files/stereo_pair.hpp"
#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/component.hpp"

namespace panvo::stereo_rectifier {

struct CalibrationParameters {
  std::string folder;
  std::string base_frame = "base_link";
  std::vector<double> mount_xyz_rpy, panorama_mount_xyz_rpy, mount, panorama_mount;

  template <class Field>
  static void describe(Field&& field) {
    using P = CalibrationParameters;
    field.path(&P::folder, "folder", "folder with left.yaml and right.yaml, as panvo calibrate writes it");
    field(&P::base_frame, "base_frame", "", "vehicle frame");
    field(&P::mount_xyz_rpy, "mount_xyz_rpy", "m, deg",
          "pose of the left camera on the vehicle, published on /tf_static: x y z roll pitch yaw, of a camera that "
          "looks forward, like `mount` of the camera drivers and in extrinsics.yaml; empty: another node publishes it");
    field(&P::panorama_mount_xyz_rpy, "panorama_mount_xyz_rpy", "m, deg",
          "the same for the panoramic camera: of a panorama whose centre looks forward");
    field(&P::mount, "mount", "m, deg", "obsolete: mount_xyz_rpy in the order x y z yaw pitch roll");
    field(&P::panorama_mount, "panorama_mount", "m, deg",
          "obsolete: panorama_mount_xyz_rpy in the order x y z yaw pitch roll");
  }

  template <class Conflict>
  void find_conflicts(Conflict&& conflict) const {
    if (!mount.empty() && !mount_xyz_rpy.empty()) conflict("mount", "must be empty beside", "mount_xyz_rpy");
    if (!panorama_mount.empty() && !panorama_mount_xyz_rpy.empty())
      conflict("panorama_mount", "must be empty beside", "panorama_mount_xyz_rpy");
  }
};

/// Publishes the calibration of a stereo pair for images that come without camera_info, as in many bags:
/// stereo/{left,right}/image_raw -> stereo/{left,right}/camera_info with the same stamp and frame; panorama/image too ->
/// /tf_static.
class StereoCalibrationComponent final : public runtime::Component {
 public:
  explicit StereoCalibrationComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<CalibrationParameters>()) {
    const auto pair = read_pair();
    place(topics::kStereoLeftImageRaw, "mount", parameters_.mount, parameters_.mount_xyz_rpy);
    place(topics::kPanorama, "panorama_mount", parameters_.panorama_mount, parameters_.panorama_mount_xyz_rpy);
    serve(topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo,
          conversions::left_camera(pair.calibration, pair.rectified));
    serve(topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo,
          conversions::right_camera(pair.calibration, pair.rectified));
  }

 private:
  using ImagePtr = std::shared_ptr<const sensor_msgs::msg::Image>;

  calibration_files::CalibratedStereo read_pair() const {
    using calibration_files::Rectification;
    if (parameters_.folder.empty()) {
      throw runtime::ConfigError(context_.name() + ": parameter folder is empty; set folder: FOLDER");
    }
    const std::filesystem::path folder(parameters_.folder);
    try {
      return calibration_files::stereo_pair(
          calibration_files::read_camera_info(folder / "left.yaml", Rectification::kRequired),
          calibration_files::read_camera_info(folder / "right.yaml", Rectification::kRequired));
    } catch (const calibration_files::FileError& error) {
      throw runtime::ConfigError(
          fmt::format("{}: {}\n`panvo calibrate convert FILE --out FOLDER` makes the two files from a Kalibr camchain",
                      context_.name(), error.what()));
    }
  }

  void serve(const interfaces::Topic<sensor_msgs::msg::Image>& image,
             const interfaces::Topic<sensor_msgs::msg::CameraInfo>& info, const conversions::PairedCamera& camera) {
    context_.input(image, [output = context_.output(info), camera](const ImagePtr& raw) mutable {
      output.publish(conversions::to_camera_info(camera, conversions::stamp_ns(*raw), raw->header().frame_id()));
    });
  }

  calibration_files::Mount read_mount(const std::string& name, const std::vector<double>& numbers,
                                      bool begins_with_roll) const {
    if (numbers.size() != 6) {
      throw runtime::ConfigError(fmt::format("{}: parameter {} has {} numbers; it needs x y z {}", context_.name(),
                                             name, numbers.size(),
                                             begins_with_roll ? "roll pitch yaw" : "yaw pitch roll"));
    }
    return {.position_m = {numbers[0], numbers[1], numbers[2]},
            .yaw_deg = numbers[begins_with_roll ? 5 : 3],
            .pitch_deg = numbers[4],
            .roll_deg = numbers[begins_with_roll ? 3 : 5]};
  }

  /// Publishes the pose of a camera, whose frame its first image names.
  void place(const interfaces::Topic<sensor_msgs::msg::Image>& image, const std::string& name,
             const std::vector<double>& begins_with_yaw, const std::vector<double>& begins_with_roll) {
    if (begins_with_yaw.empty() && begins_with_roll.empty()) return;
    const auto mount = begins_with_roll.empty() ? read_mount(name, begins_with_yaw, false)
                                                : read_mount(name + "_xyz_rpy", begins_with_roll, true);
    if (begins_with_roll.empty() && mount.yaw_deg != mount.roll_deg) {
      // Numbers copied from extrinsics.yaml would be in another order.
      context_.log().warn(
          "{} is obsolete: read as yaw {}, pitch {}, roll {} degrees. Write {}_xyz_rpy, in the order "
          "roll, pitch, yaw of extrinsics.yaml and the camera drivers",
          name, mount.yaw_deg, mount.pitch_deg, mount.roll_deg, name);
    }
    const Eigen::Isometry3d base_from_camera = calibration_files::base_from_camera(mount);
    if (!transforms_) transforms_.emplace(context_.output(topics::kTfStatic));
    context_.input(image, [this, base_from_camera, placed = std::string()](const ImagePtr& raw) mutable {
      const auto& frame = raw->header().frame_id();
      if (frame == placed) return;
      placed = frame;
      std::erase_if(message_.transforms(), [&](const auto& known) { return known.child_frame_id() == frame; });
      message_.transforms().push_back(conversions::to_static_transform(
          conversions::stamp_ns(*raw), parameters_.base_frame, frame, base_from_camera));
      transforms_->publish(message_);  // all of them, because the topic keeps one message for late readers
    });
  }

  runtime::Context& context_;
  const CalibrationParameters parameters_;
  std::optional<runtime::Output<tf2_msgs::msg::TFMessage>> transforms_;
  tf2_msgs::msg::TFMessage message_;
};

PANVO_REGISTER_COMPONENT(StereoCalibrationComponent)

}  // namespace panvo::stereo_rectifier
