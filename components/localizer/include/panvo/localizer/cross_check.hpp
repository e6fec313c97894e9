// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/azimuth_measurement.hpp"
#include "panvo/localizer/dead_reckoning.hpp"
#include "panvo/localizer/direction_offset.hpp"
#include "panvo/localizer/dispute.hpp"
#include "panvo/localizer/doubt.hpp"
#include "panvo/localizer/localizer_parameters.hpp"
#include "panvo/localizer/odometry_chain.hpp"

namespace panvo::localizer {

/// Whether odometry and panoramas can both be right about how the vehicle moved; who is wrong where they cannot, and how uncertain the odometry
/// is then. It makes stretches of the odometry less sure and never moves them.
class CrossCheck {
 public:
  /// Between two panoramas, of which the earlier is kept over several.
  struct Stretch {
    std::int64_t reference_ns;    ///< the earlier one's own stamp
    std::int64_t from_ns, to_ns;  ///< in the odometry's clock
  };

  explicit CrossCheck(const Parameters& parameters);

  /// The last step of the odometry.
  void add_step(const OdometryChain& chain);

  /// What follows is against another panorama than what came before.
  void begin_reference();

  /// By how much the panoramas turned more than odometry, and whether that is more than both can err by. Who is wrong; nullopt where nobody is.
  std::optional<Wrong> compare_turns(const OdometryChain& chain, const Stretch& stretch, double disagreement_rad,
                                     bool is_too_much);

  /// After compare_turns and what followed of it. `way_variance_m2`: what odometry says of both ways together. Since when the vehicle may have moved
  /// otherwise than odometry says; nullopt where it has not.
  std::optional<std::int64_t> compare_ways(OdometryChain& chain, const Stretch& stretch,
                                           const AzimuthMeasurement& azimuth, double way_variance_m2);

  /// What was measured so far is of another clock. The mounts stay what they are.
  void forget();

  /// Why the odometry up to `now_ns` is not to be followed; nullopt where it may be.
  std::optional<std::string> fault_of_odometry(std::int64_t now_ns) const;
  std::vector<Doubt> doubts(std::int64_t now_ns) const;

  /// By what the direction of the whole way may be off.
  double direction_sigma_rad() const;
  const DirectionOffset& direction_offset() const noexcept { return direction_offset_; }

 private:
  struct TurnAndWay {  // in the plane
    double turn_rad;
    Eigen::Vector2d way_m;  // in the axes at its end
  };

  struct GoneOn {  // against a vehicle that went on as it did when odometry and panoramas last agreed
    TurnAndWay more;
    double turn_sigma_rad, way_sigma_m;  // of what vehicles do meanwhile
  };

  struct Seen {  // directions, by odometry and panoramas
    double difference_rad, variance_rad2;
  };

  struct Lasting {  // difference between the directions
    std::int64_t reference_ns;
    double seen_rad;
    double way_m;
  };

  struct Jump {  // of the odometry's speed
    std::int64_t stamp_ns;
    double speed_m_s;
  };

  struct Break {  // of the odometry, between two images that it measured by
    std::int64_t from_ns, to_ns;
    std::int64_t vouched_ns;  // up to which panoramas agree with it
    bool is_over;
  };

  static std::optional<TurnAndWay> moved(const OdometryChain& chain, std::int64_t from_ns, std::int64_t to_ns);
  std::optional<GoneOn> gone_on(const OdometryChain& chain, std::int64_t to_ns) const;
  bool goes_on_steadily(const OdometryChain& chain, std::int64_t to_ns) const;
  Wrong wrong_turn(const OdometryChain& chain, std::int64_t to_ns, double disagreement_rad) const;
  std::optional<double> way_off(const AzimuthMeasurement& azimuth, const TurnAndWay& odometry, double way_variance_m2);
  bool lasts(std::int64_t reference_ns, double seen_rad, double length_m);
  std::optional<std::int64_t> check_break(OdometryChain& chain, const Stretch& stretch);
  bool is_disputed() const noexcept { return turn_dispute_.is_on() || way_dispute_.is_on(); }
  bool is_camera_turned() const noexcept { return turn_dispute_.is_on() && turn_dispute_.wrong() == Wrong::kPanoramas; }
  bool is_fresh(std::int64_t stamp_ns, std::int64_t now_ns) const;

  const double contradiction_sigmas_, patience_s_;
  const MotionPrior motion_;
  DirectionOffset direction_offset_;
  double camera_turned_rad_ = 0.0;  // the panoramic one, on its mount, since the start
  Dispute turn_dispute_, way_dispute_;
  std::optional<std::int64_t> agreed_ns_;  // the last panorama that agreed with the odometry
  std::optional<Seen> seen_;               // against the current reference, last
  std::optional<Lasting> lasting_;         // while the directions differ
  std::optional<Jump> jump_;               // since the last panorama
  std::optional<Break> break_;             // for which no panorama has vouched yet
};

}  // namespace panvo::localizer
