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
  std::uint32_t session = 0;            ///< run in which it was built; 0: before sessions were counted
  std::uint32_t passes = 0;             ///< drives past it
  std::uint32_t recognitions = 0;       ///< of these, those that recognised it
  std::uint32_t missed = 0;             ///< passes since the last recognition
  std::uint32_t missed_in_company = 0;  ///< of these, those on which most others of its session were recognised

  bool operator==(const LandmarkUse&) const = default;
};

/// A drive past a landmark that has ended.
struct LandmarkPass {
  std::uint32_t id = 0;
  bool recognised = false;
  bool in_company = false;  ///< most others of its session were recognised before it

  bool operator==(const LandmarkPass&) const = default;
};

void add(const LandmarkPass& pass, LandmarkUse& use);

/// Counts drives past landmarks, from the vehicle's positions in the map and from its recognitions. A landmark that is
/// not recognised may be gone, or look different today. The others of its session tell: if most of them are recognised,
/// the surroundings look as they did then; if most are missed, they do not (snow, night).
class PassCounter {
 public:
  static constexpr double kPassed_m = 5.0;        ///< path within which a landmark should be recognised
  static constexpr double kLeft_m = 25.0;         ///< distance at which the pass ends: no recognition from there
  static constexpr double kStep_m = 1.0;          ///< path between two checks
  static constexpr std::size_t kRecent = 20;      ///< latest passes of a session that tell how the surroundings look
  static constexpr std::size_t kEnoughSame = 10;  ///< of these, at least, to say that they look the same
  static constexpr std::size_t kEnoughOther = 5;  ///< at least, to say that they look different
  static constexpr double kMost = 0.8;            ///< share recognised when all looks the same
  static constexpr double kFew = 0.5;             ///< share recognised at most when all looks different

  /// Adds a landmark of a session, or moves it. The drive that builds a landmark does not count as a pass.
  void set_landmark(std::uint32_t id, const Eigen::Vector2d& position_m, std::uint32_t session);
  void recognised(std::uint32_t id);
  /// Of a pass that has begun, only the rest will be seen: it does not count.
  void leave_out_current();
  /// Passes that have ended at this position of the vehicle.
  std::vector<LandmarkPass> move_to(const Eigen::Vector2d& position_m);

  /// Most landmarks of the session that were passed last were recognised.
  bool looks_same(std::uint32_t session) const;
  /// At most half of them were.
  bool looks_different(std::uint32_t session) const;

 private:
  struct Landmark {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    std::uint32_t session = 0;
    bool is_passed = false, is_recognised = false;
    bool is_just_built = false;  ///< or the first part of the pass is unknown; the vehicle has not left it yet
  };

  std::map<std::uint32_t, Landmark> landmarks_;
  std::map<std::uint32_t, std::deque<bool>> recent_;  ///< of each session: whether the landmarks passed were recognised
  std::optional<Eigen::Vector2d> last_;
};

/// What a place may keep and what it loses, from one run to the next.
struct UseRules {
  int appearances = 4;  ///< landmarks at one place
  double same_place_m = 15.0;
  int forget_after = 10;  ///< passes missed in company after which a landmark is removed; 0: never
  int learn_after = 2;    ///< drives that miss a landmark whose session looks different now, before another joins it
  int learn_after_alone = 4;  ///< the same where the session does not: a miss may be chance, and recur by chance

  /// A known landmark at the place of a new one.
  struct Neighbour {
    LandmarkUse use;               ///< before this run, which misses it, too
    bool looks_different = false;  ///< its session does today
  };
  struct Admission {
    bool is_kept = false;
    std::optional<std::size_t> instead_of;  ///< of the neighbours, that which is removed for it
  };
  /// Whether a new landmark is kept beside its neighbours: if there are none, or if each was missed often enough in a row.
  /// A place that is full loses the landmark that was missed most often since it was recognised, if that is at least
  /// `forget_after` times.
  Admission admit(const std::vector<Neighbour>& neighbours) const;
  bool forgets(const LandmarkUse& use) const;
};

}  // namespace panvo::landmarks
