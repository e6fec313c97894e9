// SPDX-License-Identifier: Apache-2.0
// Shades sixteen hits. Included once per instruction set, after packet_water.inl; see packet_math.inl.

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

/// The light that may be in shadow: that of the sun, at night that of the lamp that is brightest here.
struct DirectLight {
  Vector3 towards, colour;
  Float reach;          ///< of the shadow ray, m
  Float flat_facing;    ///< cosine of its angle from the triangle's normal
  Float glint;          ///< what wet ground reflects of it, relative to a white surface perpendicular to it
  Vector3 other_lamps;  ///< radiance of a white surface by all others, without shadows
  Vector3 other_glints;
};

PANVO_INLINE DirectLight sunlight(const ShadingTables& tables, const Surface& surface) {
  const Vector3 towards = all(tables.to_sun);
  const Float far = all(std::numeric_limits<float>::infinity());
  const Vector3 no_lamps{all(0.0f), all(0.0f), all(0.0f)};
  return {towards, all(tables.sun), far, dot(surface.flat, towards), all(0.0f), no_lamps, no_lamps};
}

/// Sodium light is orange, LEDs are white: between them.
PANVO_INLINE Vector3 lamp_colour(const Float& brightness) {
  return {1.12f * brightness, 0.98f * brightness, 0.72f * brightness};
}

/// Radiance of a white surface perpendicular to the light of a lamp. `way`: from the surface to the lamp.
PANVO_INLINE Float light_of(const LampRecord& lamp, const Vector3& way, const Float& square) {
  const Float downwards = clamped(way.z * (1.0f / root(square)), 0.0f, 1.0f);
  const Float share = square * (1.0f / (kLampReach_m * kLampReach_m));
  const Float fade = maximum(1.0f - share * share, all(0.0f));  // reaches nothing smoothly
  return lamp.intensity * (lamp.sideways + (1.0f - lamp.sideways) * downwards) * fade * (1.0f / square);
}

PANVO_INLINE DirectLight lamplight(const ShadingTables& tables, const Hit& hit, const Surface& surface,
                                   const Water& water) {
  constexpr float kHousing_m = 0.7f;  // a lamp's own head and post cast no shadow
  DirectLight light = sunlight(tables, surface);
  Float brightest = all(0.0f), sum = all(0.0f), glints = all(0.0f), own_glint = all(0.0f);
  for (std::uint32_t i = 0; i < tables.lamp_count; ++i) {
    const LampRecord& lamp = tables.lamps[i];
    const Vector3 way{lamp.x - hit.point.x, lamp.y - hit.point.y, lamp.z - hit.point.z};
    const Float square = maximum(dot(way, way), all(0.25f));
    if (!any((square < kLampReach_m * kLampReach_m) & hit.is_hit)) continue;
    const Vector3 towards = (1.0f / root(square)) * way;
    const Float received = light_of(lamp, way, square);
    const Float lit = maximum(dot(surface.normal, towards), all(0.0f)) * received;
    const Int is_brighter = lit > brightest;
    sum = sum + lit;
    brightest = choose(is_brighter, lit, brightest);
    light.towards = choose(is_brighter, towards, light.towards);
    light.colour = choose(is_brighter, lamp_colour(received), light.colour);
    light.reach = choose(is_brighter, maximum(root(square) - kHousing_m, all(0.01f)), light.reach);
    if (!tables.has_water) continue;
    const Float glint = glint_of(water, surface.normal, hit.direction, towards);
    glints = glints + glint * received;
    own_glint = choose(is_brighter, glint * received, own_glint);
    light.glint = choose(is_brighter, glint, light.glint);
  }
  light.flat_facing = dot(surface.flat, light.towards);
  light.other_lamps = lamp_colour(sum - brightest);
  light.other_glints = lamp_colour(maximum(glints - own_glint, all(0.0f)));
  return light;
}

/// What shines by itself: lamp heads, and windows of lit rooms.
PANVO_INLINE Vector3 shine_of(const ShadingTables& tables, const Hit& hit, const Look& look) {
  constexpr float kRoom_m = 4.0f, kStorey_m = 3.0f;
  constexpr std::uint32_t kLitShare = 0x4800u;  // of 0x10000
  const auto cell = [](const Float& value, float size) PANVO_ALWAYS { return floored((1.0f / size) * value); };
  const Word mixed = scrambled(cell(hit.point.x, kRoom_m), cell(hit.point.y, kRoom_m), cell(hit.point.z, kStorey_m),
                               tables.evening);
  const Int is_dark = ((Int)(look.flags & kIsWindow) != 0) & ((Int)(mixed >> 16) >= (std::int32_t)kLitShare);
  const Float shine = gather((const float*)tables.materials + 14, look.material_words);
  const Float varied = shine * (0.6f + (0.8f / 255.0f) * to_float((Int)(mixed & 0xffu)));
  return lamp_colour(choose(is_dark, all(0.0f), varied));
}

/// The light that leaves the surface: sky and ground as far as visible, direct light from the front or through a leaf.
struct Radiance {
  Vector3 base, sun;
  Float direct;  ///< share of the direct light, unless in shadow
  Reflectance mirror;  ///< of wet ground, behind haze
};

PANVO_INLINE Radiance radiance_of(const ShadingTables& tables, const Hit& hit, const Surface& surface, const Look& look,
                                  const Water& water, const Vector3& albedo, const DirectLight& light) {
  const auto* numbers = (const float*)tables.materials;
  const Vector3& normal = surface.normal;
  const Float upwards = 0.5f + 0.5f * normal.z;
  Vector3 indirect = look.open * (upwards * all(tables.sky) + (1.0f - upwards) * all(tables.ground));
  if (tables.lamp_count > 0) indirect = indirect + light.other_lamps;
  const Float translucency = gather(numbers + 11, look.material_words);
  const Float facing = dot(normal, light.towards);
  Radiance radiance;
  radiance.direct = choose(facing > 0.0f, (1.0f - translucency) * facing, -translucency * facing);
  radiance.direct = choose((light.flat_facing > 0.0f) | (translucency > 0.0f), radiance.direct, all(0.0f));
  radiance.base = albedo * indirect;
  radiance.sun = radiance.direct * (albedo * light.colour);

  const Float gloss = gather(numbers + 10, look.material_words);
  if (any((gloss > 0.0f) & hit.is_hit)) {
    const Float cosine = clamped(-dot(normal, hit.direction), 0.0f, 1.0f);
    const Float mirrored = choose(gloss > 0.0f, fresnel(gloss, cosine), all(0.0f));
    const Vector3 seen = seen_in_mirror(tables, hit.direction + (2.0f * cosine) * normal);
    radiance.base = (1.0f - mirrored) * radiance.base + (mirrored * look.open) * seen;
    radiance.sun = (1.0f - mirrored) * radiance.sun;
  }
  if (tables.lamp_count > 0) radiance.base = radiance.base + shine_of(tables, hit, look);
  radiance.mirror = {all(0.0f), all(0.0f), all(0.0f)};
  if (tables.has_water) {
    const Float cosine = clamped(-dot(normal, hit.direction), 0.0f, 1.0f);
    radiance.mirror = reflectance_of(water, cosine);
    const Float left = 1.0f - radiance.mirror.of_puddle - radiance.mirror.of_film - radiance.mirror.blurred;
    const Vector3 seen = seen_in_mirror(tables, hit.direction + (2.0f * cosine) * normal);
    radiance.base = left * radiance.base + (radiance.mirror.blurred * look.open) * seen + light.other_glints;
    radiance.sun = left * radiance.sun + light.glint * light.colour;
  }
  const Float clear = rough_exp2(maximum(hit.distance * (-1.442695f * tables.haze_per_m), all(-100.0f)));
  radiance.base = clear * radiance.base + (1.0f - clear) * all(tables.haze);
  radiance.sun = clear * radiance.sun;
  radiance.mirror.of_puddle = clear * radiance.mirror.of_puddle;
  radiance.mirror.of_film = clear * radiance.mirror.of_film;
  return radiance;
}

PANVO_INLINE void store_shadow_rays(const Hit& hit, const Surface& surface, const DirectLight& light,
                                    RTCRay16& shadow) {
  const Float offset = 1e-3f + 2e-4f * hit.distance;
  const Vector3 above = hit.point + choose(light.flat_facing > 0.0f, offset, -offset) * surface.flat;
  store(shadow.org_x, above.x);
  store(shadow.org_y, above.y);
  store(shadow.org_z, above.z);
  store(shadow.dir_x, light.towards.x);
  store(shadow.dir_y, light.towards.y);
  store(shadow.dir_z, light.towards.z);
  store(shadow.tnear, all(0.0f));
  store(shadow.tfar, light.reach);
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
  Water water{all(0.0f), all(0.0f)};
  if (tables.has_water) {
    water = water_on(tables, hit, surface.normal, look.material_words);
    albedo = under_water(water, albedo);
  }
  const DirectLight light = tables.lamp_count > 0 ? lamplight(tables, hit, surface, water) : sunlight(tables, surface);
  const Radiance radiance = radiance_of(tables, hit, surface, look, water, albedo, light);

  store3(shaded.base, radiance.base);
  store3(shaded.sun, radiance.sun);
  const Int wants_shadow = (radiance.direct > 0.0f) & hit.is_hit;
  store(shaded.wants_shadow, wants_shadow);
  store_shadow_rays(hit, surface, light, shaded.shadow);
  store(shaded.key, ((hit.object << 8) | look.material) + 1u);
  const auto byte = [](const Float& value) PANVO_ALWAYS { return (Word)truncated(value * 127.0f) & 0xffu; };
  const Vector3& normal = surface.normal;
  store(shaded.normal, byte(normal.x) | byte(normal.y) << 8 | byte(normal.z) << 16 | look.flags << 24);
  if (tables.has_water) store_mirror_rays(traced, hit, surface, radiance.mirror, shaded);
}
