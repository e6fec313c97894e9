// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// How the landmarks of a store serve in a run, and which new ones are kept beside those of earlier runs.
class MapUse {
 public:
  explicit MapUse(const UseRules& rules) : rules_(rules) {}

  /// A landmark of the store. `before`: of one that is there from an earlier run, how it served until this one began.
  void add(const LandmarkPose& pose, const LandmarkUse& use, const std::optional<LandmarkUse>& before = {});
  void move(const LandmarkPose& pose);
  void forget(std::uint32_t id);

  void recognised(std::uint32_t id) { passes_.recognised(id); }
  void leave_out_current() { passes_.leave_out_current(); }
  std::vector<LandmarkPass> drive_to(const Eigen::Vector2d& position_m);

  /// Those that are removed.
  std::vector<std::uint32_t> outdated(const std::map<std::uint32_t, LandmarkUse>& uses) const;
  struct Admission {
    bool is_kept = false;
    std::optional<std::uint32_t> instead_of;  ///< that which is removed for it
    std::optional<std::uint32_t> beside;      ///< one at its place
  };
  Admission admit(const Eigen::Vector2d& position_m) const;

 private:
  struct Landmark {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    LandmarkUse use;
    std::optional<LandmarkUse> before;
  };

  UseRules rules_;
  PassCounter passes_;
  std::map<std::uint32_t, Landmark> landmarks_;
};

}  // namespace panvo::landmarks
