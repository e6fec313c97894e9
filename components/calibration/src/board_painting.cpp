// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/board_painting.hpp"

#include <fmt/format.h>

#include "charuco.hpp"

namespace panvo::calibration {
namespace {

/// Area of a square, m. The first corner lies between the first two rows and columns of squares.
cv::Rect2d square(const Board& board, int column, int row) {
  return {board.square_m * (column - 1), board.square_m * (row - 1), board.square_m, board.square_m};
}

/// Adds a black marker and its white bits. `corners`: clockwise from the upper left one, Y down.
void paint_marker(const cv::Mat& bits, const std::vector<cv::Point3f>& corners, double square_m,
                  std::vector<Patch>& patches) {
  const double left = corners[0].x - square_m;
  const double top = corners[0].y - square_m;
  const double side = corners[1].x - corners[0].x;
  const double module = side / (bits.cols + 2);
  patches.push_back({{left, top, side, side}, true});
  for (int row = 0; row < bits.rows; ++row) {
    for (int column = 0; column < bits.cols; ++column) {
      if (bits.at<uchar>(row, column) == 0) continue;
      patches.push_back({{left + module * (column + 1), top + module * (row + 1), module, module}, false});
    }
  }
}

}  // namespace

std::vector<Patch> paint(const Board& board) {
  std::vector<Patch> patches;
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = row % 2; column <= board.columns; column += 2) patches.push_back({square(board, column, row)});
  }
  if (board.kind == Board::Kind::kChessboard) return patches;
  for (const auto& marker : charuco_markers(board)) paint_marker(marker.bits, marker.corners, board.square_m, patches);
  return patches;
}

std::string draw_board(const Board& board) {
  constexpr double kMillimetres = 1e3;
  const double side = kMillimetres * board.square_m;
  const double width = side * (board.columns + 3);
  const double height = side * (board.rows + 3);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 {0:.3f} "
      "{1:.3f}\" shape-rendering=\"crispEdges\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n",
      width, height, to_string(board));
  for (const auto& [area, is_black] : paint(board)) {
    const double x = 2.0 * side + kMillimetres * area.x;
    const double y = 2.0 * side + kMillimetres * area.y;
    svg += fmt::format("<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" fill=\"{}\"/>\n", x, y,
                       kMillimetres * area.width, kMillimetres * area.height, is_black ? "#000" : "#fff");
  }
  return svg + "</svg>\n";
}

}  // namespace panvo::calibration
