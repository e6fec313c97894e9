// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::calibration {

/// A flat board of black and white squares, for ChArUco with markers in the white ones. Board frame: origin at the
/// first corner, X right along a row of corners and Y down along a column, as printed; metres.
struct Board {
  enum class Kind { kChessboard, kCharuco };

  Kind kind = Kind::kChessboard;
  int columns = 0;  ///< of inner corners: one less than squares
  int rows = 0;
  double square_m = 0.0;
  double marker_m = 0.0;   ///< kCharuco: side of a marker
  std::string dictionary;  ///< kCharuco: OpenCV's name, e.g. DICT_5X5_100

  int corners() const { return columns * rows; }

  /// Position of corner `id` = row * columns + column in the board frame, m; z = 0.
  Eigen::Vector3d point(int id) const;
  std::vector<Eigen::Vector3d> points() const;

  /// Whether the board looks the same upside down, so that two cameras may number its corners from different ends.
  bool is_symmetric() const;
};

/// Parses "chessboard:9x6:0.025" (inner corners, square side in m) or "charuco:8x6:0.03:0.022[:DICT_5X5_100]" (squares,
/// square and marker side in m; default dictionary DICT_5X5_100). Throws CalibrationError.
Board parse_board(std::string_view text);

/// Inverse of parse_board().
std::string to_string(const Board& board);

}  // namespace panvo::calibration
