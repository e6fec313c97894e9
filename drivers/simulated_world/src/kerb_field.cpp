// SPDX-License-Identifier: Apache-2.0
#include "kerb_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace panvo::simulated_world {
namespace {

constexpr double kStep_m = 0.5;     // of the grid
constexpr double kMargin_m = 70.0;  // of the grid around the roads

}  // namespace

double KerbField::Segment::distance_to_middle_m(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d offset = point - start;
  return (offset - std::clamp(offset.dot(along), 0.0, length_m) * along).norm();
}

Eigen::Vector2d KerbField::node(int column, int row) const { return corner_ + kStep_m * Eigen::Vector2d(column, row); }

KerbField::KerbField(const RoadNetwork& roads) {
  add_segments(roads);
  if (segments_.empty()) throw std::invalid_argument("a site needs roads, but the road network has none");
  size_grid();
  add_turning_circles(roads);
  nearest_ = nearest_segments(segments_, std::numeric_limits<double>::infinity());
  distance_m_.resize(nearest_.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t i = index(column, row);
      distance_m_[i] =
          static_cast<float>(segments_[static_cast<std::size_t>(nearest_[i])].distance_m(node(column, row)));
    }
  }
  round_corners();
}

void KerbField::add_segments(const RoadNetwork& roads) {
  for (std::size_t road = 0; road < roads.roads.size(); ++road) {
    const std::vector<Eigen::Vector2d>& line = roads.roads[road].centre_line;
    double along_m = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Eigen::Vector2d step = line[i] - line[i - 1];
      const double length_m = step.norm();
      if (length_m < 1e-6) continue;
      segments_.push_back(
          {line[i - 1], step / length_m, length_m, 0.5 * roads.roads[road].width_m, along_m, static_cast<int>(road)});
      along_m += length_m;
    }
    lengths_m_.push_back(along_m);
  }
}

void KerbField::size_grid() {
  Eigen::Vector2d low = segments_.front().start, high = low;
  for (const Segment& segment : segments_) {
    for (const Eigen::Vector2d& end :
         {segment.start, Eigen::Vector2d(segment.start + segment.length_m * segment.along)}) {
      low = low.cwiseMin(end);
      high = high.cwiseMax(end);
    }
  }
  corner_ = low.array() - kMargin_m;
  const Eigen::Vector2d size = (high - low).array() + 2.0 * kMargin_m;
  columns_ = static_cast<int>(size.x() / kStep_m) + 2;
  rows_ = static_cast<int>(size.y() / kStep_m) + 2;
}

// At a dead end: a segment of zero length.
void KerbField::add_turning_circles(const RoadNetwork& roads) {
  for (const Junction& junction : roads.junctions) {
    if (junction.roads.size() != 1) continue;
    const auto road = static_cast<std::size_t>(junction.roads.front());
    const bool is_start = (roads.roads[road].centre_line.front() - junction.position).norm() < 1e-6;
    segments_.push_back({junction.position, Eigen::Vector2d::UnitX(), 0.0, kTurningCircleRadius_m,
                         is_start ? 0.0 : lengths_m_[road], static_cast<int>(road)});
  }
}

// Closing: for points within the radius of the strips, the distance from the kerb follows from the distance to the line
// at that radius.
void KerbField::round_corners() {
  std::vector<Segment> line;
  march(distance_m_, static_cast<float>(kCornerRadius_m),
        [&](const Crossing&, const Crossing&, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
          const double length_m = (b - a).norm();
          if (length_m > 1e-9) line.push_back({a, (b - a) / length_m, length_m, 0.0, 0.0, 0});
        });
  const std::vector<std::int32_t> nearest_of_line = nearest_segments(line, kCornerRadius_m + 12.0);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t i = index(column, row);
      if (distance_m_[i] >= kCornerRadius_m || nearest_of_line[i] < 0) continue;
      distance_m_[i] = static_cast<float>(
          kCornerRadius_m - line[static_cast<std::size_t>(nearest_of_line[i])].distance_m(node(column, row)));
    }
  }
}

// The nearest segment of each node (-1: none within reach), propagated from node to node: first to the nodes around
// each segment, then in sweeps over the grid.
std::vector<std::int32_t> KerbField::nearest_segments(const std::vector<Segment>& segments, double reach_m) const {
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(columns_) * rows_, -1);
  std::vector<float> distance(nearest.size(), std::numeric_limits<float>::infinity());
  const auto offer = [&](std::int32_t segment, int column, int row) {
    const auto d = static_cast<float>(segments[static_cast<std::size_t>(segment)].distance_m(node(column, row)));
    const std::size_t i = index(column, row);
    if (d < distance[i] && d < reach_m) {
      distance[i] = d;
      nearest[i] = segment;
    }
  };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Eigen::Vector2d a = segments[i].start, b = a + segments[i].length_m * segments[i].along;
    const Eigen::Array2d low = (a.cwiseMin(b) - corner_).array() / kStep_m - 1.0;
    const Eigen::Array2d high = (a.cwiseMax(b) - corner_).array() / kStep_m + 2.0;
    for (int row = std::max(0, static_cast<int>(low.y())); row <= std::min(rows_ - 1, static_cast<int>(high.y()));
         ++row) {
      for (int column = std::max(0, static_cast<int>(low.x()));
           column <= std::min(columns_ - 1, static_cast<int>(high.x())); ++column) {
        offer(static_cast<std::int32_t>(i), column, row);
      }
    }
  }
  const auto take_from = [&](int column, int row, int from_column, int from_row) {
    if (from_column < 0 || from_row < 0 || from_column >= columns_ || from_row >= rows_) return;
    const std::int32_t segment = nearest[index(from_column, from_row)];
    if (segment >= 0 && segment != nearest[index(column, row)]) offer(segment, column, row);
  };
  for (int round = 0; round < 2; ++round) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        for (int i = -1; i <= 1; ++i) take_from(column, row, column + i, row - 1);
        take_from(column, row, column - 1, row);
      }
      for (int column = columns_ - 1; column >= 0; --column) take_from(column, row, column + 1, row);
    }
    for (int row = rows_ - 1; row >= 0; --row) {
      for (int column = columns_ - 1; column >= 0; --column) {
        for (int i = -1; i <= 1; ++i) take_from(column, row, column + i, row + 1);
        take_from(column, row, column + 1, row);
      }
      for (int column = 0; column < columns_; ++column) take_from(column, row, column - 1, row);
    }
  }
  return nearest;
}

// A crossing of the level with a grid edge: the node at the edge's lower end, and whether the edge goes up or right.
struct KerbField::Crossing {
  std::size_t node;
  bool is_upright;
};

// Marching squares: visits the pieces of the level line of `field`, with lower values on the left.
template <typename Visit>
void KerbField::march(const std::vector<float>& field, float level, const Visit& visit) const {
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (int row = 0; row + 1 < rows_; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      std::array<float, 4> value;
      int below = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        value[i] = field[index(column + kCorners[i][0], row + kCorners[i][1])] - level;
        below += value[i] < 0.0f;
      }
      if (below == 0 || below == 4) continue;
      // counter-clockwise on the border, the line runs from a rising crossing to the next falling one
      struct End {
        Crossing crossing;
        Eigen::Vector2d point;
      };
      std::array<End, 2> rising, falling;
      std::size_t rises = 0, falls = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        if ((value[i] < 0.0f) == (value[j] < 0.0f)) continue;
        const bool is_upright = i % 2 == 1;
        const std::size_t first = i < 2 ? i : j, last = i < 2 ? j : i;  // from the lower or left end
        const double share = value[first] / (value[first] - value[last]);
        const Eigen::Vector2d from = node(column + kCorners[first][0], row + kCorners[first][1]);
        const Eigen::Vector2d step = is_upright ? Eigen::Vector2d(0.0, kStep_m) : Eigen::Vector2d(kStep_m, 0.0);
        const End end{{index(column + kCorners[first][0], row + kCorners[first][1]), is_upright}, from + share * step};
        (value[i] < 0.0f ? rising[rises++] : falling[falls++]) = end;
      }
      for (std::size_t i = 0; i < rises; ++i) {
        // two pieces in one square: connect each to the next crossing along the border
        visit(rising[i].crossing, falling[i].crossing, rising[i].point, falling[i].point);
      }
    }
  }
}

double KerbField::distance_m(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d place = (point - corner_) / kStep_m;
  const Eigen::Vector2d inside = place.cwiseMax(0.0).cwiseMin(Eigen::Vector2d(columns_ - 1.001, rows_ - 1.001));
  const int column = static_cast<int>(inside.x()), row = static_cast<int>(inside.y());
  const double x = inside.x() - column, y = inside.y() - row;
  const std::size_t i = index(column, row);
  const double low = (1.0 - x) * distance_m_[i] + x * distance_m_[i + 1];
  const double high = (1.0 - x) * distance_m_[i + columns_] + x * distance_m_[i + columns_ + 1];
  return (1.0 - y) * low + y * high + kStep_m * (place - inside).norm();
}

Eigen::Vector2d KerbField::outwards(const Eigen::Vector2d& point) const {
  constexpr double kReach_m = 0.25;
  const Eigen::Vector2d x(kReach_m, 0.0), y(0.0, kReach_m);
  const Eigen::Vector2d gradient(distance_m(point + x) - distance_m(point - x),
                                 distance_m(point + y) - distance_m(point - y));
  const double length = gradient.norm();
  return length > 1e-9 ? Eigen::Vector2d(gradient / length) : Eigen::Vector2d::UnitX();
}

RoadNetwork::Nearest KerbField::nearest_road(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d inside =
      ((point - corner_) / kStep_m).cwiseMax(0.0).cwiseMin(Eigen::Vector2d(columns_ - 1.001, rows_ - 1.001));
  const std::size_t corner = index(static_cast<int>(inside.x()), static_cast<int>(inside.y()));
  const Segment* best = nullptr;
  double best_m = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::int32_t i) {
    if (i < 0 || i >= static_cast<std::int32_t>(segments_.size())) return;
    const Segment& segment = segments_[static_cast<std::size_t>(i)];
    const double d = segment.distance_to_middle_m(point);
    if (d < best_m) {
      best_m = d;
      best = &segment;
    }
  };
  for (const std::size_t i : {corner, corner + 1, corner + columns_, corner + columns_ + 1}) {
    for (int neighbour = -1; neighbour <= 1; ++neighbour) consider(nearest_[i] + neighbour);
  }
  const Eigen::Vector2d offset = point - best->start;
  const double along_m = std::clamp(offset.dot(best->along), 0.0, best->length_m);
  const double side = best->along.x() * offset.y() - best->along.y() * offset.x();
  return {best_m, best->start_along_m + along_m, side < 0.0 ? -best_m : best_m, best->road};
}

std::vector<std::vector<Eigen::Vector2d>> KerbField::kerb_lines() const {
  // each crossing starts one piece: follow them to closed lines
  const std::size_t nodes = distance_m_.size();
  constexpr auto kNone = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> piece_from(2 * nodes, kNone);
  struct Piece {
    Eigen::Vector2d start;
    std::size_t from, to;
  };
  std::vector<Piece> pieces;
  const auto key = [&](const Crossing& crossing) { return 2 * crossing.node + (crossing.is_upright ? 1 : 0); };
  march(distance_m_, 0.0f,
        [&](const Crossing& from, const Crossing& to, const Eigen::Vector2d& a, const Eigen::Vector2d&) {
          piece_from[key(from)] = static_cast<std::uint32_t>(pieces.size());
          pieces.push_back({a, key(from), key(to)});
        });
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const Piece& first : pieces) {
    if (piece_from[first.from] == kNone) continue;
    std::vector<Eigen::Vector2d>& line = lines.emplace_back();
    std::size_t at = first.from;
    while (piece_from[at] != kNone) {
      const Piece& piece = pieces[piece_from[at]];
      piece_from[at] = kNone;
      line.push_back(piece.start);
      at = piece.to;
    }
  }
  return lines;
}

}  // namespace panvo::simulated_world
