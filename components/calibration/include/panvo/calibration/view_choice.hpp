// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration/board_look.hpp"
#include "panvo/calibration/coverage.hpp"

namespace panvo::calibration {

/// What a camera must have seen before a calibration is worth its name.
struct ViewGoals {
  std::size_t views = 20;
  std::size_t shared = 10;           ///< of these, seen by another camera too
  double covered = Coverage::kGood;  ///< share of the image's cells that hold corners
  double along_sides = 1.0 / 3.0;    ///< the same of the cells along each side of the image
  std::size_t tilted = 3;            ///< views tilted about each axis of the image
  double size_ratio = 1.5;           ///< of the board at its nearest and at its farthest

  /// Of cameras whose lenses are known, so that only their poses are looked for.
  static ViewGoals of_poses() { return {10, 10, 0.0, 0.0, 0, 1.0}; }
};

/// Chooses, while a board is moved before cameras, the views to calibrate from: those that differ from all kept so far.
class ViewChoice {
 public:
  ViewChoice(const std::vector<std::string>& cameras, std::vector<cv::Size> image_sizes, const Board& board,
             const ViewGoals& goals);

  /// Keeps a view (a list of corners for each camera; empty: not seen) if it adds something. A kept one counts as like it when all
  /// cameras that see the new one saw it there, at nearly the same place, size and slant; one that reaches where no corner was yet is kept all
  /// the same.
  bool offer(const std::vector<std::vector<Corner>>& seen);

  std::size_t kept() const { return looks_.size(); }

  /// Share of the camera's image that holds corners.
  double covered(std::size_t camera) const { return coverage(observations_, camera).share; }

  /// What the camera still lacks, as one who holds the board is to be told ("the left side", "3 more views"); empty: nothing.
  std::vector<std::string> lacks(std::size_t camera) const;

  /// Whether no camera lacks anything.
  bool is_enough() const;

 private:
  using Looks = std::vector<std::optional<BoardLook>>;  // by camera; nullopt: not seen

  bool reaches_new_places(const std::vector<std::vector<Corner>>& seen) const;
  std::vector<std::string> uncovered(std::size_t camera) const;

  Board board_;
  ViewGoals goals_;
  Observations observations_;  // of what is kept
  std::vector<Looks> looks_;   // the same
};

}  // namespace panvo::calibration
