// SPDX-License-Identifier: Apache-2.0
#include "traced_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "ambient_occlusion.hpp"

namespace panvo::simulated_world {
namespace {

std::uint32_t pack_tint(const Tint& tint) {
  return tint.red | static_cast<std::uint32_t>(tint.green) << 8 | static_cast<std::uint32_t>(tint.blue) << 16 |
         static_cast<std::uint32_t>(tint.contrast) << 24;
}

/// The upper half of a float, rounded.
std::uint32_t bfloat16(float value) { return (std::bit_cast<std::uint32_t>(value) + 0x8000u) >> 16; }

SurfaceRecord surface_record(const Mesh& mesh, const Triangle& triangle) {
  const auto& first = mesh.vertices.at(triangle.corners[0]);
  const auto& second = mesh.vertices.at(triangle.corners[1]);
  const auto& third = mesh.vertices.at(triangle.corners[2]);
  SurfaceRecord record;
  record.normals = {pack_normal(first.normal), pack_normal(second.normal), pack_normal(third.normal)};
  const Eigen::Vector2f to_second = second.uv - first.uv;
  const Eigen::Vector2f to_third = third.uv - first.uv;
  record.uv = {first.uv.x(), first.uv.y(), to_second.x(), to_second.y(), to_third.x(), to_third.y()};
  record.tints = {pack_tint(first.tint), pack_tint(second.tint), pack_tint(third.tint)};
  record.material_light = triangle.material | 0xffffff00u;
  // gradients of the barycentric coordinates: perpendicular to the opposite edge, in the triangle's plane
  const Eigen::Vector3f edge1 = second.position - first.position;
  const Eigen::Vector3f edge2 = third.position - first.position;
  const Eigen::Vector3f normal = edge1.cross(edge2);
  const float square = std::max(normal.squaredNorm(), 1e-20f);
  const Eigen::Vector3f of_second = edge2.cross(normal) / square;
  const Eigen::Vector3f of_third = normal.cross(edge1) / square;
  const Eigen::Vector3f u = to_second.x() * of_second + to_third.x() * of_third;
  const Eigen::Vector3f v = to_second.y() * of_second + to_third.y() * of_third;
  record.gradients = {bfloat16(u.x()) | bfloat16(u.y()) << 16, bfloat16(u.z()) | bfloat16(v.x()) << 16,
                      bfloat16(v.y()) | bfloat16(v.z()) << 16};
  return record;
}

/// Whether the corners a, b, c, d of a surface form a parallelogram with linearly varying attributes.
bool is_even(const Mesh& mesh, const std::array<std::uint32_t, 4>& corners, bool has_holes) {
  const auto& a = mesh.vertices[corners[0]];
  const auto& b = mesh.vertices[corners[1]];
  const auto& c = mesh.vertices[corners[2]];
  const auto& d = mesh.vertices[corners[3]];
  const Eigen::Vector3f gap = a.position - b.position + c.position - d.position;
  if (gap.norm() > 1e-3f * (c.position - a.position).norm()) return false;
  if ((a.uv - b.uv + c.uv - d.uv).norm() > 1e-3f * (c.uv - a.uv).norm()) return false;
  if (has_holes) return true;  // the lighting of single leaves is not visible
  if ((a.normal - b.normal + c.normal - d.normal).norm() > 0.05f) return false;
  const auto differs = [](int p, int q, int r, int s) { return std::abs(p - q + r - s) > 3; };
  return !differs(a.tint.red, b.tint.red, c.tint.red, d.tint.red) &&
         !differs(a.tint.green, b.tint.green, c.tint.green, d.tint.green) &&
         !differs(a.tint.blue, b.tint.blue, c.tint.blue, d.tint.blue) &&
         !differs(a.tint.contrast, b.tint.contrast, c.tint.contrast, d.tint.contrast);
}

std::array<float, 12> triangle_array(const Eigen::Affine3f& transform) {
  std::array<float, 12> values{};
  Eigen::Map<Eigen::Matrix<float, 3, 4>>(values.data()) = transform.affine();
  return values;
}

}  // namespace

std::uint32_t pack_normal(const Eigen::Vector3f& normal) {
  const float sum = normal.cwiseAbs().sum();
  Eigen::Vector2f folded = normal.head<2>() / std::max(sum, 1e-20f);
  if (normal.z() < 0.0f) {
    folded = {(1.0f - std::abs(folded.y())) * (folded.x() >= 0.0f ? 1.0f : -1.0f),
              (1.0f - std::abs(folded.x())) * (folded.y() >= 0.0f ? 1.0f : -1.0f)};
  }
  const auto pack = [](float value) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 32767.0f))) & 0xffffu;
  };
  return pack(folded.x()) | pack(folded.y()) << 16;
}

Eigen::Vector3f unpack_normal(std::uint32_t packed) {
  const float x = static_cast<float>(static_cast<std::int16_t>(packed & 0xffffu)) / 32767.0f;
  const float y = static_cast<float>(static_cast<std::int16_t>(packed >> 16)) / 32767.0f;
  Eigen::Vector3f normal(x, y, 1.0f - std::abs(x) - std::abs(y));
  const float over = std::max(-normal.z(), 0.0f);
  normal.x() += normal.x() >= 0.0f ? -over : over;
  normal.y() += normal.y() >= 0.0f ? -over : over;
  return normal.normalized();
}

struct TracedScene::Part {
  const Mesh* mesh = nullptr;
  std::vector<Eigen::Vector3f> positions;             // with an extra one at the end: Embree reads 16 bytes at each
  std::vector<std::array<std::uint32_t, 4>> corners;  // of parallelograms; a triangle repeats its last corner
  std::vector<std::uint16_t> of_material;
  const std::vector<SurfaceRecord>* surfaces = nullptr;
  const ShadingMaterials* materials = nullptr;
  std::uint32_t first_surface = 0;
  bool has_holes = false;

  /// Embree filter that removes hits in holes.
  static void let_through_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& part = *static_cast<const Part*>(arguments->geometryUserPtr);
    const float spread = reinterpret_cast<const TraceContext*>(arguments->context)->spread;
    for (unsigned i = 0; i < arguments->N; ++i) {
      if (arguments->valid[i] == 0) continue;
      const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
      const float second = RTCHitN_u(arguments->hit, arguments->N, i);
      const float third = RTCHitN_v(arguments->hit, arguments->N, i);
      const auto& surface = (*part.surfaces)[part.first_surface + triangle];
      const Eigen::Vector2f uv(surface.uv[0] + second * surface.uv[2] + third * surface.uv[4],
                               surface.uv[1] + second * surface.uv[3] + third * surface.uv[5]);
      const float width = spread * RTCRayN_tfar(arguments->ray, arguments->N, i);
      if (part.materials->is_hole(surface.material_light & 0xffu, uv, width)) arguments->valid[i] = 0;
    }
  }
};

TracedScene::TracedScene(std::shared_ptr<const Scene> scene, const ShadingMaterials& materials)
    : scene_(std::move(scene)), materials_(materials) {
  device_.reset(rtcNewDevice(nullptr));
  if (!device_) throw std::runtime_error("renderer: Embree could not create a device");
  std::size_t surface_count = 0;
  for (const auto& mesh : scene_->fixed) surface_count += mesh.triangles.size();
  for (const auto& mesh : scene_->models) surface_count += mesh.triangles.size();
  surfaces_.reserve(surface_count);

  for (const auto& model : scene_->models) {
    Prototype prototype{ScenePointer(rtcNewScene(device_.get())), {}, model.triangles.size(), {}};
    rtcSetSceneBuildQuality(prototype.scene.get(), RTC_BUILD_QUALITY_HIGH);
    const std::size_t first_part = parts_.size();
    prototype.first_surface = add_mesh(model, prototype.scene.get(), 0);
    for (std::size_t i = first_part; i < parts_.size(); ++i) prototype.parts.push_back(parts_[i].get());
    rtcCommitScene(prototype.scene.get());
    prototypes_.push_back(std::move(prototype));
  }
  standing_.reset(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(standing_.get(), RTC_BUILD_QUALITY_HIGH);
  // Embree geometry ids: 2 i for surfaces of object i without holes, 2 i + 1 for those with holes
  for (const auto& mesh : scene_->fixed) {
    ObjectRecord object;
    object.first_surface = add_mesh(mesh, standing_.get(), static_cast<std::uint32_t>(2 * objects_.size()));
    object.world_from_model = triangle_array(Eigen::Affine3f::Identity());
    objects_.push_back(object);
    triangle_count_ += mesh.triangles.size();
  }
  // standing models are copied, not instanced: packets stay coherent, which is worth the memory
  for (const auto& placement : scene_->standing) {
    const auto first_geometry = static_cast<std::uint32_t>(2 * objects_.size());
    objects_.push_back(placed(placement));
    const auto& prototype = prototypes_[placement.model];
    triangle_count_ += prototype.triangle_count;
    if (prototype.parts.empty()) continue;
    auto& positions = placed_positions_.emplace_back(prototype.parts.front()->positions);
    for (auto& position : positions) position = placement.world_from_model * position;
    for (const auto* part : prototype.parts) {
      attach(*part, positions, placement.visibility, standing_.get(), first_geometry);
    }
  }
  moving_first_ = static_cast<std::uint32_t>(objects_.size());
  rtcCommitScene(standing_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("renderer: Embree could not build the scene (out of memory?)");
  }
  bake_ambient_light();
}

TracedScene::~TracedScene() = default;

void TracedScene::bake_ambient_light() {
  for (std::size_t i = 0; i < scene_->fixed.size(); ++i) {
    set_ambient_light(scene_->fixed[i], ambient_light(standing_.get(), scene_->fixed[i]));
  }
  // ambient light of a model is computed on an empty plain: it is the same for all placements
  alignas(16) const std::array<float, 13> plain_corners{-50, -50, 0, 50, -50, 0, 50, 50, 0, -50, 50, 0, 0};
  const std::array<std::uint32_t, 4> plain_quad{0, 1, 2, 3};
  const RTCGeometry plain = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
  rtcSetSharedGeometryBuffer(plain, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, plain_corners.data(), 0, 12, 4);
  rtcSetSharedGeometryBuffer(plain, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, plain_quad.data(), 0, 16, 1);
  rtcCommitGeometry(plain);
  for (std::size_t i = 0; i < prototypes_.size(); ++i) {
    const ScenePointer alone(rtcNewScene(device_.get()));
    rtcAttachGeometryByID(alone.get(), plain, 0);
    const RTCGeometry geometry = instance({static_cast<std::uint32_t>(i), Eigen::Affine3f::Identity(), {}, kToAll}, 1);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(alone.get(), geometry, 1);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(alone.get());
    set_ambient_light(scene_->models[i], ambient_light(alone.get(), scene_->models[i]));
  }
  rtcReleaseGeometry(plain);
}

void TracedScene::set_ambient_light(const Mesh& mesh, const std::vector<std::uint8_t>& light) {
  for (const auto& part : parts_) {
    if (part->mesh != &mesh) continue;
    for (std::size_t i = 0; i < part->corners.size(); ++i) {
      const auto [a, b, c, d] = part->corners[i];
      // for a triangle, the extrapolated fourth corner
      const int opposite = c == d ? light[b] + light[c] - light[a] : light[c];
      std::uint32_t word = part->of_material[i];
      const std::array<int, 4> corners{light[a], light[b], light[d], opposite};
      for (std::size_t corner = 0; corner < 4; ++corner) {
        word |= (static_cast<std::uint32_t>(std::clamp(corners[corner], 0, 255)) >> 2) << (6 * corner + 8);
      }
      surfaces_[part->first_surface + i].material_light = word;
    }
  }
}

std::array<std::uint32_t, 2> TracedScene::add_mesh(const Mesh& mesh, RTCScene scene, std::uint32_t first_geometry) {
  const auto& materials = scene_->palette->materials();
  std::array<std::uint32_t, 2> first_surface{};
  for (const bool has_holes : {false, true}) {
    auto part = std::make_unique<Part>();
    part->mesh = &mesh;
    part->surfaces = &surfaces_;
    part->materials = &materials_;
    part->first_surface = static_cast<std::uint32_t>(surfaces_.size());
    first_surface[has_holes ? 1 : 0] = part->first_surface;
    part->has_holes = has_holes;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& triangle = mesh.triangles[i];
      if (triangle.material >= materials.size()) {
        throw std::invalid_argument(fmt::format("renderer: a triangle has material {}, the palette has {}",
                                                triangle.material, materials.size()));
      }
      if (materials[triangle.material].has_holes != has_holes) continue;
      const auto [a, b, c] = triangle.corners;
      surfaces_.push_back(surface_record(mesh, triangle));
      part->corners.push_back({a, b, c, c});
      part->of_material.push_back(triangle.material);
      // merge a, b, c and a, c, d: half as many surfaces to trace
      if (i + 1 == mesh.triangles.size()) continue;
      const auto& next = mesh.triangles[i + 1];
      const std::uint32_t d = next.corners[2];
      if (next.material != triangle.material || next.corners[0] != a || next.corners[1] != c) continue;
      if (!is_even(mesh, {a, b, c, d}, has_holes)) continue;
      surfaces_.back() = surface_record(mesh, {{a, b, d}, triangle.material});
      part->corners.back() = {a, b, c, d};
      ++i;
    }
    if (part->corners.empty()) continue;
    part->positions.reserve(mesh.vertices.size() + 1);
    for (const auto& vertex : mesh.vertices) part->positions.push_back(vertex.position);
    part->positions.emplace_back(Eigen::Vector3f::Zero());
    attach(*part, part->positions, kToAll, scene, first_geometry);
    parts_.push_back(std::move(part));
  }
  return first_surface;
}

void TracedScene::attach(const Part& part, const std::vector<Eigen::Vector3f>& positions, std::uint32_t visibility,
                         RTCScene scene, std::uint32_t first_geometry) const {
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                             sizeof(Eigen::Vector3f), positions.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, part.corners.data(), 0,
                             sizeof(part.corners[0]), part.corners.size());
  rtcSetGeometryMask(geometry, visibility);
  if (part.has_holes) {
    rtcSetGeometryUserData(geometry, const_cast<Part*>(&part));
    rtcSetGeometryIntersectFilterFunction(geometry, Part::let_through_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, Part::let_through_holes);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, first_geometry + (part.has_holes ? 1 : 0));
  rtcReleaseGeometry(geometry);
}

ObjectRecord TracedScene::placed(const Placement& placement) const {
  if (placement.model >= prototypes_.size()) {
    throw std::invalid_argument(
        fmt::format("renderer: model {} is placed, the scene has {}", placement.model, prototypes_.size()));
  }
  ObjectRecord object;
  object.first_surface = prototypes_[placement.model].first_surface;
  object.world_from_model = triangle_array(placement.world_from_model);
  object.is_placed = 1;
  object.tint = {static_cast<float>(placement.tint.red) / 255.0f, static_cast<float>(placement.tint.green) / 255.0f,
                 static_cast<float>(placement.tint.blue) / 255.0f};
  return object;
}

RTCGeometry TracedScene::instance(const Placement& placement, int time_steps) const {
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, prototypes_[placement.model].scene.get());
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(time_steps));
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                          triangle_array(placement.world_from_model).data());
  rtcSetGeometryMask(geometry, placement.visibility);
  return geometry;
}

void TracedScene::place_movers(std::span<const MovingPlacement> movers) {
  objects_.resize(moving_first_);
  moving_.reset();
  if (movers.empty()) return;
  moving_.reset(rtcNewScene(device_.get()));
  for (const auto& mover : movers) {
    ObjectRecord object = placed(mover.at_opening);
    const auto closed = triangle_array(mover.world_from_model_closed);
    for (std::size_t i = 0; i < closed.size(); ++i) object.motion[i] = closed[i] - object.world_from_model[i];
    object.moves = 1;
    const RTCGeometry geometry = instance(mover.at_opening, 2);
    rtcSetGeometryTransform(geometry, 1, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, closed.data());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(moving_.get(), geometry, static_cast<std::uint32_t>(objects_.size()) - moving_first_);
    rtcReleaseGeometry(geometry);
    objects_.push_back(object);
  }
  rtcCommitScene(moving_.get());
}

}  // namespace panvo::simulated_world
