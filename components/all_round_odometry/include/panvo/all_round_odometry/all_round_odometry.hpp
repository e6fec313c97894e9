// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/all_round_odometry/camera_rotation.hpp"
#include "panvo/all_round_odometry/panoramic_motion.hpp"
#include "panvo/all_round_odometry/stereo_history.hpp"
#include "panvo/vision/clock_search.hpp"
#include "panvo/vision/odometry_path.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/stamp_sequence.hpp"
#include "panvo/vision/usual_interval.hpp"

namespace panvo::all_round_odometry {

struct Parameters {
  double patience_s = 0.5;

  template <class Field>
  static void describe(Field&& field) {
    field(&Parameters::patience_s, "patience_s", "s",
          "time without a measured motion after which the stereo odometry's prediction is published as unreliable: "
          "longer than the interval of panoramas, shorter than an alarm may take",
          0.05, 10.0);
  }
};

struct AllRoundPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  bool is_reliable = true;
  std::optional<double> agreeing_share;  ///< of the points, if panoramas measured the motion; else it is a stereo pose
};

/// Stereo odometry, continued by the motion in the panoramas while the stereo camera sees nothing usable or is silent.
/// Until its first failure, poses are those of the stereo odometry; afterwards, they are shifted so that the path is
/// continuous. A large offset between the cameras' clocks and an error of the panoramic camera's rotation on the vehicle
/// are estimated and compensated.
class AllRoundOdometry {
 public:
  /// `base_from_camera`: position of the panoramic camera on the vehicle.
  AllRoundOdometry(const Parameters& parameters, const Eigen::Vector3d& base_from_camera);

  /// The position of the panoramic camera has changed: learns all distances again.
  void set_camera(const Eigen::Vector3d& base_from_camera);

  /// In order of stamps; false, without effect, for a stamp not later than the last.
  bool add(const StereoPose& received);
  /// The stereo odometry's clock was set back: forgets all panoramas, and begins again at this pose, where the path so
  /// far leads. `refused`: poses since the last that was added.
  void begin_again(const StereoPose& stereo, int refused);
  /// In order of stamps, each panorama; without tracks if it shows no motion. `is_stereo_silent`: do not wait for stereo
  /// poses up to its stamp. Those of a clock that was set back are used after a few.
  void add(PanoramaPoints panorama, bool is_stereo_silent);

  /// The next pose, in order of stamps; nullopt if more input is needed.
  std::optional<AllRoundPose> next();

 private:
  static constexpr double kMaxSpeed = 70.0;  // m/s: faster than any vehicle

  struct Shift {  // after a failure: where the stereo odometry's path goes on
    Pose stereo, odometry;
  };

  struct PanoramaPose {
    std::int64_t stamp_ns;
    Pose odometry;
  };

  struct Blind {  // since stereo last measured
    Pose begin;
    Pose begin_from_last;  // covariance without the error of the scale
    double scale_variance;
  };

  std::optional<Shift> continued(const StereoPose& stereo, int refused) const;
  StereoPose begin_anew(const StereoPose& stereo);
  void forget_panoramas();
  void search_clock(const PanoramaPoints& received);
  vision::ClockSearch::Reference turns_of_stereo() const;
  void doubt_clock(const PanoramaPoints& panorama);
  void process();
  void process(const PanoramaPoints& received);
  void learn_rotation(const PanoramaPoints& received);
  bool is_contradicted(const PanoramaPoints& panorama, const Eigen::Isometry3d& step, std::int64_t before_ns) const;
  void learn(const PanoramaPoints& panorama, std::int64_t before_ns, const Eigen::Isometry3d& step);
  void measure(const PanoramaPoints& panorama, std::int64_t before_ns);
  void advance(const Eigen::Isometry3d& before_from_now, const vision::Matrix6d& covariance);
  double surprise(const Eigen::Isometry3d& step, double interval_s) const;
  void return_to_stereo(std::int64_t stamp_ns);
  void give_up();
  void emit(const StereoPose& stereo);
  void emit_held();
  Pose shifted(const Pose& stereo) const;
  Pose blind_pose() const;

  Parameters parameters_;
  Eigen::Vector3d base_from_camera_;
  CameraRotation camera_rotation_;
  PanoramicMotion motion_;
  vision::ClockSearch clock_search_;
  vision::ClockDoubt clock_doubt_;
  bool is_clock_doubtful_ = true;
  double ahead_s_ = 0.0;                  // the panoramic camera's clock
  std::int64_t newest_ns_ = INT64_MIN;    // stamp of a stereo pose
  vision::UsualInterval interval_;        // of stereo poses
  vision::OdometryPath path_{kMaxSpeed};  // of the stereo odometry
  StereoHistory stereo_;                  // on that path; the last held_ ones wait for a panorama
  std::size_t held_ = 0;
  std::deque<PanoramaPoints> panoramas_;     // waiting for the stereo odometry
  vision::StampSequence panorama_stamps_;    // as received
  std::optional<std::int64_t> panorama_ns_;  // stamp of the latest
  bool is_stereo_silent_ = false;
  std::optional<Shift> shift_;
  std::optional<PanoramaPose> last_;  // panorama with a known pose
  std::optional<Blind> blind_;
  bool is_contradicted_ = false;                       // the stereo odometry, by the last panorama that could tell
  vision::Vector6d twist_ = vision::Vector6d::Zero();  // of the vehicle, m/s and rad/s
  std::int64_t sure_ns_ = INT64_MIN;                   // last pose with a measured motion
  std::int64_t emitted_ns_ = INT64_MIN;
  Pose emitted_;
  std::deque<AllRoundPose> ready_;
};

}  // namespace panvo::all_round_odometry
