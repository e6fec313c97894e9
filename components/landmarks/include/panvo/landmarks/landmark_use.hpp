// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace panvo::landmarks {

/// How a stored landmark served in all runs since it was built.
struct LandmarkUse {
  std::uint32_t passes = 0;             ///< drives past it
  std::uint32_t recognitions = 0;       ///< of these, those that recognised it
  std::uint32_t missed = 0;             ///< passes since the last recognition
  std::uint32_t missed_in_company = 0;  ///< of these, those on which others of its day were recognised

  bool operator==(const LandmarkUse&) const = default;
};

/// A drive past a landmark that has ended.
struct LandmarkPass {
  std::uint32_t id = 0;
  bool recognised = false;
  bool in_company = false;  ///< another landmark of the same day was recognised shortly before

  bool operator==(const LandmarkPass&) const = default;
};

void add(const LandmarkPass& pass, LandmarkUse& use);

/// Counts drives past landmarks, from the vehicle's positions in the map and from its recognitions. A landmark that is
/// not recognised may be gone, or look different today. Only in the first case are others that were built on the same day
/// recognised around it: they look the same as when they were built.
class PassCounter {
 public:
  static constexpr double kPassed_m = 5.0;     ///< path within which a landmark should be recognised
  static constexpr double kLeft_m = 25.0;      ///< beyond, it is no longer recognised: the pass ends
  static constexpr double kCompany_m = 300.0;  ///< path for which a recognition tells how the surroundings look
  static constexpr double kStep_m = 1.0;       ///< path between two checks
  static constexpr std::int64_t kDay_ns = 12LL * 3600 * 1'000'000'000;  ///< built within it: on the same day

  /// A landmark built at `stamp_ns`, or its new position.
  void set_landmark(std::uint32_t id, const Eigen::Vector2d& position_m, std::int64_t stamp_ns);
  void recognised(std::uint32_t id);
  /// Passes that have ended at this position of the vehicle.
  std::vector<LandmarkPass> move_to(const Eigen::Vector2d& position_m);

 private:
  struct Landmark {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    std::int64_t stamp_ns = 0;
    bool is_passed = false, is_recognised = false;
  };
  struct Recognition {
    std::uint32_t id = 0;
    std::int64_t stamp_ns = 0;  ///< when the landmark was built
    double travelled_m = 0.0;
  };

  bool has_company(std::uint32_t id, std::int64_t stamp_ns) const;

  std::map<std::uint32_t, Landmark> landmarks_;
  std::deque<Recognition> recent_;
  std::optional<Eigen::Vector2d> last_;
  double travelled_m_ = 0.0;
};

/// What a place may keep and what it loses, from one run to the next.
struct UseRules {
  int appearances = 4;  ///< landmarks at one place
  double same_place_m = 15.0;
  int forget_after = 10;  ///< passes missed in company after which a landmark is removed; 0: never

  struct Admission {
    bool is_kept = false;
    std::optional<std::size_t> instead_of;  ///< of the known ones, that which is removed for it
  };
  /// Whether a landmark built beside these known ones is kept: if there are none, or if each was missed on its last pass in
  /// an earlier run as well, so that a single miss adds nothing. A place that is full loses the landmark that was missed
  /// most often since it was recognised, if that is at least `forget_after` times.
  Admission admit(const std::vector<LandmarkUse>& beside) const;
  bool forgets(const LandmarkUse& use) const;
};

}  // namespace panvo::landmarks
