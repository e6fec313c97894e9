// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "../shapes.hpp"
#include "buildings.hpp"

namespace panvo::simulated_world {
namespace {

/// Builds a roof in coordinates of its ridge: a along it, b perpendicular to it, both from the centre.
class RoofBuilder {
 public:
  RoofBuilder(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random random, Mesh& mesh)
      : style_(style), materials_(materials), body_(body), random_(random), mesh_(mesh), top_(wall_height(style)) {
    const bool is_across = style.roof == RoofKind::kHip ? body.depth > body.width : body.ridge_across;
    const Eigen::Vector3f x = body.world_from_body.linear().col(0), y = body.world_from_body.linear().col(1);
    along_ = is_across ? y : x;
    beside_ = is_across ? Eigen::Vector3f(-x) : y;
    half_length_ = 0.5f * (is_across ? body.depth : body.width);
    half_span_ = 0.5f * (is_across ? body.width : body.depth);
    ridge_ = top_ + style.roof_slope * half_span_;
  }

  void build() {
    switch (style_.roof) {
      case RoofKind::kFlat:
        add_flat();
        break;
      case RoofKind::kGable:
        add_gable();
        break;
      case RoofKind::kHip:
        add_hip();
        break;
    }
    if (style_.roof == RoofKind::kFlat) return;
    if (style_.chimneys) add_chimneys();
    for (const float side : {-1.0f, 1.0f}) {
      if (style_.dormers) add_dormers(side);
      const float b = side * (half_span_ + style_.eaves);
      const float z = top_ - style_.roof_slope * style_.eaves;
      if (style_.gutters) {
        add_tube(mesh_, at(-half_length_, b, z - 0.04f), at(half_length_, b, z - 0.04f), 0.07f, 0.07f, 6,
                 materials_.gutter, grey(0.75f));
      }
    }
  }

 private:
  Eigen::Vector3f at(float a, float b, float z) const {
    return body_.world_from_body.translation() + a * along_ + b * beside_ + Eigen::Vector3f(0, 0, z);
  }

  void slope_strip(float a0, float a1, float low_b, float low_z, float high_b, float high_z, float top0, float top1) {
    // from the eaves between a0 and a1 up to the ridge between top0 and top1, facing outwards
    const float side = low_b < 0.0f ? 1.0f : -1.0f;
    const Eigen::Vector3f low0 = at(side * a0, low_b, low_z), low1 = at(side * a1, low_b, low_z);
    const Eigen::Vector3f high0 = at(side * top0, high_b, high_z), high1 = at(side * top1, high_b, high_z);
    const Eigen::Vector3f normal = (low1 - low0).cross(high0 + high1 - low0 - low1).normalized();
    const float length = std::hypot(high_b - low_b, high_z - low_z);
    const auto vertex = [&](const Eigen::Vector3f& position, float u, float v) {
      return Vertex{position, normal, {u, v}, style_.roof_tint};
    };
    std::vector<Vertex> corners{vertex(low0, a0, 0), vertex(low1, a1, 0), vertex(high1, top1, length)};
    if (std::abs(top1 - top0) > 1e-3f) corners.push_back(vertex(high0, top0, length));
    mesh_.add_polygon(corners, style_.roof_cover);
  }

  void add_gable() {
    const float over = 0.3f;
    const float reach = half_length_ + over;
    const int parts = std::max(2, static_cast<int>(2.0f * half_length_ / 4.0f));
    const float eaves_b = half_span_ + style_.eaves, eaves_z = top_ - style_.roof_slope * style_.eaves;
    for (const float side : {-1.0f, 1.0f}) {
      for (int part = 0; part < parts; ++part) {
        const float a0 = reach * (2.0f * static_cast<float>(part) / static_cast<float>(parts) - 1.0f);
        const float a1 = reach * (2.0f * static_cast<float>(part + 1) / static_cast<float>(parts) - 1.0f);
        slope_strip(a0, a1, side * eaves_b, eaves_z, 0.0f, ridge_, a0, a1);
      }
      add_fascia(side, reach, eaves_b, eaves_z);
      add_gable_wall(side);
      add_barge(side, reach, eaves_b, eaves_z);
    }
    add_tube(mesh_, at(-reach, 0, ridge_), at(reach, 0, ridge_), 0.1f, 0.1f, 6, style_.roof_cover,
             shaded(style_.roof_tint, 0.8f), true);
  }

  /// The board below the edge of the eaves, and the soffit behind it.
  void add_fascia(float side, float reach, float b, float z) {
    const Tint tint = shaded(style_.trim_tint, 0.9f);
    const float left = -side * reach;
    mesh_.add_quad(at(-left, side * b, z - 0.16f), at(left, side * b, z - 0.16f), at(left, side * b, z),
                   at(-left, side * b, z), materials_.window_frame, Eigen::Vector2f::Zero(), tint);
    mesh_.add_quad(at(-left, side * b, z - 0.16f), at(-left, side * half_span_, z - 0.16f),
                   at(left, side * half_span_, z - 0.16f), at(left, side * b, z - 0.16f), materials_.wood_planks,
                   Eigen::Vector2f::Zero(), shaded(tint, 0.7f));
  }

  void add_gable_wall(float side) {
    const float a = side * half_length_;
    const Eigen::Vector3f normal = side * along_;
    const auto vertex = [&](float b, float z) {
      return Vertex{at(a, b, z), normal, {b, z}, shaded(style_.wall_tint, 0.97f)};
    };
    // in two halves, counter-clockwise from outside
    const float left = side * half_span_;
    mesh_.add_polygon({vertex(-left, top_), vertex(0, top_), vertex(0, ridge_)}, style_.wall);
    mesh_.add_polygon({vertex(0, top_), vertex(left, top_), vertex(0, ridge_)}, style_.wall);
    if (ridge_ - top_ < 2.6f || style_.use == BuildingUse::kHall) return;
    WallFrame frame;  // slightly in front of the wall, so that the window's glass is visible
    frame.outwards = normal;
    frame.right = side * beside_;
    frame.origin = at(a, 0, top_) + (style_.recess - 0.02f) * normal;
    const float half = 0.45f * style_.window_width;
    const Opening opening{-half, half, 0.5f, 0.5f + std::min(1.3f, 0.4f * (ridge_ - top_)), 0.0f};
    build_window(style_, materials_, frame, opening, true, random_, mesh_);
    frame.origin = at(a, 0, top_);
    add_wall_box(mesh_, frame, -half - 0.12f, half + 0.12f, 0.38f, 0.5f, 0.0f, 0.08f, style_.trim, style_.trim_tint);
    add_wall_box(mesh_, frame, -half - 0.12f, half + 0.12f, opening.top, opening.top + 0.14f, 0.0f, 0.07f, style_.trim,
                 style_.trim_tint);
    for (const float u : {-half - 0.12f, half}) {
      add_wall_box(mesh_, frame, u, u + 0.12f, 0.5f, opening.top, 0.0f, 0.06f, style_.trim, style_.trim_tint);
    }
  }

  /// The boards along the gable's sloping edges.
  void add_barge(float side, float reach, float b, float z) {
    const Eigen::Vector3f drop(0, 0, -0.2f);
    const Eigen::Vector3f ridge = at(side * reach, 0, ridge_);
    for (const float end : {-1.0f, 1.0f}) {
      const Eigen::Vector3f foot = at(side * reach, end * b, z);
      const bool is_left = end * side < 0.0f;
      const Eigen::Vector3f first = is_left ? foot : ridge, second = is_left ? ridge : foot;
      mesh_.add_quad(first + drop, second + drop, second, first, materials_.window_frame, Eigen::Vector2f::Zero(),
                     style_.trim_tint);
      const Eigen::Vector3f inwards = -side * (reach - half_length_) * along_;
      mesh_.add_quad(first + drop, first + drop + inwards, second + drop + inwards, second + drop,
                     materials_.wood_planks, Eigen::Vector2f::Zero(), shaded(style_.trim_tint, 0.7f));
    }
  }

  void add_hip() {
    const float eaves = style_.eaves;
    const float z = top_ - style_.roof_slope * eaves;
    const float ridge_half = std::max(0.0f, half_length_ - half_span_);
    const float reach = half_length_ + eaves, b = half_span_ + eaves;
    for (const float side : {-1.0f, 1.0f}) {
      slope_strip(-reach, 0.0f, side * b, z, 0.0f, ridge_, -ridge_half, 0.0f);
      slope_strip(0.0f, reach, side * b, z, 0.0f, ridge_, 0.0f, ridge_half);
      add_fascia(side, reach, b, z);
      const Eigen::Vector3f left = at(side * reach, -side * b, z), right = at(side * reach, side * b, z);
      const Eigen::Vector3f crown = at(side * ridge_half, 0, ridge_);
      const Eigen::Vector3f normal = (right - left).cross(crown - left).normalized();
      mesh_.add_polygon({{left, normal, {0, 0}, style_.roof_tint},
                         {right, normal, {2.0f * b, 0}, style_.roof_tint},
                         {crown, normal, {b, (crown - 0.5f * (left + right)).norm()}, style_.roof_tint}},
                        style_.roof_cover);
      const Eigen::Vector3f drop(0, 0, -0.16f);
      mesh_.add_quad(left + drop, right + drop, right, left, materials_.window_frame, Eigen::Vector2f::Zero(),
                     style_.trim_tint);
      const Eigen::Vector3f inwards = -side * eaves * along_;
      mesh_.add_quad(left + drop, left + drop + inwards, right + drop + inwards, right + drop, materials_.wood_planks,
                     Eigen::Vector2f::Zero(), shaded(style_.trim_tint, 0.7f));
      for (const float end : {-1.0f, 1.0f}) {  // hips
        add_tube(mesh_, at(side * reach, end * b, z), crown, 0.08f, 0.08f, 5, style_.roof_cover,
                 shaded(style_.roof_tint, 0.8f));
      }
    }
    if (ridge_half > 0.1f) {
      add_tube(mesh_, at(-ridge_half, 0, ridge_), at(ridge_half, 0, ridge_), 0.1f, 0.1f, 6, style_.roof_cover,
               shaded(style_.roof_tint, 0.8f));
    }
  }

  void add_flat() {
    const float z = top_ - 0.5f;
    const float a = half_length_ - 0.3f, b = half_span_ - 0.3f;
    const int parts = std::max(1, static_cast<int>(half_length_ / 3.0f));
    for (int part = 0; part < parts; ++part) {
      const float a0 = a * (2.0f * static_cast<float>(part) / static_cast<float>(parts) - 1.0f);
      const float a1 = a * (2.0f * static_cast<float>(part + 1) / static_cast<float>(parts) - 1.0f);
      mesh_.add_quad(at(a0, -b, z), at(a1, -b, z), at(a1, b, z), at(a0, b, z), style_.roof_cover, {a0, 0.0f},
                     style_.roof_tint);
    }
    for (int side = 0; side < 4; ++side) {  // the parapet's coping and inner face
      WallFrame wall = body_.wall(side);
      add_wall_box(mesh_, wall, -0.04f, wall.width + 0.04f, top_ - 0.02f, top_ + 0.06f, -0.3f, 0.05f, materials_.gutter,
                   grey(0.8f));
      mesh_.add_quad(wall.at(wall.width, -0.3f, z), wall.at(0, -0.3f, z), wall.at(0, -0.3f, top_),
                     wall.at(wall.width, -0.3f, top_), style_.wall, Eigen::Vector2f::Zero(),
                     shaded(style_.wall_tint, 0.8f));
    }
    const int boxes = 1 + random_.below(4);
    for (int i = 0; i < boxes; ++i) {
      Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
      frame.linear() << along_, beside_, Eigen::Vector3f::UnitZ();
      const float height = static_cast<float>(random_.uniform(0.8, 2.6));
      const Eigen::Vector3f size(static_cast<float>(random_.uniform(1.2, 4.0)),
                                 static_cast<float>(random_.uniform(1.2, 3.0)), height);
      frame.translation() = at(a * static_cast<float>(random_.uniform(-0.7, 0.7)),
                               b * static_cast<float>(random_.uniform(-0.4, 0.4)), z + 0.5f * height);
      mesh_.add_box(frame, size, random_.chance(0.5) ? materials_.metal_sheet : materials_.concrete_panels, grey(0.9f));
    }
    for (int i = random_.below(5); i > 0; --i) {
      add_tube(
          mesh_,
          at(a * static_cast<float>(random_.uniform(-0.9, 0.9)), b * static_cast<float>(random_.uniform(-0.8, 0.8)), z),
          at(a * static_cast<float>(random_.uniform(-0.9, 0.9)), 0, z), 0.08f, 0.08f, 5, materials_.metal_post);
    }
  }

  void add_chimneys() {
    const int count = 1 + random_.below(half_length_ > 7.0f ? 3 : 2);
    const float reach = style_.roof == RoofKind::kHip ? std::max(0.5f, half_length_ - half_span_) : half_length_ - 1.0f;
    for (int i = 0; i < count; ++i) {
      const float a = reach * static_cast<float>(random_.uniform(-0.9, 0.9));
      const float b = half_span_ * static_cast<float>(random_.uniform(-0.25, 0.25));
      const float high = ridge_ + static_cast<float>(random_.uniform(0.6, 1.3));
      const float low = ridge_ - style_.roof_slope * 0.5f * half_span_;
      Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
      frame.linear() << along_, beside_, Eigen::Vector3f::UnitZ();
      const float width = static_cast<float>(random_.uniform(0.5, 1.1));
      frame.translation() = at(a, b, 0.5f * (low + high));
      mesh_.add_box(frame, {width, 0.55f, high - low}, materials_.brick_red, grey(0.75f));
      frame.translation() = at(a, b, high + 0.05f);
      mesh_.add_box(frame, {width + 0.12f, 0.67f, 0.1f}, materials_.ledge, grey(0.8f));
      for (int pot = 0; pot < 2; ++pot) {
        const Eigen::Vector3f foot = at(a + (static_cast<float>(pot) - 0.5f) * 0.5f * width, b, high + 0.1f);
        mesh_.add_column(foot, 0.12f, 0.1f, 0.35f, 6, style_.roof_cover, grey(0.7f));
      }
    }
  }

  void add_dormers(float side) {
    const float reach = style_.roof == RoofKind::kHip ? half_length_ - half_span_ - 0.3f : half_length_ - 1.2f;
    if (reach < 1.0f || ridge_ - top_ < 2.4f) return;
    const int count = std::max(1, static_cast<int>(2.0f * reach / std::max(3.0f, style_.bay)));
    for (int i = 0; i < count; ++i) {
      const float a = reach * (2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 1.0f);
      add_dormer(side, a);
    }
  }

  void add_dormer(float side, float a) {
    WallFrame frame;  // at the dormer's front: out = 0 there, z = 0 at the roof's surface
    frame.outwards = side * beside_;
    frame.right = -side * along_;
    const float front = 0.72f * half_span_;
    frame.origin = at(a, side * front, top_ + style_.roof_slope * (half_span_ - front));
    const float half = 0.75f, height = std::min(1.35f, 0.55f * (ridge_ - top_)), gable = 0.5f;
    const float slope = style_.roof_slope;
    const auto vertex = [&](float u, float out, float z, const Eigen::Vector3f& normal, Tint tint) {
      return Vertex{frame.at(u, out, z), normal, {u - out, z}, tint};
    };
    const Tint wall = style_.wall_tint;
    mesh_.add_polygon(
        {vertex(-half, 0, -0.2f, frame.outwards, wall), vertex(half, 0, -0.2f, frame.outwards, wall),
         vertex(half, 0, height, frame.outwards, wall), vertex(0, 0, height + gable, frame.outwards, wall),
         vertex(-half, 0, height, frame.outwards, wall)},
        style_.wall);
    const float back = -height / slope, ridge_back = -(height + gable) / slope;
    for (const float end : {-1.0f, 1.0f}) {
      const Eigen::Vector3f out = end * frame.right;
      mesh_.add_polygon({vertex(end * half, 0, 0, out, wall), vertex(end * half, back, height, out, wall),
                         vertex(end * half, 0, height, out, wall)},
                        style_.roof_cover);
      const float over = 0.12f, eave_z = height - 0.08f;
      const Eigen::Vector3f a0 = frame.at(end * (half + over), 0.15f, eave_z),
                            a1 = frame.at(end * (half + over), back, eave_z);
      const Eigen::Vector3f r0 = frame.at(0, 0.15f, height + gable), r1 = frame.at(0, ridge_back, height + gable);
      if (end > 0.0f) {
        mesh_.add_quad(a0, a1, r1, r0, style_.roof_cover, Eigen::Vector2f::Zero(), style_.roof_tint);
      } else {
        mesh_.add_quad(a1, a0, r0, r1, style_.roof_cover, Eigen::Vector2f::Zero(), style_.roof_tint);
      }
    }
    WallFrame proud = frame;
    proud.origin += (style_.recess - 0.02f) * frame.outwards;
    build_window(style_, materials_, proud, {-0.5f, 0.5f, 0.12f, height - 0.05f, 0.0f}, true, random_, mesh_);
    add_wall_box(mesh_, frame, -half - 0.05f, half + 0.05f, 0.0f, 0.12f, 0.0f, 0.1f, style_.trim, style_.trim_tint);
  }

  const FacadeStyle& style_;
  const BuildingMaterials& materials_;
  const Body& body_;
  Random random_;
  Mesh& mesh_;
  float top_, ridge_ = 0.0f;
  Eigen::Vector3f along_, beside_;
  float half_length_ = 0.0f, half_span_ = 0.0f;
};

}  // namespace

void build_roof(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random random,
                Mesh& mesh) {
  RoofBuilder(style, materials, body, random, mesh).build();
}

}  // namespace panvo::simulated_world
