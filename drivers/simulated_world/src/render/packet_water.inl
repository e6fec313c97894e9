// SPDX-License-Identifier: Apache-2.0
// Wet ground at sixteen hits. Included once per instruction set, after packet_surfaces.inl.

/// Smooth random values, 0..1, one per cell of a horizontal grid.
PANVO_INLINE Float unevenness(const Vector3& point, float cell_m, std::uint32_t seed) {
  const Float x = (1.0f / cell_m) * point.x;
  const Float y = (1.0f / cell_m) * point.y;
  const Int column = floored(x);
  const Int row = floored(y);
  const auto value = [&](std::int32_t right, std::int32_t up) PANVO_ALWAYS {
    return (1.0f / 65536.0f) * to_float((Int)(scrambled(column + right, row + up, Int{}, seed) >> 16));
  };
  const auto eased = [](const Float& share) PANVO_ALWAYS { return share * share * (3.0f - 2.0f * share); };
  const Float right = eased(x - to_float(column));
  const Float up = eased(y - to_float(row));
  const Float low = value(0, 0) + right * (value(1, 0) - value(0, 0));
  const Float high = value(0, 1) + right * (value(1, 1) - value(0, 1));
  return low + up * (high - low);
}

/// Water on the ground.
struct Water {
  Float film;    ///< 0..1: how wet
  Float puddle;  ///< 0..1: share of the film that is a closed surface
};

/// What is wet shows upwards; puddles stand where the ground is level and lies low.
PANVO_INLINE Water water_on(const ShadingTables& tables, const Hit& hit, const Vector3& normal,
                            const Word& material_words) {
  Water water;
  water.film =
      clamped(10.0f * normal.z - 8.5f, 0.0f, 1.0f) * gather((const float*)tables.materials + 15, material_words);
  const Float level = clamped(2000.0f * (normal.z - 0.9993f), 0.0f, 1.0f);  // slopes below 2 to 4 %
  const Float height = 0.6f * unevenness(hit.point, 4.7f, 1u) + 0.28f * unevenness(hit.point, 1.7f, 2u) +
                       0.12f * unevenness(hit.point, 0.5f, 3u);
  water.puddle = level * clamped(12.0f * (0.42f - height), 0.0f, 1.0f);
  return water;
}

/// Water in the pores keeps light inside: dark stone gets much darker, white paint hardly.
PANVO_INLINE Vector3 under_water(const Water& water, const Vector3& albedo) {
  const Float kept = water.film * (0.5f + 0.15f * water.puddle);
  const auto darker = [&](const Float& value) PANVO_ALWAYS { return value * (1.0f - kept * (1.0f - value)); };
  return {darker(albedo.x), darker(albedo.y), darker(albedo.z)};
}

/// Share of the light that a smooth surface of water reflects.
PANVO_INLINE Float fresnel_of_water(const Float& cosine) { return fresnel(all(0.02f), cosine); }

/// How wet ground divides what it reflects.
struct Reflectance {
  Float of_puddle;  ///< a mirror
  Float of_film;    ///< a mirror, but for what is small and bright, which the rough ground below spreads
  Float blurred;    ///< by the rough ground
};

PANVO_INLINE Reflectance reflectance_of(const Water& water, const Float& cosine) {
  constexpr float kRoughShare = 0.6f;  // of the light that a smooth surface would reflect
  constexpr float kSharpShare = 0.5f;  // of what a film reflects
  const Float all_of_it = water.film * fresnel_of_water(cosine);
  const Float of_film = kRoughShare * (1.0f - water.puddle) * all_of_it;
  return {water.puddle * all_of_it, kSharpShare * of_film, (1.0f - kSharpShare) * of_film};
}

/// What a rough film reflects of a lamp's light towards the camera, relative to a white surface perpendicular to that
/// light: its facets are mirrors that face the middle between both [Walter et al. 2007].
PANVO_INLINE Float glint_of(const Water& water, const Vector3& normal, const Vector3& direction,
                            const Vector3& towards_lamp) {
  constexpr float kSquare = 0.2f * 0.2f;  // of the roughness
  const Vector3 middle = normalized(towards_lamp - direction);
  const Float upright = clamped(dot(normal, middle), 0.0f, 1.0f);
  const Float spread = 1.0f - (1.0f - kSquare) * upright * upright;
  const Float facets = kSquare * (1.0f / (spread * spread));
  const Float hidden = 4.0f * (0.1f + clamped(-dot(normal, direction), 0.0f, 1.0f));
  const Float glint = facets * fresnel_of_water(clamped(dot(middle, towards_lamp), 0.0f, 1.0f)) * (1.0f / hidden);
  return choose(dot(normal, towards_lamp) > 0.0f, water.film * (1.0f - water.puddle) * glint, all(0.0f));
}

/// The rays to what the ground mirrors, with the footprints of their pixels as seen from the ground. Tracing completes
/// them.
PANVO_INLINE void store_mirror_rays(const TracedPacket& traced, const Hit& hit, const Surface& surface,
                                    const Reflectance& mirror, ShadedPacket& shaded) {
  constexpr float kAbove_m = 0.02f;  // paint and covers lie a little above the ground beside them
  const Vector3& normal = surface.normal;
  const auto mirrored = [&](const Vector3& way)
                            PANVO_ALWAYS { return way - (2.0f * dot(normal, way)) * normal; };
  const Vector3 from = hit.point + (kAbove_m + 2e-4f * hit.distance) * surface.flat;
  const Vector3 towards = mirrored(hit.direction);
  store(shaded.of_puddle, choose(hit.is_hit, mirror.of_puddle, all(0.0f)));
  store(shaded.of_film, choose(hit.is_hit, mirror.of_film, all(0.0f)));
  auto& ray = shaded.mirrored.rays.ray;
  store(ray.org_x, from.x);
  store(ray.org_y, from.y);
  store(ray.org_z, from.z);
  store(ray.dir_x, towards.x);
  store(ray.dir_y, towards.y);
  store(ray.dir_z, towards.z);
  store(ray.time, hit.time);
  store3(shaded.mirrored.across, mirrored(load3(traced.across)));
  store3(shaded.mirrored.down, mirrored(load3(traced.down)));
}
