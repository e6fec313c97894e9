// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/view_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace panvo::calibration {
namespace {

constexpr double kNewLook = 0.15;  // threshold of difference(): about the width of a board at the largest distance
constexpr int kNewCells = 2;       // of the 48 cells of Coverage
constexpr double kTilted = 0.1;    // BoardLook::slant of a board tilted by 25 degrees

bool is_like(const std::vector<std::optional<BoardLook>>& kept, const std::vector<std::optional<BoardLook>>& view) {
  for (std::size_t camera = 0; camera < view.size(); ++camera) {
    if (view[camera] && (!kept[camera] || difference(*kept[camera], *view[camera]) >= kNewLook)) return false;
  }
  return true;
}

/// Fraction of cells with corners in a range of columns and rows.
double share_of(const Coverage& cover, int first_column, int last_column, int first_row, int last_row) {
  int covered = 0, cells = 0;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column, ++cells)
      covered += cover.corners.at(static_cast<std::size_t>(row * Coverage::kColumns + column)) > 0 ? 1 : 0;
  }
  return static_cast<double>(covered) / cells;
}

std::string more_views(std::size_t count, const char* which) {
  return fmt::format("{} more view{}{}", count, count == 1 ? "" : "s", which);
}

}  // namespace

ViewChoice::ViewChoice(const std::vector<std::string>& cameras, std::vector<cv::Size> image_sizes, const Board& board,
                       const ViewGoals& goals)
    : board_(board), goals_(goals), observations_{cameras, std::move(image_sizes), board.points(), {}} {}

bool ViewChoice::offer(const std::vector<std::vector<Corner>>& seen) {
  Looks looks;
  for (std::size_t camera = 0; camera < seen.size(); ++camera)
    looks.push_back(look_of(seen[camera], board_, observations_.image_sizes[camera]));
  if (std::none_of(looks.begin(), looks.end(), [](const auto& look) { return look.has_value(); })) return false;
  const bool is_known =
      std::any_of(looks_.begin(), looks_.end(), [&](const auto& kept) { return is_like(kept, looks); });
  if (is_known && !reaches_new_places(seen)) return false;
  observations_.views.push_back({fmt::format("{}", kept()), seen});
  looks_.push_back(std::move(looks));
  return true;
}

bool ViewChoice::reaches_new_places(const std::vector<std::vector<Corner>>& seen) const {
  Observations view{observations_.cameras, observations_.image_sizes, {}, {{"", seen}}};
  for (std::size_t camera = 0; camera < seen.size(); ++camera) {
    const auto before = coverage(observations_, camera).corners, now = coverage(view, camera).corners;
    int cells = 0;
    for (std::size_t i = 0; i < now.size(); ++i) cells += now[i] > 0 && before[i] == 0 ? 1 : 0;
    if (cells >= kNewCells) return true;
  }
  return false;
}

std::vector<std::string> ViewChoice::uncovered(std::size_t camera) const {
  constexpr int kRight = Coverage::kColumns - 1, kBottom = Coverage::kRows - 1;
  const auto cover = coverage(observations_, camera);
  std::vector<std::string> places;
  if (share_of(cover, 0, 0, 0, kBottom) < goals_.along_sides) places.emplace_back("the left side");
  if (share_of(cover, kRight, kRight, 0, kBottom) < goals_.along_sides) places.emplace_back("the right side");
  if (share_of(cover, 0, kRight, 0, 0) < goals_.along_sides) places.emplace_back("the top");
  if (share_of(cover, 0, kRight, kBottom, kBottom) < goals_.along_sides) places.emplace_back("the bottom");
  if (places.empty() && cover.share < goals_.covered) places.emplace_back("more of the image");
  return places;
}

std::vector<std::string> ViewChoice::lacks(std::size_t camera) const {
  std::size_t views = 0, shared = 0, tilted = 0, turned = 0;
  double smallest = std::numeric_limits<double>::max(), largest = 0.0;
  for (const auto& looks : looks_) {
    const auto& look = looks[camera];
    if (!look) continue;
    ++views;
    shared += std::count_if(looks.begin(), looks.end(), [](const auto& one) { return one.has_value(); }) > 1 ? 1 : 0;
    tilted += look->slant.x() > kTilted ? 1 : 0;
    turned += look->slant.x() < -kTilted ? 1 : 0;
    smallest = std::min(smallest, look->size);
    largest = std::max(largest, look->size);
  }
  auto missing = uncovered(camera);
  if (tilted < goals_.tilted) missing.emplace_back("more tilt forwards or back");
  if (turned < goals_.tilted) missing.emplace_back("more tilt to the left or right");
  if (views > 0 && largest < goals_.size_ratio * smallest) missing.emplace_back("a nearer or farther board");
  if (views < goals_.views) missing.push_back(more_views(goals_.views - views, ""));
  if (shared < goals_.shared) missing.push_back(more_views(goals_.shared - shared, " shared with another camera"));
  return missing;
}

bool ViewChoice::is_enough() const {
  for (std::size_t camera = 0; camera < observations_.cameras.size(); ++camera) {
    if (!lacks(camera).empty()) return false;
  }
  return true;
}

}  // namespace panvo::calibration
