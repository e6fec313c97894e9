// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/board.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

constexpr int kMinCount = 3;
constexpr int kMaxCount = 100;
constexpr double kMaxSquare_m = 10.0;

[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw CalibrationError(
      fmt::format("board '{}': {}; use chessboard:9x6:0.025 (inner corners, square side in m) or "
                  "charuco:8x6:0.03:0.022:DICT_5X5_100 (squares, square and marker side in m)",
                  text, what));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

int read_count(std::string_view whole, std::string_view word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < kMinCount || value > kMaxCount)
    refuse(whole, fmt::format("'{}' is not a count from {} to {}", word, kMinCount, kMaxCount));
  return value;
}

double read_side(std::string_view whole, std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value > 0.0) || value > kMaxSquare_m)
    refuse(whole, fmt::format("'{}' is not a side length in metres above 0 and up to {}", word, kMaxSquare_m));
  return value;
}

}  // namespace

Eigen::Vector3d Board::point(int id) const {
  return {square_m * (id % columns), square_m * (id / columns), 0.0};  // integer division is intended
}

std::vector<Eigen::Vector3d> Board::points() const {
  std::vector<Eigen::Vector3d> all;
  for (int id = 0; id < corners(); ++id) all.push_back(point(id));
  return all;
}

bool Board::is_symmetric() const { return kind == Kind::kChessboard && (columns % 2 == rows % 2 || columns == rows); }

Board parse_board(std::string_view text) {
  const auto parts = split(text, ':');
  Board board;
  const bool is_charuco = parts[0] == "charuco";
  if (!is_charuco && parts[0] != "chessboard") refuse(text, fmt::format("unknown kind '{}'", parts[0]));
  if (is_charuco ? parts.size() != 4 && parts.size() != 5 : parts.size() != 3)
    refuse(text, fmt::format("it has {} fields separated by colons", parts.size()));
  const auto counts = split(parts[1], 'x');
  if (counts.size() != 2) refuse(text, fmt::format("'{}' is not of the form COLUMNSxROWS", parts[1]));
  board.columns = read_count(text, counts[0]);
  board.rows = read_count(text, counts[1]);
  board.square_m = read_side(text, parts[2]);
  if (!is_charuco) return board;
  board.kind = Board::Kind::kCharuco;
  board.columns -= 1;
  board.rows -= 1;
  board.marker_m = read_side(text, parts[3]);
  if (board.marker_m >= board.square_m) refuse(text, "a marker must be smaller than its square");
  board.dictionary = parts.size() == 5 ? std::string(parts[4]) : "DICT_5X5_100";
  return board;
}

std::string to_string(const Board& board) {
  if (board.kind == Board::Kind::kChessboard)
    return fmt::format("chessboard:{}x{}:{}", board.columns, board.rows, board.square_m);
  return fmt::format("charuco:{}x{}:{}:{}:{}", board.columns + 1, board.rows + 1, board.square_m, board.marker_m,
                     board.dictionary);
}

}  // namespace panvo::calibration
