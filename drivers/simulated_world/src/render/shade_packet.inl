// SPDX-License-Identifier: Apache-2.0
// Shades sixteen hits. Included once per instruction set, after packet_textures.inl; see packet_math.inl.

/// Unpacks octahedral normals.
PANVO_INLINE Vector3 unpacked_normal(const Word& packed) {
  const Float x = to_float((Int)(packed << 16) >> 16) * (1.0f / 32767.0f);
  const Float y = to_float((Int)packed >> 16) * (1.0f / 32767.0f);
  const Float z = 1.0f - absolute(x) - absolute(y);
  const Float over = maximum(-z, all(0.0f));
  return {x + choose(x >= 0.0f, -over, over), y + choose(y >= 0.0f, -over, over), z};
}

PANVO_INLINE Vector3 seen_in_mirror(const ShadingTables& tables, const Vector3& direction) {
  const Float sum = 1.0f / (absolute(direction.x) + absolute(direction.y) + absolute(direction.z));
  const Float flat_x = direction.x * sum;
  const Float flat_y = direction.y * sum;
  const Int is_below = direction.z < 0.0f;
  const Float x = choose(is_below, (1.0f - absolute(flat_y)) * choose(flat_x >= 0.0f, all(1.0f), all(-1.0f)), flat_x);
  const Float y = choose(is_below, (1.0f - absolute(flat_x)) * choose(flat_y >= 0.0f, all(1.0f), all(-1.0f)), flat_y);
  const float cells = (float)(kEnvironmentSide - 1);
  const Float column = clamped((0.5f + 0.5f * x) * cells, 0.0f, cells - 0.001f);
  const Float row = clamped((0.5f + 0.5f * y) * cells, 0.0f, cells - 0.001f);
  const Int left = truncated(column);
  const Int top = truncated(row);
  const Float right_share = column - to_float(left);
  const Float low_share = row - to_float(top);
  const Word index = (Word)(top * kEnvironmentSide + left) * 3u;
  const float* map = tables.environment;
  const Vector3 top_left = gather3(map, index);
  const Vector3 low_left = gather3(map + 3 * kEnvironmentSide, index);
  const Vector3 up = top_left + right_share * (gather3(map + 3, index) - top_left);
  const Vector3 low = low_left + right_share * (gather3(map + 3 * kEnvironmentSide + 3, index) - low_left);
  return up + low_share * (low - up);
}

/// What the rays hit.
struct Hit {
  Vector3 direction, point;
  Float time, distance;
  Float first, second, third;  ///< barycentric coordinates
  Int is_hit, is_fixed;
  Word object;                 ///< into the objects
  Word object_words, surface;  ///< first words of the records of object and surface
};

PANVO_INLINE Hit hit_of(const ShadingTables& tables, const TracedPacket& traced) {
  const auto& rays = traced.rays.ray;
  const auto& hits = traced.rays.hit;
  Hit hit;
  const Vector3 origin{load<Float>(rays.org_x), load<Float>(rays.org_y), load<Float>(rays.org_z)};
  hit.direction = {load<Float>(rays.dir_x), load<Float>(rays.dir_y), load<Float>(rays.dir_z)};
  hit.time = load<Float>(rays.time);
  const Word geometry = load<Word>(hits.geomID);
  hit.is_hit = geometry != RTC_INVALID_GEOMETRY_ID;
  hit.distance = choose(hit.is_hit, load<Float>(rays.tfar), all(1.0f));
  hit.point = origin + hit.distance * hit.direction;
  hit.second = load<Float>(hits.u);
  hit.third = load<Float>(hits.v);
  hit.first = 1.0f - hit.second - hit.third;

  const Word instance = load<Word>(hits.instID[0]);
  hit.is_fixed = instance == RTC_INVALID_GEOMETRY_ID;
  Word object = (Word)(hit.is_fixed ? (Int)(geometry >> 1) : (Int)instance);
  object = object + ((Word)load<Int>(traced.is_moving) & all_word(tables.first_moving_object));
  hit.object = object & (Word)hit.is_hit;
  hit.object_words = hit.object * (std::uint32_t)(sizeof(ObjectRecord) / 4);
  const auto* objects = (const std::uint32_t*)tables.objects;
  const Word first_surface = gather(objects, hit.object_words + (geometry & 1u & (Word)hit.is_hit));
  hit.surface = (first_surface + (load<Word>(hits.primID) & (Word)hit.is_hit)) * 16u;
  return hit;
}

/// The surface at the hits, in the world frame.
struct Surface {
  Vector3 flat, normal;            ///< of the triangle; interpolated between its corners
  Vector3 u_gradient, v_gradient;  ///< of the texture's coordinates, per m
  Vector3 motion;                  ///< of the ray's point on the surface while the shutter is open, m
  Vector3 object_tint;
};

/// Turns a model's surface into the world, with the motion of its object.
PANVO_INLINE void place(const ShadingTables& tables, const Hit& hit, const Int& is_placed, Surface& surface) {
  const auto* object_words = (const std::uint32_t*)tables.objects;
  const auto* object_numbers = (const float*)tables.objects;
  const Int is_instance = ~hit.is_fixed & hit.is_hit;  // a mover; standing models are copies, not instances
  const Int moves = (Int)gather(object_words + 29, hit.object_words) != 0;
  Vector3 axis_x = gather3(object_numbers + 2, hit.object_words);
  Vector3 axis_y = gather3(object_numbers + 5, hit.object_words);
  Vector3 axis_z = gather3(object_numbers + 8, hit.object_words);
  if (any(moves & is_placed)) {
    const Vector3 moved_x = gather3(object_numbers + 14, hit.object_words);
    const Vector3 moved_y = gather3(object_numbers + 17, hit.object_words);
    const Vector3 moved_z = gather3(object_numbers + 20, hit.object_words);
    axis_x = axis_x + hit.time * moved_x;
    axis_y = axis_y + hit.time * moved_y;
    axis_z = axis_z + hit.time * moved_z;
    const Vector3 foot =
        gather3(object_numbers + 11, hit.object_words) + hit.time * gather3(object_numbers + 23, hit.object_words);
    const Vector3 from_foot = (1.0f / dot(axis_x, axis_x)) * (hit.point - foot);
    const Vector3 own = gather3(object_numbers + 23, hit.object_words) + dot(axis_x, from_foot) * moved_x +
                        dot(axis_y, from_foot) * moved_y + dot(axis_z, from_foot) * moved_z;
    surface.motion = choose(moves & is_placed, surface.motion - own, surface.motion);
  }
  const auto turned = [&](const Int& which, const Vector3& vector) PANVO_ALWAYS {
    return choose(which, vector.x * axis_x + vector.y * axis_y + vector.z * axis_z, vector);
  };
  surface.flat = turned(is_instance, surface.flat);
  surface.normal = turned(is_placed, surface.normal);
  const Float shrunk = 1.0f / choose(is_placed, dot(axis_x, axis_x), all(1.0f));
  surface.u_gradient = shrunk * turned(is_placed, surface.u_gradient);
  surface.v_gradient = shrunk * turned(is_placed, surface.v_gradient);
  surface.object_tint = gather3(object_numbers + 26, hit.object_words);
}

PANVO_INLINE Surface surface_of(const ShadingTables& tables, const TracedPacket& traced, const Hit& hit) {
  const auto& hits = traced.rays.hit;
  const auto& direction = hit.direction;
  const auto* words = (const std::uint32_t*)tables.surfaces;
  Surface surface;
  surface.flat = {load<Float>(hits.Ng_x), load<Float>(hits.Ng_y), load<Float>(hits.Ng_z)};
  surface.normal = hit.first * unpacked_normal(gather(words, hit.surface)) +
                   hit.second * unpacked_normal(gather(words + 1, hit.surface)) +
                   hit.third * unpacked_normal(gather(words + 2, hit.surface));
  const Word gradient_0 = gather(words + 13, hit.surface);
  const Word gradient_1 = gather(words + 14, hit.surface);
  const Word gradient_2 = gather(words + 15, hit.surface);
  surface.u_gradient = {bits_of(gradient_0 << 16), bits_of(gradient_0 & 0xffff0000u), bits_of(gradient_1 << 16)};
  surface.v_gradient = {bits_of(gradient_1 & 0xffff0000u), bits_of(gradient_2 << 16),
                        bits_of(gradient_2 & 0xffff0000u)};
  const auto& turn = tables.camera_rotation;
  surface.motion = all(tables.camera_motion) +
                   hit.distance * Vector3{turn[0] * direction.x + turn[1] * direction.y + turn[2] * direction.z,
                                          turn[3] * direction.x + turn[4] * direction.y + turn[5] * direction.z,
                                          turn[6] * direction.x + turn[7] * direction.y + turn[8] * direction.z};
  surface.object_tint = {all(1.0f), all(1.0f), all(1.0f)};
  const Int is_placed = ((Int)gather((const std::uint32_t*)tables.objects + 30, hit.object_words) != 0) & hit.is_hit;
  if (any(is_placed)) place(tables, hit, is_placed, surface);
  surface.flat = normalized(surface.flat);
  surface.normal = normalized(surface.normal);
  // surfaces are two-sided
  surface.flat = choose(dot(surface.flat, direction) > 0.0f, all(-1.0f) * surface.flat, surface.flat);
  surface.normal = choose(dot(surface.normal, surface.flat) < 0.0f, all(-1.0f) * surface.normal, surface.normal);
  return surface;
}

/// Material, tint and ambient light at the hits.
struct Look {
  Word material, material_words;  ///< into the materials; first word of its record
  Word flags;
  Float open;  ///< 0..1: share of sky and ground that is visible
  Vector3 tint;
  Float contrast;
};

PANVO_INLINE Look look_of(const ShadingTables& tables, const Hit& hit) {
  const auto* words = (const std::uint32_t*)tables.surfaces;
  Look look;
  const Word material_light = gather(words + 12, hit.surface);
  look.material = material_light & 0xffu;
  look.material_words = look.material * 16u;
  look.flags = gather((const std::uint32_t*)tables.materials + 12, look.material_words);
  const auto interpolated = [&](const Word& a, const Word& b, const Word& c) PANVO_ALWAYS {
    const Float value = hit.first * to_float((Int)(a & 0xffu)) + hit.second * to_float((Int)(b & 0xffu)) +
                        hit.third * to_float((Int)(c & 0xffu));
    return clamped((1.0f / 255.0f) * value, 0.0f, 1.0f);  // a card's fourth corner is extrapolated
  };
  const auto corner_light = [&](int bit) PANVO_ALWAYS { return to_float((Int)((material_light >> bit) & 0x3fu)); };
  look.open =
      (1.0f / 63.0f) * ((1.0f - hit.third) * ((1.0f - hit.second) * corner_light(8) + hit.second * corner_light(14)) +
                        hit.third * ((1.0f - hit.second) * corner_light(20) + hit.second * corner_light(26)));
  const Word tint_0 = gather(words + 9, hit.surface);
  const Word tint_1 = gather(words + 10, hit.surface);
  const Word tint_2 = gather(words + 11, hit.surface);
  look.tint = {interpolated(tint_0, tint_1, tint_2), interpolated(tint_0 >> 8, tint_1 >> 8, tint_2 >> 8),
               interpolated(tint_0 >> 16, tint_1 >> 16, tint_2 >> 16)};
  look.contrast = interpolated(tint_0 >> 24, tint_1 >> 24, tint_2 >> 24);
  return look;
}

/// The pixel's footprint on the surface, in m: the rays of its neighbours and its own later ray, intersected with the
/// surface's plane.
PANVO_INLINE Footprint footprint_of(const ShadingTables& tables, const TracedPacket& traced, const Hit& hit,
                                    const Surface& surface) {
  const auto* numbers = (const float*)tables.surfaces;
  const float share = traced.motion_share;
  const Float slope = minimum(dot(hit.direction, surface.flat), all(-0.02f));
  const Float per_slope = 1.0f / slope;
  const auto on_plane = [&](const Vector3& change)
                            PANVO_ALWAYS { return change - (dot(change, surface.flat) * per_slope) * hit.direction; };
  const Vector3 across = on_plane(hit.distance * load3(traced.across));
  const Vector3 down = on_plane(hit.distance * load3(traced.down));
  const Vector3 moved = all(share) * on_plane(surface.motion);
  return {gather(numbers + 3, hit.surface) + hit.second * gather(numbers + 5, hit.surface) +
              hit.third * gather(numbers + 7, hit.surface),
          gather(numbers + 4, hit.surface) + hit.second * gather(numbers + 6, hit.surface) +
              hit.third * gather(numbers + 8, hit.surface),
          dot(surface.u_gradient, across),
          dot(surface.v_gradient, across),
          dot(surface.u_gradient, down),
          dot(surface.v_gradient, down),
          dot(surface.u_gradient, moved),
          dot(surface.v_gradient, moved)};
}

PANVO_INLINE Vector3 albedo_of(const ShadingTables& tables, const Hit& hit, const Look& look,
                               const Vector3& object_tint, const Footprint& metres) {
  const auto* words = (const std::uint32_t*)tables.materials;
  const auto* numbers = (const float*)tables.materials;
  const auto in_periods = [&](const Float& s) PANVO_ALWAYS {
    return Footprint{metres.u * s,  metres.v * s,  metres.ux * s, metres.uy * s,
                     metres.vx * s, metres.vy * s, metres.mx * s, metres.my * s};
  };
  Footprint at = in_periods(gather(numbers + 8, look.material_words));
  at.u = at.u - to_float(floored(at.u));  // keeps texel indices small and exact
  at.v = at.v - to_float(floored(at.v));
  const Vector3 mean = gather3(numbers + 4, look.material_words);
  const Vector3 colour = sample(tables, gather(words + 3, look.material_words), at, tables.texture_taps);
  Vector3 albedo = (mean + look.contrast * (colour - mean)) * look.tint * gather3(numbers, look.material_words);
  const Int takes_tint = (Int)(look.flags & kTakesObjectTint) != 0;
  albedo = choose(takes_tint, albedo * object_tint, albedo);
  const Int has_overlay = (Int)(look.flags & kHasOverlay) != 0;
  if (any(has_overlay & hit.is_hit)) {
    Footprint overlay_at = in_periods(gather(numbers + 9, look.material_words));
    scatter((Int)(look.flags & kOverlayIsScattered) != 0, overlay_at);
    const Vector3 overlay = sample(tables, gather(words + 7, look.material_words), overlay_at, 2);
    albedo = choose(has_overlay, all(2.0f) * (overlay * albedo), albedo);
  }
  return albedo;
}

/// Snow lies on what faces upwards, from about 25 degrees off the vertical on.
PANVO_INLINE Vector3 under_snow(const ShadingTables& tables, const Look& look, const Vector3& normal,
                                const Vector3& albedo) {
  const Float steepness = clamped(2.5f * normal.z - 1.25f, 0.0f, 1.0f);
  const Float cover = steepness * gather((const float*)tables.materials + 13, look.material_words);
  const Float white = all(0.82f);
  return albedo + cover * (Vector3{white, white, white} - albedo);
}

/// The light that leaves the surface: sky and ground as far as visible, sun from the front or through a leaf.
struct Radiance {
  Vector3 base, sun;
  Float direct;  ///< share of the sunlight, unless in shadow
};

PANVO_INLINE Radiance radiance_of(const ShadingTables& tables, const Hit& hit, const Surface& surface, const Look& look,
                                  const Vector3& albedo, const Float& flat_facing) {
  const auto* numbers = (const float*)tables.materials;
  const Vector3 to_sun = all(tables.to_sun);
  const Vector3& normal = surface.normal;
  const Float upwards = 0.5f + 0.5f * normal.z;
  const Vector3 indirect = look.open * (upwards * all(tables.sky) + (1.0f - upwards) * all(tables.ground));
  const Float translucency = gather(numbers + 11, look.material_words);
  const Float facing = dot(normal, to_sun);
  Radiance radiance;
  radiance.direct = choose(facing > 0.0f, (1.0f - translucency) * facing, -translucency * facing);
  radiance.direct = choose((flat_facing > 0.0f) | (translucency > 0.0f), radiance.direct, all(0.0f));
  radiance.base = albedo * indirect;
  radiance.sun = radiance.direct * (albedo * all(tables.sun));

  const Float gloss = gather(numbers + 10, look.material_words);
  if (any((gloss > 0.0f) & hit.is_hit)) {
    const Float cosine = clamped(-dot(normal, hit.direction), 0.0f, 1.0f);
    const Float rest = 1.0f - cosine;
    const Float mirrored =
        choose(gloss > 0.0f, gloss + (1.0f - gloss) * (rest * rest) * (rest * rest) * rest, all(0.0f));
    const Vector3 seen = seen_in_mirror(tables, hit.direction + (2.0f * cosine) * normal);
    radiance.base = (1.0f - mirrored) * radiance.base + (mirrored * look.open) * seen;
    radiance.sun = (1.0f - mirrored) * radiance.sun;
  }
  const Float clear = rough_exp2(maximum(hit.distance * (-1.442695f * tables.haze_per_m), all(-100.0f)));
  radiance.base = clear * radiance.base + (1.0f - clear) * all(tables.haze);
  radiance.sun = clear * radiance.sun;
  return radiance;
}

PANVO_INLINE void store_shadow_rays(const ShadingTables& tables, const Hit& hit, const Surface& surface,
                                    const Float& flat_facing, RTCRay16& shadow) {
  const Vector3 to_sun = all(tables.to_sun);
  const Float offset = 1e-3f + 2e-4f * hit.distance;
  const Vector3 above = hit.point + choose(flat_facing > 0.0f, offset, -offset) * surface.flat;
  store(shadow.org_x, above.x);
  store(shadow.org_y, above.y);
  store(shadow.org_z, above.z);
  store(shadow.dir_x, to_sun.x);
  store(shadow.dir_y, to_sun.y);
  store(shadow.dir_z, to_sun.z);
  store(shadow.tnear, all(0.0f));
  store(shadow.tfar, all(std::numeric_limits<float>::infinity()));
  store(shadow.time, hit.time);
  store(shadow.mask, all_word(kToShadow));
  store(shadow.flags, all_word(0));
}

void shade_packet(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded) {
  const Hit hit = hit_of(tables, traced);
  const Surface surface = surface_of(tables, traced, hit);
  const Look look = look_of(tables, hit);
  const Footprint footprint = footprint_of(tables, traced, hit, surface);
  Vector3 albedo = albedo_of(tables, hit, look, surface.object_tint, footprint);
  if (tables.has_snow) albedo = under_snow(tables, look, surface.normal, albedo);
  const Float flat_facing = dot(surface.flat, all(tables.to_sun));
  const Radiance radiance = radiance_of(tables, hit, surface, look, albedo, flat_facing);

  store3(shaded.base, radiance.base);
  store3(shaded.sun, radiance.sun);
  const Int wants_shadow = (radiance.direct > 0.0f) & hit.is_hit;
  store(shaded.wants_shadow, wants_shadow);
  store_shadow_rays(tables, hit, surface, flat_facing, shaded.shadow);
  store(shaded.key, ((hit.object << 8) | look.material) + 1u);
  const auto byte = [](const Float& value) PANVO_ALWAYS { return (Word)truncated(value * 127.0f) & 0xffu; };
  const Vector3& normal = surface.normal;
  store(shaded.normal, byte(normal.x) | byte(normal.y) << 8 | byte(normal.z) << 16 | look.flags << 24);
}
