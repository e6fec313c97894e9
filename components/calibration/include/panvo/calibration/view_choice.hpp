// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/board_look.hpp"
#include "panvo/calibration/coverage.hpp"

namespace panvo::calibration {

/// Views that each camera needs for a good calibration.
struct ViewGoals {
  std::size_t views = 20;
  std::size_t shared = 10;           ///< views that another camera sees, too
  double covered = Coverage::kGood;  ///< fraction of the image's cells that contain corners
  double along_sides = 1.0 / 3.0;    ///< the same for the cells along each side of the image
  std::size_t tilted = 3;            ///< views tilted about each axis of the image
  double size_ratio = 1.5;           ///< largest to smallest size of the board in the image

  /// Goals for estimating only the poses of cameras with known lenses.
  static ViewGoals of_poses() { return {10, 10, 0.0, 0.0, 0, 1.0}; }
};

/// Selects views for a calibration while a board is moved in front of the cameras: those that differ from all kept
/// views.
class ViewChoice {
 public:
  ViewChoice(const std::vector<std::string>& cameras, std::vector<cv::Size> image_sizes, const Board& board,
             const ViewGoals& goals);

  /// Keeps a view (corners by camera; empty: not seen) if it differs from all kept views or covers new cells of an
  /// image. It equals a kept view if every camera that sees the board saw it there at nearly the same position, size
  /// and slant. Returns whether it is kept.
  bool offer(const std::vector<std::vector<Corner>>& seen);

  std::size_t kept() const { return looks_.size(); }

  /// Fraction of the camera's image that contains corners.
  double covered(std::size_t camera) const { return coverage(observations_, camera).share; }

  /// What the camera still needs, as text for the user ("the left side", "3 more views"); empty: nothing.
  std::vector<std::string> lacks(std::size_t camera) const;

  /// Whether all goals are reached.
  bool is_enough() const;

 private:
  using Looks = std::vector<std::optional<BoardLook>>;  // by camera; nullopt: not seen

  bool reaches_new_places(const std::vector<std::vector<Corner>>& seen) const;
  std::vector<std::string> uncovered(std::size_t camera) const;

  Board board_;
  ViewGoals goals_;
  Observations observations_;  // kept views
  std::vector<Looks> looks_;   // of the kept views
};

}  // namespace panvo::calibration
