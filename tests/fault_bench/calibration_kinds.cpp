// SPDX-License-Identifier: Apache-2.0
// Faults of the calibration.
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

using sensor_msgs::msg::CameraInfo;

/// Wrong extrinsics of the stereo rig: a yaw error of 3 degrees.
Fault rig_turned(Draw& draw, const FaultWindow&) {
  const double half_angle = 0.5 * draw.sign() * 3.0 * std::numbers::pi / 180.0;
  return {.static_transforms = altered<tf2_msgs::msg::TFMessage>([half_angle](auto& message, const Moment&) {
            for (auto& transform : message.transforms()) {
              if (transform.child_frame_id().find("stereo") == std::string::npos) continue;
              // Rotation about the vehicle's vertical axis: (cos, 0, 0, sin) times the rotation; the position is
              // unchanged.
              auto& q = transform.transform().rotation();
              const double c = std::cos(half_angle), s = std::sin(half_angle);
              const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
              q.w(c * w - s * z);
              q.x(c * x - s * y);
              q.y(c * y + s * x);
              q.z(c * z + s * w);
            }
          })};
}

/// One camera is rotated about its vertical axis from some moment on.
Fault eye_turned(Draw& draw, const FaultWindow&) {
  const double angle = draw.sign() * 3.0 * std::numbers::pi / 180.0;
  const int turned_eye = draw.chance(0.5) ? 0 : 1;
  return {.pairs = both_eyes([angle, turned_eye](cv::Mat& image, const Moment&, int eye) {
            if (eye != turned_eye) return;
            // Approximation: a field of view of 70 degrees.
            const double f = 0.714 * image.cols, cx = 0.5 * image.cols, cy = 0.5 * image.rows;
            const cv::Matx33d k(f, 0, cx, 0, f, cy, 0, 0, 1);
            const cv::Matx33d turn(std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle));
            cv::warpPerspective(image, image, k * turn * k.inv(), image.size());
          })};
}

/// One image is shifted vertically by 1.5 px: the pair is no longer rectified.
Fault rows_off(Draw& draw, const FaultWindow&) {
  const double by_px = draw.sign() * 1.5;
  return {.pairs = both_eyes([by_px](cv::Mat& image, const Moment&, int eye) {
            if (eye == 0) return;
            cv::warpAffine(image, image, cv::Matx23d(1, 0, 0, 0, 1, by_px), image.size(), cv::INTER_LINEAR,
                           cv::BORDER_REPLICATE);
          })};
}

/// The baseline is in the projection matrix of the right camera: Tx = -f b.
Fault baseline_wrong(Draw& draw, const FaultWindow&) {
  const double factor = 1.0 + draw.sign() * 0.02;
  return {.right_infos = altered<CameraInfo>([factor](CameraInfo& info, const Moment&) { info.p()[3] *= factor; })};
}

Fault focal_wrong(Draw& draw, const FaultWindow&) {
  const double factor = 1.0 + draw.sign() * 0.01;
  const auto wrong = [factor](CameraInfo& info, const Moment&) {
    for (const std::size_t entry : {0U, 4U}) info.k()[entry] *= factor;
    for (const std::size_t entry : {0U, 3U, 5U}) info.p()[entry] *= factor;
  };
  return {.left_infos = altered<CameraInfo>(wrong), .right_infos = altered<CameraInfo>(wrong)};
}

}  // namespace

std::vector<FaultKind> calibration_kinds() {
  return {
      {"rig_turned", "yaw error of 3 degrees in the extrinsics of the stereo rig", Lasting::kWhole, rig_turned},
      {"eye_turned", "one camera is rotated by 3 degrees", Lasting::kOnward, eye_turned},
      {"rows_off", "the right image is shifted vertically by 1.5 px", Lasting::kOnward, rows_off},
      {"baseline_wrong", "baseline error of 2 %", Lasting::kWhole, baseline_wrong},
      {"focal_wrong", "focal length error of 1 %", Lasting::kWhole, focal_wrong},
  };
}

}  // namespace panvo::test
