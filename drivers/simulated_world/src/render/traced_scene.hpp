// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "embree.hpp"
#include "panvo/simulated_world/renderer.hpp"
#include "panvo/simulated_world/scene.hpp"
#include "shading_materials.hpp"

namespace panvo::simulated_world {

/// A triangle or parallelogram in the layout used for shading: one cache line. For a parallelogram a, b, c, d it holds
/// corners a, b and d; values at c follow from them, except for the light.
struct alignas(64) SurfaceRecord {
  std::array<std::uint32_t, 3> normals{};  ///< of the corners, octahedral, 16 + 16 bits
  std::array<float, 6> uv{};               ///< m: first corner, then differences of the second and third to it
  std::array<std::uint32_t, 3> tints{};    ///< of the corners: red, green, blue, contrast from the low byte up
  /// Material in the low byte, then ambient light with six bits per corner: a, b, d, c.
  std::uint32_t material_light = 0;
  std::array<std::uint32_t, 3> gradients{};  ///< of u and v by position in the model, six bfloat16: m per m
};
static_assert(sizeof(SurfaceRecord) == 64);

/// A fixed mesh or a placed model, in the layout used for shading.
struct ObjectRecord {
  std::array<std::uint32_t, 2> first_surface{};  ///< into the surfaces: without and with holes
  std::array<float, 12> world_from_model{};      ///< column by column, when the shutter opens
  std::array<float, 12> motion{};                ///< change of world_from_model until the shutter closes
  std::array<float, 3> tint{1.0f, 1.0f, 1.0f};
  std::uint32_t moves = 0;
  std::uint32_t is_placed = 0;
  std::uint32_t padding = 0;
};
static_assert(sizeof(ObjectRecord) == 32 * sizeof(std::uint32_t));

/// Context that Embree passes to the hole filter.
struct TraceContext {
  RayContext embree;
  float spread = 0.0f;  ///< rad: widening of the rays with distance
};

/// Octahedral map of a unit vector [Cigolle et al. 2014], 16 bits per coordinate.
std::uint32_t pack_normal(const Eigen::Vector3f& normal);
Eigen::Vector3f unpack_normal(std::uint32_t packed);

struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using ScenePointer = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using DevicePointer = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;

/// The scene in Embree's structures, with the shading data of each surface.
class TracedScene {
 public:
  /// `materials` must outlive it.
  TracedScene(std::shared_ptr<const Scene> scene, const ShadingMaterials& materials);
  ~TracedScene();
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// Sets the movers' current placements, replacing those of the last call.
  void place_movers(std::span<const MovingPlacement> movers);

  RTCScene standing() const { return standing_.get(); }
  /// Null if nothing moves.
  RTCScene moving() const { return moving_.get(); }

  void fill(ShadingTables& tables) const {
    tables.surfaces = surfaces_.data();
    tables.objects = objects_.data();
    tables.first_moving_object = moving_first_;
  }
  std::uint64_t triangle_count() const { return triangle_count_; }

 private:
  struct Part;  // triangles of one mesh, all with holes or all without
  struct Prototype {
    ScenePointer scene;
    std::array<std::uint32_t, 2> first_surface{};
    std::uint64_t triangle_count = 0;
    std::vector<const Part*> parts;
  };

  std::array<std::uint32_t, 2> add_mesh(const Mesh& mesh, RTCScene scene, std::uint32_t first_geometry);
  void attach(const Part& part, const std::vector<Eigen::Vector3f>& positions, std::uint32_t visibility, RTCScene scene,
              std::uint32_t first_geometry) const;
  void set_ambient_light(const Mesh& mesh, const std::vector<std::uint8_t>& light);
  void bake_ambient_light();
  ObjectRecord placed(const Placement& placement) const;
  RTCGeometry instance(const Placement& placement, int time_steps) const;

  std::shared_ptr<const Scene> scene_;
  const ShadingMaterials& materials_;
  DevicePointer device_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<std::vector<Eigen::Vector3f>> placed_positions_;  // of standing models, world frame
  std::vector<Prototype> prototypes_;
  std::vector<SurfaceRecord> surfaces_;
  std::vector<ObjectRecord> objects_;  // fixed meshes, standing models, movers
  std::uint32_t moving_first_ = 0;
  std::uint64_t triangle_count_ = 0;
  ScenePointer standing_, moving_;
};

}  // namespace panvo::simulated_world
