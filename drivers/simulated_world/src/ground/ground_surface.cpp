// SPDX-License-Identifier: Apache-2.0
#include "ground_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "../kerb_field.hpp"
#include "ground_grid.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kStepUp_m = 0.08;  // from the kerb: hidden by the kerb stones
constexpr double kGutter_m = -0.3;
// lines along the carriageway at which the slope of its tint changes
constexpr std::array kCarriagewayLines_m{-3.0, -2.3, -1.6, -0.9, kGutter_m};
constexpr double kStreetNear_m = 8.0;  // upper limit of the width of all streets' bands, from the kerb

// A corner of a piece of ground, with the distances at which pieces are cut.
struct Corner {
  Eigen::Vector2d point;
  double kerb_m, into_street_m, off_crossing_m;
};
using Piece = std::vector<Corner>;

// The orientation of the texture.
struct Chart {
  std::int32_t road = -1;      // along this road
  std::int32_t crossing = -1;  // as this crossing
};

class Surface {
 public:
  Surface(const Site& site, const GroundZones& zones, const GroundPaint& paint)
      : site_(site),
        zones_(zones),
        paint_(paint),
        grass_(site.palette->find("grass")),
        far_land_(site.palette->find("far_land")) {}

  Mesh build() {
    const GroundGrid grid = make_grid();
    corners_.reserve(grid.points.size());
    for (const Eigen::Vector2d& point : grid.points) {
      corners_.push_back({point, site_.kerbs->distance_m(point), 0.0, 0.0});
      if (corners_.back().kerb_m >= kStreetNear_m) continue;
      const GroundZones::Place place = zones_.at(point);
      corners_.back().into_street_m = place.into_street_m;
      corners_.back().off_crossing_m = place.off_crossing_m;
    }
    mesh_.triangles.reserve(2 * grid.triangles.size());
    mesh_.vertices.reserve(grid.points.size());
    numbers_.reserve(2 * grid.points.size());
    for (const auto& triangle : grid.triangles) {
      add({corners_[triangle[0]], corners_[triangle[1]], corners_[triangle[2]]});
    }
    return std::move(mesh_);
  }

 private:
  GroundGrid make_grid() const {
    Eigen::Vector2d low = site_.roads.junctions.front().position, high = low;
    for (const Junction& junction : site_.roads.junctions) {
      low = low.cwiseMin(junction.position);
      high = high.cwiseMax(junction.position);
    }
    // rotated, so that no straight road is aligned with the grid
    return adaptive_grid(0.5 * (low + high), 0.37, 1.0, 10, [this](const Eigen::Vector2d& middle, double edge_m) {
      const double near_m = std::max(0.0, site_.kerbs->distance_m(middle) - 0.5 * edge_m);
      const double max_m = near_m < 3.5 ? 1.5 : near_m < 8.0 ? 3.0 : near_m < 25.0 ? 6.0 : near_m < 90.0 ? 12.0 : 24.0;
      return edge_m > max_m;
    });
  }

  // Cuts the piece where `value` equals `at`; returns the parts below and above.
  std::array<Piece, 2> cut(const Piece& piece, double Corner::*value, double at) const {
    std::array<Piece, 2> parts;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Corner &a = piece[i], &b = piece[(i + 1) % piece.size()];
      const bool a_is_below = a.*value < at, b_is_below = b.*value < at;
      parts[a_is_below ? 0 : 1].push_back(a);
      if (a_is_below == b_is_below) continue;
      Corner crossing = crossing_of(a, b, value, at);
      for (Piece& part : parts) part.push_back(crossing);
    }
    for (Piece& part : parts) {
      if (part.size() < 3) part.clear();
    }
    return parts;
  }

  // The cut point on an edge, identical bit for bit from both sides of the edge.
  Corner crossing_of(const Corner& first, const Corner& second, double Corner::*value, double at) const {
    const bool is_ordered = first.*value < second.*value;
    const Corner &a = is_ordered ? first : second, &b = is_ordered ? second : first;
    double share = (at - a.*value) / (b.*value - a.*value);
    if (value == &Corner::kerb_m) {  // kerbs are curved: refine between the cut and the end beyond it
      const double there = site_.kerbs->distance_m(a.point + share * (b.point - a.point));
      const double better = there < at ? share + (1.0 - share) * (at - there) / (b.kerb_m - there)
                                       : share * (at - a.kerb_m) / (there - a.kerb_m);
      if (std::isfinite(better)) share = std::clamp(better, 0.0, 1.0);
    }
    Corner crossing{a.point + share * (b.point - a.point), a.kerb_m + share * (b.kerb_m - a.kerb_m),
                    a.into_street_m + share * (b.into_street_m - a.into_street_m),
                    a.off_crossing_m + share * (b.off_crossing_m - a.off_crossing_m)};
    crossing.*value = at;
    return crossing;
  }

  void add(const Piece& triangle) {
    const auto [least, most] = std::minmax_element(
        triangle.begin(), triangle.end(), [](const Corner& a, const Corner& b) { return a.kerb_m < b.kerb_m; });
    if (least->kerb_m >= kStreetNear_m) {
      add_land(triangle);
      return;
    }
    const auto [road, beside] = split(triangle, &Corner::kerb_m, kStepUp_m);
    for (const Piece& part : split(road, &Corner::into_street_m, 0.0)) {
      if (!part.empty()) add_carriageway(part);
    }
    for (const Piece& part : split(beside, &Corner::off_crossing_m, 0.0)) {
      if (!part.empty()) add_beside(part);
    }
  }

  void add_land(const Piece& piece) {
    const auto [near, far] = split(piece, &Corner::kerb_m, GroundPaint::kFieldsBegin_m);
    if (!near.empty()) emit_grass(near, false);
    if (!far.empty()) emit_grass(far, true);
  }

  GroundZones::Place place_of(const Piece& piece) const {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Corner& corner : piece) middle += corner.point / static_cast<double>(piece.size());
    return zones_.at(middle);
  }

  void add_carriageway(const Piece& piece) {
    const GroundZones::Place place = place_of(piece);
    const int zone = place.into_street_m < 0.0 ? place.crossing : place.street;
    Piece rest = piece;
    for (const double line_m : kCarriagewayLines_m) {
      const auto [inner, outer] = split(rest, &Corner::kerb_m, line_m);
      if (!inner.empty()) emit_carriageway(inner, place, zone, line_m > kGutter_m);
      rest = outer;
    }
    if (!rest.empty()) emit_carriageway(rest, place, zone, true);
  }

  void add_beside(const Piece& piece) {
    const GroundZones::Place place = place_of(piece);
    const int zone = place.off_crossing_m < 0.0 ? place.crossing : place.street;
    Piece rest = piece;
    for (const Band& band : zones_.zone(zone).beside) {
      const auto [inner, outer] = split(rest, &Corner::kerb_m, band.to_m);
      if (!inner.empty()) emit_beside(inner, place, zone, band);
      rest = outer;
    }
    if (!rest.empty()) emit_grass(rest, false);
  }

  std::array<Piece, 2> split(const Piece& piece, double Corner::*value, double at) const {
    const auto is_below = [&](const Corner& corner) { return corner.*value < at; };
    if (std::all_of(piece.begin(), piece.end(), is_below)) return {piece, {}};
    if (std::none_of(piece.begin(), piece.end(), is_below)) return {Piece{}, piece};
    return cut(piece, value, at);
  }

  Chart chart_of(const GroundZones::Place& place, int zone, bool follows_road) const {
    if (!follows_road) return {};
    return zones_.zone(zone).junction >= 0 ? Chart{-1, zone} : Chart{place.nearest.road, -1};
  }

  Eigen::Vector2f uv(const Eigen::Vector2d& point, const Chart& chart, const RoadNetwork::Nearest& nearest) const {
    if (chart.road >= 0 && nearest.road == chart.road)
      return Eigen::Vector2d(nearest.along_m, nearest.side_m).cast<float>();
    if (chart.crossing >= 0) {
      const Zone& zone = zones_.zone(chart.crossing);
      const Eigen::Vector2d offset = point - zone.origin;
      return Eigen::Vector2d(offset.dot(zone.forward), zone.forward.x() * offset.y() - zone.forward.y() * offset.x())
          .cast<float>();
    }
    return point.cast<float>();
  }

  void emit_carriageway(const Piece& piece, const GroundZones::Place& place, int number, bool is_gutter) {
    const Zone& zone = zones_.zone(number);
    const Chart chart = chart_of(place, number, is_gutter && zone.has_gutter);
    const std::uint16_t material = is_gutter ? zone.gutter : zone.asphalt;
    emit(piece, material, layer(material, chart, number), [&](const Corner& corner) {
      return vertex(corner, 0.0, uv(corner.point, chart, site_.kerbs->nearest_road(corner.point)),
                    paint_.carriageway(corner.point, corner.kerb_m, corner.into_street_m, zone));
    });
  }

  void emit_beside(const Piece& piece, const GroundZones::Place& place, int zone, const Band& band) {
    const Chart chart = chart_of(place, zone, band.follows_road);
    const bool is_grass = band.material == grass_;
    emit(piece, band.material, layer(band.material, chart, is_grass ? -1 : zone), [&](const Corner& corner) {
      return vertex(
          corner, kKerbHeight_m, uv(corner.point, chart, site_.kerbs->nearest_road(corner.point)),
          is_grass ? paint_.grass(corner.point, corner.kerb_m) : paint_.beside(corner.point, corner.kerb_m, band.tint));
    });
  }

  void emit_grass(const Piece& piece, bool is_field) {
    const std::uint16_t material = is_field ? far_land_ : grass_;
    emit(piece, material, layer(material, {}, -1), [&](const Corner& corner) {
      return vertex(corner, kKerbHeight_m, corner.point.cast<float>(),
                    is_field ? paint_.field(corner.point, corner.kerb_m) : paint_.grass(corner.point, corner.kerb_m));
    });
  }

  Vertex vertex(const Corner& corner, double above_m, const Eigen::Vector2f& uv, const Tint& tint) const {
    return {Eigen::Vector3d(corner.point.x(), corner.point.y(), site_.terrain.height_m(corner.point) + above_m)
                .cast<float>(),
            site_.terrain.normal(corner.point).cast<float>(), uv, tint};
  }

  // Triangles of the same layer share vertices.
  static std::uint64_t layer(std::uint16_t material, const Chart& chart, int zone) {
    return mix(mix(mix(material + 1u) + static_cast<std::uint64_t>(chart.road + 1)) +
               (static_cast<std::uint64_t>(chart.crossing + 1) << 20) + static_cast<std::uint64_t>(zone + 1));
  }

  template <typename MakeVertex>
  void emit(const Piece& piece, std::uint16_t material, std::uint64_t layer, const MakeVertex& make_vertex) {
    std::vector<std::uint32_t> numbers;
    for (const Corner& corner : piece) {
      const auto x = static_cast<std::uint64_t>(std::llround(corner.point.x() * 2000.0));
      const auto y = static_cast<std::uint64_t>(std::llround(corner.point.y() * 2000.0));
      const auto [slot, is_new] =
          numbers_.try_emplace(mix(mix(layer + x) + y), static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (is_new) mesh_.vertices.push_back(make_vertex(corner));
      if (numbers.empty() || (numbers.back() != slot->second && numbers.front() != slot->second)) {
        numbers.push_back(slot->second);
      }
    }
    for (std::size_t i = 2; i < numbers.size(); ++i) {
      mesh_.triangles.push_back({{numbers[0], numbers[i - 1], numbers[i]}, material});
    }
  }

  const Site& site_;
  const GroundZones& zones_;
  const GroundPaint& paint_;
  std::uint16_t grass_, far_land_;
  std::vector<Corner> corners_;
  Mesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // only looked up, never iterated
};

}  // namespace

Mesh ground_surface(const Site& site, const GroundZones& zones, const GroundPaint& paint) {
  return Surface(site, zones, paint).build();
}

}  // namespace panvo::simulated_world
