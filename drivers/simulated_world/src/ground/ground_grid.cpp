// SPDX-License-Identifier: Apache-2.0
#include "ground_grid.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace panvo::simulated_world {
namespace {

// A point of the finest lattice. A triangle is halved at the midpoint of its longest edge. A lattice point is the
// midpoint of the longest edge of two triangles; their other corners are its two parents, which must be in use before
// it.
struct Place {
  int x, y;
};
Place middle(Place a, Place b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

class Halving {
 public:
  Halving(int size, const Eigen::Vector2d& centre, double heading_rad, double step_m)
      : size_(size), used_(static_cast<std::size_t>(size + 1) * (size + 1), 0), step_m_(step_m) {
    lattice_to_land_.setIdentity();
    lattice_to_land_.translate(centre)
        .rotate(heading_rad)
        .scale(step_m)
        .translate(Eigen::Vector2d::Constant(-0.5 * size));
  }

  template <typename WantsFiner>
  void mark(Place a, Place b, Place c, const WantsFiner& wants_finer) {
    if (is_finest(a, c)) return;
    const Place m = middle(a, b);
    if (!wants_finer(land(m), step_m_ * std::hypot(a.x - b.x, a.y - b.y))) return;
    use(m);
    mark(c, a, m, wants_finer);
    mark(b, c, m, wants_finer);
  }

  void collect(Place a, Place b, Place c, GroundGrid& grid) {
    if (!is_finest(a, c)) {
      const Place m = middle(a, b);
      if (used_[index(m)]) {
        collect(c, a, m, grid);
        collect(b, c, m, grid);
        return;
      }
    }
    grid.triangles.push_back({number(a, grid), number(b, grid), number(c, grid)});
  }

 private:
  static bool is_finest(Place a, Place c) { return std::abs(a.x - c.x) + std::abs(a.y - c.y) <= 1; }
  std::size_t index(Place p) const { return static_cast<std::size_t>(p.y) * (size_ + 1) + p.x; }
  Eigen::Vector2d land(Place p) const { return lattice_to_land_ * Eigen::Vector2d(p.x, p.y); }

  void use(Place place) {
    std::vector<Place> waiting{place};
    while (!waiting.empty()) {
      const Place p = waiting.back();
      waiting.pop_back();
      if (p.x < 0 || p.y < 0 || p.x > size_ || p.y > size_ || used_[index(p)]) continue;
      const int bits = p.x | p.y;
      const int s = bits & -bits;
      if (s >= size_) continue;  // a corner of the square
      used_[index(p)] = 1;
      if (p.x & s && p.y & s) {
        // the centre of a square: its parents are the corners that are midpoints of edges one size up
        if (2 * s >= size_) continue;
        const bool is_rising = ((p.x - s) / (2 * s) + (p.y - s) / (2 * s)) % 2 == 1;
        const int turn = is_rising ? 1 : -1;
        waiting.push_back({p.x - s, p.y - s * turn});
        waiting.push_back({p.x + s, p.y + s * turn});
      } else if (p.x & s) {
        waiting.push_back({p.x, p.y - s});
        waiting.push_back({p.x, p.y + s});
      } else {
        waiting.push_back({p.x - s, p.y});
        waiting.push_back({p.x + s, p.y});
      }
    }
  }

  std::uint32_t number(Place p, GroundGrid& grid) {
    std::uint32_t& slot =
        numbers_.empty() ? (numbers_.resize(used_.size(), 0), numbers_[index(p)]) : numbers_[index(p)];
    if (slot == 0) {
      grid.points.push_back(land(p));
      slot = static_cast<std::uint32_t>(grid.points.size());
    }
    return slot - 1;
  }

  int size_;
  std::vector<char> used_;
  std::vector<std::uint32_t> numbers_;  // of the points, from 1
  double step_m_;
  Eigen::Affine2d lattice_to_land_;
};

}  // namespace

GroundGrid adaptive_grid(const Eigen::Vector2d& centre, double heading_rad, double finest_m, int levels,
                         const std::function<bool(const Eigen::Vector2d&, double)>& wants_finer) {
  const int size = 1 << levels;
  Halving halving(size, centre, heading_rad, finest_m);
  const Place a{0, 0}, b{size, 0}, c{size, size}, d{0, size};
  halving.mark(c, a, b, wants_finer);
  halving.mark(a, c, d, wants_finer);
  GroundGrid grid;
  halving.collect(c, a, b, grid);
  halving.collect(a, c, d, grid);
  return grid;
}

}  // namespace panvo::simulated_world
