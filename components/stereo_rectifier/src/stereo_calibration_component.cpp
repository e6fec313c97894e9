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
  std::vector<double> mount;

  template <class Field>
  static void describe(Field&& field) {
    using P = CalibrationParameters;
    field.path(&P::folder, "folder", "folder with left.yaml and right.yaml, as panvo calibrate writes it");
    field(&P::base_frame, "base_frame", "", "vehicle frame");
    field(&P::mount, "mount", "m, deg",
          "pose of the left camera on the vehicle, published on /tf_static: x y z yaw pitch roll, of a camera that "
          "looks forward; empty: another node publishes it");
  }
};

/// Publishes the calibration of a stereo pair for images that come without camera_info, as in many bags:
/// stereo/{left,right}/image_raw -> stereo/{left,right}/camera_info with the same stamp and frame, and /tf_static.
class StereoCalibrationComponent final : public runtime::Component {
 public:
  explicit StereoCalibrationComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<CalibrationParameters>()) {
    const auto pair = read_pair();
    if (!parameters_.mount.empty()) {
      if (parameters_.mount.size() != 6) {
        throw runtime::ConfigError(fmt::format("{}: parameter mount has {} numbers; it needs x y z yaw pitch roll",
                                               context.name(), parameters_.mount.size()));
      }
      transforms_.emplace(context.output(topics::kTfStatic));
    }
    serve(topics::kStereoLeftImageRaw, topics::kStereoLeftCameraInfo,
          conversions::left_camera(pair.calibration, pair.rectified));
    serve(topics::kStereoRightImageRaw, topics::kStereoRightCameraInfo,
          conversions::right_camera(pair.calibration, pair.rectified));
  }

 private:
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
    auto output = context_.output(info);
    const bool is_left = info.name == topics::kStereoLeftCameraInfo.name;
    context_.input(image,
                   [this, output, camera, is_left](const std::shared_ptr<const sensor_msgs::msg::Image>& raw) mutable {
                     const std::int64_t stamp_ns = conversions::stamp_ns(*raw);
                     const auto& frame = raw->header().frame_id();
                     if (is_left) publish_mount(stamp_ns, frame);
                     output.publish(conversions::to_camera_info(camera, stamp_ns, frame));
                   });
  }

  void publish_mount(std::int64_t stamp_ns, const std::string& frame) {
    if (!transforms_ || frame == published_frame_) return;
    published_frame_ = frame;
    const auto& m = parameters_.mount;
    const calibration_files::Mount mount{{m[0], m[1], m[2]}, m[3], m[4], m[5]};
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(conversions::to_static_transform(stamp_ns, parameters_.base_frame, frame,
                                                                    calibration_files::base_from_camera(mount)));
    transforms_->publish(std::move(message));
  }

  runtime::Context& context_;
  const CalibrationParameters parameters_;
  std::optional<runtime::Output<tf2_msgs::msg::TFMessage>> transforms_;
  std::string published_frame_;
};

PANVO_REGISTER_COMPONENT(StereoCalibrationComponent)

}  // namespace panvo::stereo_rectifier
