// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::calibration {

/// A flat board of black and white squares, with markers in the white ones (ChArUco) or without. As it is
/// printed, its frame has X to the right along a row of corners and Y down along a column, metres; the first corner is the origin.
struct Board {
  enum class Kind { kChessboard, kCharuco };

  Kind kind = Kind::kChessboard;
  int columns = 0;  ///< of corners where four squares meet: one less than squares
  int rows = 0;
  double square_m = 0.0;
  double marker_m = 0.0;   ///< of kCharuco: side of a marker
  std::string dictionary;  ///< of kCharuco: as OpenCV calls it, DICT_5X5_100

  int corners() const { return columns * rows; }

  /// Where corner `id` = row * columns + column is, m; z = 0.
  Eigen::Vector3d point(int id) const;
  std::vector<Eigen::Vector3d> points() const;

  /// Whether it looks the same upside down, so that two cameras may count its corners from different ends.
  bool is_symmetric() const;
};

/// Reads "chessboard:9x6:0.025" (corners inside, side of a square in m) or "charuco:8x6:0.03:0.022[:DICT_5X5_100]" (squares, sides of a
/// square and of a marker in m; the dictionary is DICT_5X5_100 if nothing is said). Throws CalibrationError.
Board parse_board(std::string_view text);

/// The opposite of parse_board.
std::string to_string(const Board& board);

}  // namespace panvo::calibration
