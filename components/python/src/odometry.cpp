// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/eigen.h>

#include <mutex>

#include "arrays.hpp"
#include "bindings.hpp"
#include "panvo/binocular_odometry/base_motion.hpp"
#include "panvo/binocular_odometry/binocular_odometry.hpp"
#include "parameters.hpp"
#include "stereo_images.hpp"
#include "stereo_pair.hpp"
#include "trajectory_arrays.hpp"

namespace panvo::python {
namespace {

using binocular_odometry::UncertainPose;

struct Estimate {
  std::int64_t stamp_ns = 0;
  UncertainPose odom_from_base;
  UncertainPose previous_from_current;
  double row_misalignment_px = 0.0;
  double disparity_offset_px = 0.0;
  binocular_odometry::Quality quality;
};

/// Rectification and odometry in the frame of the vehicle: what `panvo run stereo` does.
class StereoOdometry {
 public:
  StereoOdometry(const StereoPair& pair, const binocular_odometry::Parameters& parameters)
      : raw_(pair.raw),
        base_from_left_(pair.base_from_rectified_left()),
        rectifier_(pair),
        tracking_(pair.rectified, parameters),
        motion_(pair.rectified, parameters.motion) {}

  Estimate track(const py::object& left, const py::object& right, const py::object& stamp_s,
                 const py::object& stamp_ns) {
    const auto images = stereo_images(raw_, left, right);
    const std::int64_t stamp = stamp_of(stamp_s, stamp_ns);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    return step(stamp, images);
  }

 private:
  Estimate step(std::int64_t stamp_ns, const StereoImages& images) {
    const auto [left, right] = rectifier_.rectify(images.left, images.right);
    const auto tracked = tracking_.track({stamp_ns, left, right});
    const auto estimate = motion_.estimate(tracked);
    const auto of_base = [&](const Eigen::Isometry3d& motion, const vision::Matrix6d& covariance) {
      return binocular_odometry::motion_of_base(base_from_left_, motion, covariance);
    };
    return {.stamp_ns = estimate.stamp_ns,
            .odom_from_base = of_base(estimate.odom_from_left, estimate.odom_from_left_covariance),
            .previous_from_current = of_base(estimate.previous_from_current, estimate.previous_from_current_covariance),
            .row_misalignment_px = tracked.row_misalignment_px,
            .disparity_offset_px = tracked.disparity_offset_px,
            .quality = estimate.quality};
  }

  const vision::StereoCalibration raw_;
  const Eigen::Isometry3d base_from_left_;  // the rectified left camera
  std::mutex mutex_;                        // guards all below: threads may share the object
  StereoRectifier rectifier_;
  binocular_odometry::TrackingStage tracking_;
  binocular_odometry::MotionStage motion_;
};

TumRow tum(const Estimate& estimate) { return tum_row(estimate.stamp_ns, estimate.odom_from_base.pose); }

std::string estimate_text(const Estimate& estimate) {
  const Eigen::Vector3d at = estimate.odom_from_base.pose.translation();
  return fmt::format("<panvo.OdometryEstimate {:.3f} s: {:.3f} {:.3f} {:.3f} m, {}>", seconds(estimate.stamp_ns),
                     at.x(), at.y(), at.z(),
                     estimate.quality.reliable ? fmt::format("{} inliers", estimate.quality.inliers)
                                               : "unreliable: " + estimate.quality.reason);
}

void bind_estimate(py::module_& module) {
  const auto matrix = [](auto part) {
    return [part](const Estimate& estimate) -> Eigen::Matrix4d { return (estimate.*part).pose.matrix(); };
  };
  const auto covariance = [](auto part) {
    return [part](const Estimate& estimate) -> vision::Matrix6d { return (estimate.*part).covariance; };
  };
  const auto quality = [](auto part) { return [part](const Estimate& estimate) { return estimate.quality.*part; }; };
  using binocular_odometry::Quality;
  py::class_<Estimate>(module, "OdometryEstimate", "Pose and motion of the vehicle at one stereo pair.")
      .def_readonly("stamp_ns", &Estimate::stamp_ns)
      .def_property_readonly("stamp_s", [](const Estimate& estimate) { return seconds(estimate.stamp_ns); })
      .def_property_readonly("pose", matrix(&Estimate::odom_from_base),
                             "odom_from_base, 4 x 4, m; odom is the base at the first pair")
      .def_property_readonly("covariance", covariance(&Estimate::odom_from_base),
                             "of the pose, 6 x 6: x y z (m), rotation about x y z (rad), in the axes of odom")
      .def_property_readonly("motion", matrix(&Estimate::previous_from_current),
                             "previous_from_current, 4 x 4: motion since the previous pair")
      .def_property_readonly("motion_covariance", covariance(&Estimate::previous_from_current))
      .def_property_readonly("reliable", quality(&Quality::reliable), "True: measured; False: predicted")
      .def_property_readonly("reason", quality(&Quality::reason), "why not reliable, with figures; else empty")
      .def_property_readonly("detected", quality(&Quality::detected), "features found in the left image")
      .def_property_readonly("tracked", quality(&Quality::tracked), "of these, tracked from earlier images")
      .def_property_readonly("matched", quality(&Quality::matched), "of the detected ones, also in the right image")
      .def_property_readonly("inliers", quality(&Quality::inliers), "features consistent with the motion")
      .def_property_readonly("inlier_ratio", quality(&Quality::inlier_ratio))
      .def_property_readonly("residual_px", quality(&Quality::residual_px), "RMS reprojection error of the inliers")
      .def_readonly("row_misalignment_px", &Estimate::row_misalignment_px,
                    "largest row error of the right image; above 1 the calibration is stale")
      .def_readonly("disparity_offset_px", &Estimate::disparity_offset_px, "common error of the disparities")
      .def_property_readonly("tum", &tum, "stamp_s x y z qx qy qz qw of the pose: a row of a trajectory")
      .def("__repr__", &estimate_text);
}

}  // namespace

void bind_odometry(py::module_& module) {
  bind_estimate(module);
  using Parameters = binocular_odometry::Parameters;
  py::class_<StereoOdometry>(module, "StereoOdometry",
                             "Stereo odometry with two-stage local bundle adjustment, as `panvo run stereo --replay`. "
                             "Equal inputs give bit-identical results. Threads may share an object.")
      .def(py::init([](const StereoPair& calibration, const py::object& parameters) {
             const auto read = ParameterReader(parameters).read<Parameters>();
             const py::gil_scoped_release release;
             return std::make_unique<StereoOdometry>(calibration, read);
           }),
           py::arg("calibration"), py::arg("parameters") = py::none(),
           "parameters: a dict of names and values, see parameters(). ValueError with each problem.")
      .def("track", &StereoOdometry::track, py::arg("left"), py::arg("right"), py::arg("stamp_s") = py::none(),
           py::kw_only(), py::arg("stamp_ns") = py::none(),
           "Processes the next pair: uint8 images of the calibrated size, (height, width) grey or (height, width, 3) "
           "BGR, as they are stored (raw images are rectified). Stamps increase. An unusable pair gives an estimate "
           "that is not reliable, with the reason.")
      .def_static("parameters", &ParameterReader::describe<Parameters>,
                  "Default, unit, range and description of each parameter, by name.");
}

}  // namespace panvo::python
