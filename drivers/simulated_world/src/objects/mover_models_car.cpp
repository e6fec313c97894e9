// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../shapes.hpp"
#include "mover_models.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector3f;

float smooth(float from, float to, float x) {
  const float share = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return share * share * (3.0f - 2.0f * share);
}

float mixed(float a, float b, float share) { return a + (b - a) * share; }

/// Builds a car: a lofted lower body and a glasshouse.
class CarBuilder {
 public:
  CarBuilder(const CarShape& shape, const MoverMaterials& materials)
      : shape_(shape), materials_(materials), half_length_(0.5f * shape.length), half_width_(0.5f * shape.width) {}

  Mesh build() {
    add_lower_body();
    add_glasshouse();
    add_underside();
    for (const float x : {shape_.front_wheel, shape_.rear_wheel}) {
      for (const float side : {-1.0f, 1.0f}) add_wheel(x, side);
    }
    add_front();
    add_rear();
    add_sides();
    return std::move(mesh_);
  }

 private:
  /// Rounding of the ends in plan view: 1 in the middle, less towards the ends.
  float plan(float x) const {
    const float front = smooth(half_length_, half_length_ - 0.55f, x),
                rear = smooth(-half_length_, -half_length_ + 0.4f, x);
    return mixed(0.8f, 1.0f, std::pow(front, 0.6f)) * mixed(0.86f, 1.0f, std::pow(rear, 0.6f));
  }

  float half_width(float x) const { return half_width_ * plan(x); }

  float top(float x) const {
    if (x >= shape_.screen_foot) {
      const float share = (half_length_ - x) / std::max(0.1f, half_length_ - shape_.screen_foot);
      return mixed(shape_.nose, shape_.bonnet, std::pow(std::clamp(share, 0.0f, 1.0f), 0.55f));
    }
    if (x <= shape_.rear_foot) {
      const float share = (half_length_ + x) / std::max(0.05f, half_length_ + shape_.rear_foot);
      return mixed(shape_.tail, shape_.boot, std::pow(std::clamp(share, 0.0f, 1.0f), 0.5f));
    }
    return mixed(shape_.boot, shape_.bonnet, (x - shape_.rear_foot) / (shape_.screen_foot - shape_.rear_foot));
  }

  float bottom(float x) const {
    float z = shape_.sill +
              0.1f * (smooth(half_length_ - 0.5f, half_length_, x) + smooth(-half_length_ + 0.5f, -half_length_, x));
    const float arch = shape_.wheel_radius + 0.06f;
    for (const float wheel : {shape_.front_wheel, shape_.rear_wheel}) {
      const float away = std::abs(x - wheel);
      if (away < arch) z = std::max(z, shape_.wheel_radius + std::sqrt(arch * arch - away * away));
    }
    return z;
  }

  /// The cross section at x, from the left sill over the top to the right sill.
  std::vector<Vector3f> section(float x) const {
    const float width = half_width(x), low = bottom(x), high = top(x);
    const float crown = 0.035f * smooth(half_length_ + 0.05f, half_length_ - 0.5f, std::abs(x));
    const float rise = high - low;
    std::vector<Vector3f> left{{x, 0.955f * width, low},
                               {x, 0.985f * width, low + 0.12f * rise},
                               {x, width, low + 0.42f * rise},
                               {x, 0.995f * width, low + 0.68f * rise},
                               {x, 0.965f * width, low + 0.9f * rise},
                               {x, 0.915f * width, low + 0.97f * rise},
                               {x, 0.85f * width, high},
                               {x, 0.55f * width, high + 0.7f * crown}};
    std::vector<Vector3f> points = left;
    points.emplace_back(x, 0.0f, high + crown);
    for (auto point = left.rbegin(); point != left.rend(); ++point)
      points.emplace_back(point->x(), -point->y(), point->z());
    return points;
  }

  std::vector<float> stations() const {
    std::vector<float> places;
    for (const float inset : {0.0f, 0.02f, 0.07f, 0.16f, 0.3f, 0.5f}) {
      places.push_back(half_length_ - inset);
      places.push_back(-half_length_ + inset);
    }
    const float arch = shape_.wheel_radius + 0.06f;
    for (const float wheel : {shape_.front_wheel, shape_.rear_wheel}) {
      for (const float share :
           {-1.02f, -0.995f, -0.92f, -0.75f, -0.5f, -0.2f, 0.2f, 0.5f, 0.75f, 0.92f, 0.995f, 1.02f}) {
        places.push_back(wheel + share * arch);
      }
    }
    places.push_back(shape_.screen_foot);
    places.push_back(shape_.rear_foot);
    for (float x = -half_length_ + 0.8f; x < half_length_ - 0.6f; x += 0.35f) places.push_back(x);
    std::sort(places.begin(), places.end());
    // nearly equal positions would make slivers
    places.erase(std::unique(places.begin(), places.end(), [](float a, float b) { return b - a < 0.006f; }),
                 places.end());
    return places;
  }

  void add_lower_body() {
    std::vector<Vector3f> grid;
    int columns = 0;
    for (const float x : stations()) {
      const auto points = section(x);
      columns = static_cast<int>(points.size());
      grid.insert(grid.end(), points.begin(), points.end());
    }
    add_surface(
        mesh_, grid, columns,
        [&](int column, int) {
          return column == 0 || column == columns - 2 ? materials_.car_trim : materials_.car_paint;
        },
        shape_.body);
    for (const float end : {-1.0f, 1.0f}) {
      auto points = section(end * half_length_);
      if (end > 0.0f) std::reverse(points.begin(), points.end());
      std::vector<Vertex> corners;
      for (const auto& point : points)
        corners.push_back({point, end * Vector3f::UnitX(), {point.y(), point.z()}, shape_.body});
      mesh_.add_polygon(corners, materials_.car_paint);
    }
  }

  // The glasshouse: t runs from the rear to the front, f from the right (-1) to the left (1).
  Vector3f roof_point(float t, float f) const {
    const float width = 0.85f * half_width_ * shape_.lean;
    const float drop = 0.05f * std::pow(std::abs(2.0f * t - 1.05f), 2.5f);
    const float bulge = 0.05f * (1.0f - f * f) * (smooth(0.8f, 1.0f, t) - smooth(0.2f, 0.0f, t));
    return {mixed(shape_.rear_top, shape_.screen_top, t) + bulge, f * width,
            shape_.roof - 0.045f - drop + 0.045f * (1.0f - f * f)};
  }

  Vector3f foot_point(float t, float f) const {
    const float x = mixed(shape_.rear_foot, shape_.screen_foot, t);
    const float bulge = (1.0f - f * f) * (0.16f * smooth(0.9f, 1.0f, t) - 0.08f * smooth(0.1f, 0.0f, t));
    return {x + bulge, f * 0.87f * half_width(x), top(x) - 0.015f};
  }

  Vector3f hull(float t, float f, float height) const {
    const Vector3f foot = foot_point(t, f), crown = roof_point(t, f);
    Vector3f point = foot + height * (crown - foot);
    point += 0.05f * std::sin(kPi * height) * Vector3f(0, f, 0) * 0.6f;
    return point;
  }

  void add_glasshouse() {
    std::vector<float> breaks{0.0f, 0.02f, 0.98f, 1.0f};
    for (const auto& [from, to] : shape_.panes) {
      breaks.push_back(from);
      breaks.push_back(to);
    }
    for (float t = 0.1f; t < 0.95f; t += 0.1f) breaks.push_back(t);
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end(), [](float a, float b) { return b - a < 0.004f; }),
                 breaks.end());
    const float heights[] = {0.0f, 0.09f, 0.5f, 0.86f, 0.97f, 1.0f};
    std::vector<Vector3f> grid;
    for (const float t : breaks) {
      for (const float height : heights) grid.push_back(hull(t, 1.0f, height));
      for (const float f : {0.9f, 0.5f, 0.0f, -0.5f, -0.9f}) grid.push_back(roof_point(t, f));
      for (auto height = std::rbegin(heights); height != std::rend(heights); ++height)
        grid.push_back(hull(t, -1.0f, *height));
    }
    const auto in_pane = [&](float t) {
      return std::any_of(shape_.panes.begin(), shape_.panes.end(),
                         [&](const auto& pane) { return t > pane.first && t < pane.second; });
    };
    const int columns = 17;
    add_surface(
        mesh_, grid, columns,
        [&](int column, int row) {
          const int from_edge = std::min(column, columns - 2 - column);
          const bool is_glass_height = from_edge == 1 || from_edge == 2;
          const auto index = static_cast<std::size_t>(row);
          return is_glass_height && in_pane(0.5f * (breaks[index] + breaks[index + 1])) ? materials_.car_glass
                                                                                        : materials_.car_paint;
        },
        shape_.body);
    add_screen(1.0f, true);
    add_screen(0.0f, shape_.has_rear_window);
  }

  void add_screen(float t, bool is_glass) {
    const float across[] = {-1.0f, -0.93f, -0.6f, -0.2f, 0.2f, 0.6f, 0.93f, 1.0f};
    const float heights[] = {0.0f, 0.06f, 0.5f, 0.92f, 1.0f};
    std::vector<Vector3f> grid;
    for (const float height : heights) {
      for (const float f : across) grid.push_back(hull(t, t > 0.5f ? f : -f, height));
    }
    add_surface(
        mesh_, grid, 8,
        [&](int column, int row) {
          const bool is_edge = column == 0 || column == 6 || row == 3;
          if (row == 0) return materials_.car_trim;
          return is_edge || !is_glass ? materials_.car_paint : materials_.car_glass;
        },
        shape_.body);
  }

  void add_underside() {
    const float inside = half_width_ - 0.28f;
    add_block(mesh_, {-half_length_ + 0.25f, -inside, shape_.sill - 0.04f},
              {half_length_ - 0.25f, inside, shape_.sill + 0.3f}, materials_.car_trim, grey(0.5f));
    add_block(mesh_, {-half_length_ + 0.3f, -half_width_ + 0.08f, shape_.sill - 0.02f},
              {half_length_ - 0.3f, half_width_ - 0.08f, shape_.sill + 0.02f}, materials_.car_trim, grey(0.4f));
  }

  void add_wheel(float x, float side) {
    const float radius = shape_.wheel_radius, width = 0.2f;
    const float outer = side * (half_width_ - 0.025f), inner = side * (half_width_ - 0.025f - width);
    const Vector3f hub(x, outer, radius), back(x, inner, radius);
    const int sides = 20;
    const Vector3f rows[] = {back, back + Vector3f(0, side * 0.02f, 0), hub - Vector3f(0, side * 0.025f, 0), hub, hub};
    const float radii[] = {0.93f * radius, radius, radius, 0.94f * radius, 0.66f * radius};
    std::vector<Vector3f> grid;
    for (int row = 0; row < 5; ++row) {
      for (int i = 0; i <= sides; ++i) {
        const float angle = side * 2.0f * kPi * static_cast<float>(i) / sides;
        grid.push_back(rows[row] + radii[row] * Vector3f(std::sin(angle), 0, std::cos(angle)));
      }
    }
    add_surface(mesh_, grid, sides + 1, [&](int, int) { return materials_.tyre; });
    // spokes: light and dark wedges, the dark ones deeper
    for (int i = 0; i < 20; ++i) {
      const bool is_spoke = i % 4 < 2;
      const float depth = is_spoke ? 0.01f : 0.05f;
      const auto at = [&](float share, float wedge) {
        const float angle = side * 2.0f * kPi * wedge / 20.0f;
        return Vector3f(x + share * radius * std::sin(angle), outer - side * depth,
                        radius + share * radius * std::cos(angle));
      };
      const auto wedge = static_cast<float>(i);
      const Tint tint = is_spoke ? grey(0.95f) : grey(0.16f);
      mesh_.add_quad(at(0.1f, wedge), at(0.1f, wedge + 1.0f), at(0.58f, wedge + 1.0f), at(0.58f, wedge), materials_.rim,
                     {0, 0}, tint);
      mesh_.add_quad(at(0.58f, wedge), at(0.58f, wedge + 1.0f), at(0.68f, wedge + 1.0f), at(0.68f, wedge),
                     materials_.rim, {0, 0}, grey(0.85f));
    }
    const Vector3f cap = hub - Vector3f(0, side * 0.005f, 0);
    add_ellipsoid(mesh_, cap, {0.12f * radius, 0.02f, 0.12f * radius}, 10, 4, materials_.rim, grey(0.8f));
  }

  void add_front() {
    const float x = half_length_;
    const float width = half_width(x);
    const float low = bottom(x), high = top(x), rise = high - low;
    // grille, intake, plate, wrap-around lamps
    add_block(mesh_, {x - 0.05f, -0.5f * width, low + 0.66f * rise}, {x + 0.012f, 0.5f * width, low + 0.88f * rise},
              materials_.car_trim, grey(0.55f));
    add_block(mesh_, {x - 0.05f, -0.03f, low + 0.7f * rise}, {x + 0.025f, 0.03f, low + 0.84f * rise}, materials_.rim,
              grey(0.9f));
    add_block(mesh_, {x - 0.05f, -0.72f * width, low + 0.08f * rise}, {x + 0.01f, 0.72f * width, low + 0.28f * rise},
              materials_.car_trim, grey(0.45f));
    add_block(mesh_, {x - 0.02f, -0.26f, low + 0.36f * rise}, {x + 0.025f, 0.26f, low + 0.36f * rise + 0.11f},
              materials_.plate, grey(1.0f));
    for (const float side : {-1.0f, 1.0f}) {
      const Vector3f lamp(x - 0.09f, side * 0.8f * width, low + 0.79f * rise);
      add_ellipsoid(mesh_, lamp, {0.14f, 0.17f, 0.085f}, 12, 6, materials_.lamp_head, grey(0.95f));
      add_ellipsoid(mesh_, lamp - Vector3f(0.06f, -side * 0.1f, -0.005f), {0.15f, 0.1f, 0.07f}, 10, 6,
                    materials_.lamp_head, tint_of(0.9f, 0.7f, 0.5f));
    }
  }

  void add_rear() {
    const float x = -half_length_;
    const float width = half_width(x);
    const float low = bottom(x), high = top(x), rise = high - low;
    for (const float side : {-1.0f, 1.0f}) {
      // a tall wrap-around lamp
      const Vector3f lamp(x + 0.1f, side * 0.93f * width, low + 0.74f * rise);
      add_block(mesh_, lamp - Vector3f(0.115f, 0.075f, 0.17f * rise), lamp + Vector3f(0.12f, 0.075f, 0.17f * rise),
                materials_.lamp_rear, grey(1.0f));
      add_block(mesh_, lamp - Vector3f(0.118f, 0.06f, 0.04f * rise), lamp + Vector3f(0.12f, 0.06f, 0.03f * rise),
                materials_.lamp_head, tint_of(0.9f, 0.75f, 0.7f));
    }
    add_block(mesh_, {x - 0.02f, -0.26f, low + 0.55f * rise}, {x + 0.02f, 0.26f, low + 0.55f * rise + 0.11f},
              materials_.plate, grey(1.0f));
    add_block(mesh_, {x - 0.012f, -0.9f * width, low}, {x + 0.1f, 0.9f * width, low + 0.22f * rise},
              materials_.car_trim, grey(0.6f));
    const auto seam = [&](float z) {
      add_tube(mesh_, {x - 0.001f, -0.7f * width, z}, {x - 0.001f, 0.7f * width, z}, 0.008f, 0.008f, 4,
               materials_.car_trim, grey(0.4f));
    };
    seam(low + 0.36f * rise);
    seam(low + 0.9f * rise);
  }

  /// Door seams, handles, mirrors.
  void add_sides() {
    const auto glass_x = [&](float t) { return mixed(shape_.rear_foot, shape_.screen_foot, t); };
    for (const float side : {-1.0f, 1.0f}) {
      for (const auto& [from, to] : shape_.panes) {
        for (const float t : {from, to}) {
          const float x = glass_x(t);
          if (bottom(x) > shape_.sill + 0.05f) continue;  // at a wheel arch
          std::vector<Vector3f> points;
          std::vector<float> radii;
          const auto profile = section(x);
          for (std::size_t i = 0; i < 6; ++i) {
            points.emplace_back(profile[i].x(), side * (profile[i].y() + 0.0005f), profile[i].z());
            radii.push_back(0.0045f);
          }
          add_bent_tube(mesh_, points, radii, 4, materials_.car_trim, grey(0.4f));
        }
        if (to - from > 0.2f) {
          const float x = glass_x(from) + 0.16f;
          const auto profile = section(x);
          add_block(mesh_, {x - 0.09f, side * profile[4].y() - 0.02f, profile[4].z() - 0.075f},
                    {x + 0.09f, side * profile[4].y() + 0.025f, profile[4].z() - 0.045f}, materials_.car_paint,
                    shape_.body);
        }
      }
      const Vector3f mirror = hull(0.94f, side, 0.2f) + Vector3f(0.02f, side * 0.13f, 0.0f);
      add_ellipsoid(mesh_, mirror, {0.09f, 0.13f, 0.085f}, 10, 6, materials_.car_paint, shape_.body);
      add_ellipsoid(mesh_, mirror - Vector3f(0.02f, 0, 0), {0.075f, 0.115f, 0.07f}, 8, 5, materials_.car_glass,
                    grey(1.0f));
    }
  }

  const CarShape& shape_;
  const MoverMaterials& materials_;
  float half_length_, half_width_;
  Mesh mesh_;
};

}  // namespace

Mesh build_car(const CarShape& shape, const MoverMaterials& materials) { return CarBuilder(shape, materials).build(); }

}  // namespace panvo::simulated_world
