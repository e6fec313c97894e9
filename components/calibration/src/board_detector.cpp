// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/board_detector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "charuco.hpp"

namespace panvo::calibration {
namespace {

constexpr std::size_t kMinCorners = 8;       // of a ChArUco board: twice the minimum for a pose
constexpr double kNarrowestWindow_px = 2.0;  // half side of the refinement window
constexpr double kWidestWindow_px = 11.0;
constexpr double kWindowShare = 0.35;  // of a square's side in the image, to exclude other corners
constexpr double kMarginShare = 0.9;   // of the white margin around a marker, to exclude marker corners

/// Side of the squares around a corner, px: the distance to the nearest detected neighbour.
double side_px(const std::vector<Corner>& corners, const Corner& corner, int columns) {
  double nearest = 1e9;
  for (const auto& other : corners) {
    const int steps =
        std::abs(other.id / columns - corner.id / columns) + std::abs(other.id % columns - corner.id % columns);
    if (steps == 1) nearest = std::min(nearest, (other.pixel - corner.pixel).norm());
  }
  return nearest;
}

/// Refines each corner with its own window, since near squares are larger in the image.
void refine(const cv::Mat& grey, const Board& board, std::vector<Corner>& corners) {
  const double margin = 0.5 * (board.square_m - board.marker_m) / board.square_m;
  const double share =
      board.kind == Board::Kind::kCharuco ? std::min(kWindowShare, kMarginShare * margin) : kWindowShare;
  const auto rough = corners;
  for (auto& corner : corners) {
    const int half = static_cast<int>(
        std::clamp(share * side_px(rough, corner, board.columns), kNarrowestWindow_px, kWidestWindow_px));
    std::vector<cv::Point2f> place{{static_cast<float>(corner.pixel.x()), static_cast<float>(corner.pixel.y())}};
    cv::cornerSubPix(grey, place, {half, half}, {-1, -1}, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
    corner.pixel = {place[0].x, place[0].y};
  }
}

double brightness(const cv::Mat& grey, cv::Point2f at) {
  cv::Mat patch;
  cv::getRectSubPix(grey, {3, 3}, at, patch);
  return cv::mean(patch)[0];
}

}  // namespace

BoardDetector::BoardDetector(const Board& board) : board_(board) {
  if (board.kind == Board::Kind::kCharuco) charuco_ = std::make_unique<CharucoDetector>(board);
}

BoardDetector::~BoardDetector() = default;

Sighting BoardDetector::detect(const cv::Mat& grey) const {
  return board_.kind == Board::Kind::kChessboard ? detect_chessboard(grey) : detect_charuco(grey);
}

/// Whether the corners must be reversed. The upper left square is black; the first corner is next to it. For a
/// symmetric board the order is chosen by the position in the image.
bool BoardDetector::is_reversed(const cv::Mat& grey, const std::vector<cv::Point2f>& corners) const {
  if (board_.is_symmetric()) {
    const cv::Point2f direction = corners.back() - corners.front();
    return direction.x + direction.y < 0.0F;
  }
  const auto columns = static_cast<std::size_t>(board_.columns);
  const auto middle = [&](std::size_t first) {
    return 0.25F * (corners[first] + corners[first + 1] + corners[first + columns] + corners[first + columns + 1]);
  };
  // the square after the first corner is black, as the upper left one; the next one in the row is white
  return brightness(grey, middle(0)) > brightness(grey, middle(1));
}

Sighting BoardDetector::detect_chessboard(const cv::Mat& grey) const {
  std::vector<cv::Point2f> corners;
  const cv::Size pattern(board_.columns, board_.rows);
  // not findChessboardCorners, which takes ten seconds if there is no board
  if (!cv::findChessboardCornersSB(grey, pattern, corners, cv::CALIB_CB_NORMALIZE_IMAGE))
    return {{}, fmt::format("no complete chessboard of {} x {} corners found", board_.columns, board_.rows)};
  if (is_reversed(grey, corners)) std::reverse(corners.begin(), corners.end());
  Sighting sighting;
  for (const auto& corner : corners)
    sighting.corners.push_back({static_cast<int>(sighting.corners.size()), {corner.x, corner.y}});
  refine(grey, board_, sighting.corners);
  return sighting;
}

Sighting BoardDetector::detect_charuco(const cv::Mat& grey) const {
  const auto [markers, ids, corners] = charuco_->detect(grey);
  if (markers == 0) return {{}, fmt::format("no markers of {} found", board_.dictionary)};
  std::set<int> rows, columns;
  for (const int id : ids) {
    rows.insert(id / board_.columns);
    columns.insert(id % board_.columns);
  }
  if (ids.size() < kMinCorners || rows.size() < 2 || columns.size() < 2)
    return {{},
            fmt::format("{} markers and {} corners found; at least {} corners in two rows and columns are needed",
                        markers, ids.size(), kMinCorners)};
  Sighting sighting;
  for (std::size_t i = 0; i < ids.size(); ++i) sighting.corners.push_back({ids[i], {corners[i].x, corners[i].y}});
  refine(grey, board_, sighting.corners);
  return sighting;
}

}  // namespace panvo::calibration
