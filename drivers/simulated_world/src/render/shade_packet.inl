// SPDX-License-Identifier: Apache-2.0
// Shades sixteen hits. Included once per instruction set; see packet_math.inl.

/// A position on a texture with the pixel's footprint, in periods.
struct Footprint {
  Float u, v;
  Float ux, uy, vx, vy, mx, my;  ///< steps along image columns and rows, and while the shutter is open
};

PANVO_INLINE Vector3 texel(const std::uint32_t* texels, const Word& index) {
  const Word bits = gather(texels, index);
  const Float red = to_float((Int)(bits & 0xffu));
  const Float green = to_float((Int)((bits >> 8) & 0xffu));
  const Float blue = to_float((Int)((bits >> 16) & 0xffu));
  return {red * red, green * green, blue * blue};
}

/// The colour times 255^2.
PANVO_INLINE Vector3 bilinear(const std::uint32_t* texels, const Word& offset, const Word& log2_width,
                              const Word& log2_height, const Float& u, const Float& v) {
  const Word width = all_word(1) << log2_width;
  const Word height = all_word(1) << log2_height;
  const Float x = u * to_float((Int)width) - 0.5f;
  const Float y = v * to_float((Int)height) - 0.5f;
  const Int column = floored(x);
  const Int row = floored(y);
  const Float right = x - to_float(column);
  const Float low = y - to_float(row);
  // texels are stored in tiles of 4 x 4, one cache line each, if the level is large enough
  const Word tile = (Word)((log2_width > 1u) & (log2_height > 1u)) & 2u;
  const Word inside = (all_word(1) << tile) - 1u;
  const auto column_part = [&](const Word& at) PANVO_ALWAYS { return ((at >> tile) << (tile + tile)) + (at & inside); };
  const auto row_part = [&](const Word& at) PANVO_ALWAYS {
    return offset + ((at >> tile) << (log2_width + tile)) + ((at & inside) << tile);
  };
  const Word left_index = column_part((Word)column & (width - 1));
  const Word right_index = column_part((Word)(column + 1) & (width - 1));
  const Word upper = row_part((Word)row & (height - 1));
  const Word lower = row_part((Word)(row + 1) & (height - 1));
  const Vector3 upper_left = texel(texels, upper + left_index);
  const Vector3 lower_left = texel(texels, lower + left_index);
  const Vector3 up = upper_left + right * (texel(texels, upper + right_index) - upper_left);
  const Vector3 down = lower_left + right * (texel(texels, lower + right_index) - lower_left);
  return up + low * (down - up);
}

/// The colour averaged over the footprint, an ellipse whose squared half axes are the eigenvalues of J J': trilinear,
/// with a number of probes along the longer axis that depends on its length.
PANVO_INLINE Vector3 sample(const ShadingTables& tables, const Word& texture, const Footprint& at, int taps) {
  const auto* records = &tables.textures->log2_width;
  const Word record = texture * (std::uint32_t)(sizeof(TextureRecord) / 4);
  const Word log2_width = gather(records, record);
  const Word log2_height = gather(records + 1, record);
  const Float last_level = to_float((Int)gather(records + 2, record));
  const Float width = to_float((Int)(all_word(1) << log2_width));
  const Float height = to_float((Int)(all_word(1) << log2_height));
  const Float xx = (at.ux * at.ux + at.vx * at.vx + at.mx * at.mx) * width * width;
  const Float yy = (at.uy * at.uy + at.vy * at.vy + at.my * at.my) * height * height;
  const Float xy = (at.ux * at.uy + at.vx * at.vy + at.mx * at.my) * width * height;
  const Float middle = 0.5f * (xx + yy);
  const Float half_difference = 0.5f * (xx - yy);
  const Float spread = root(half_difference * half_difference + xy * xy);
  const Float longer = minimum(all(1e12f), middle + spread);
  const Float shorter = maximum(all(1e-6f), middle - spread);
  const Float ratio = root(maximum(longer, all(1.0f)) / maximum(shorter, all(1.0f)));
  const Float probes = to_float(truncated(minimum(ratio + 0.99f, all((float)taps))));
  const Float one_probe = maximum(shorter, longer / (probes * probes));
  const Float detail = minimum(maximum(0.5f * rough_log2(maximum(all(1.0f), one_probe)), all(0.0f)), last_level);
  // two levels are mixed only about half way between them; elsewhere only the nearer one is fetched
  const Float below = to_float(truncated(detail));
  const Float mixed = clamped((detail - below - 0.3f) * 2.5f, 0.0f, 1.0f);
  const Int is_coarse = mixed >= 1.0f;
  const Int fine = truncated(choose(is_coarse, minimum(below + 1.0f, last_level), below));
  const Int coarse = truncated(minimum(below + 1.0f, last_level));
  const Float coarse_share = choose(is_coarse, all(0.0f), mixed);
  const bool has_two = any(coarse_share > 0.0f);
  const Word fine_offset = gather(records + 4, record + (Word)fine);
  const Word coarse_offset = gather(records + 4, record + (Word)coarse);
  const auto at_level = [](const Word& log2_size, const Int& level) PANVO_ALWAYS {
    const Int left = (Int)log2_size - level;
    return (Word)(left & (left > 0));
  };
  const Word fine_width = at_level(log2_width, fine), fine_height = at_level(log2_height, fine);
  const Word coarse_width = at_level(log2_width, coarse), coarse_height = at_level(log2_height, coarse);

  // the longer axis: the form of the eigenvector without cancellation
  const Int is_wide = half_difference >= 0.0f;
  const Float axis_x = choose(is_wide, half_difference + spread, xy);
  const Float axis_y = choose(is_wide, xy, spread - half_difference);
  const Float scale = root(longer / maximum(axis_x * axis_x + axis_y * axis_y, all(1e-20f))) / probes;
  const Float step_u = axis_x * scale / width;
  const Float step_v = axis_y * scale / height;
  const Float first = 0.5f - 0.5f * probes;
  Vector3 sum{all(0.0f), all(0.0f), all(0.0f)};
  for (int probe = 0; probe < taps; ++probe) {
    const Int counts = all((float)probe) < probes;
    if (!any(counts)) break;
    const Float along = first + (float)probe;
    const Float u = at.u + along * step_u;
    const Float v = at.v + along * step_v;
    const Vector3 sharp = bilinear(tables.texels, fine_offset, fine_width, fine_height, u, v);
    Vector3 colour = sharp;
    if (has_two) {
      const Vector3 soft = bilinear(tables.texels, coarse_offset, coarse_width, coarse_height, u, v);
      colour = sharp + coarse_share * (soft - sharp);
    }
    sum = sum + choose(counts, colour, {all(0.0f), all(0.0f), all(0.0f)});
  }
  return (1.0f / (65025.0f * probes)) * sum;
}

/// Mirrors and rotates each period randomly.
PANVO_INLINE void scatter(const Int& mask, Footprint& at) {
  const Int column = floored(at.u);
  const Int row = floored(at.v);
  Word hash = (Word)column * 0x9e3779b1u ^ (Word)row * 0x85ebca77u;
  hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
  hash = hash ^ (hash >> 13);
  const Int flips_u = ((Int)(hash << 31) < 0) & mask;
  const Int flips_v = ((Int)(hash << 30) < 0) & mask;
  const Int turns = ((Int)(hash << 29) < 0) & mask;
  const Float u = at.u - to_float(column);
  const Float v = at.v - to_float(row);
  const Float x = choose(flips_u, 1.0f - u, u);
  const Float y = choose(flips_v, 1.0f - v, v);
  at.u = choose(turns, y, x);
  at.v = choose(turns, x, y);
  // signs are ignored: for a coarse overlay, only the footprint's size matters
  const auto turn = [&](Float& a, Float& b) PANVO_ALWAYS {
    const Float was = a;
    a = choose(turns, b, a);
    b = choose(turns, was, b);
  };
  turn(at.ux, at.uy);
  turn(at.vx, at.vy);
  turn(at.mx, at.my);
}

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

void shade_packet(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded) {
  const auto& rays = traced.rays.ray;
  const auto& hits = traced.rays.hit;
  const Vector3 origin{load<Float>(rays.org_x), load<Float>(rays.org_y), load<Float>(rays.org_z)};
  const Vector3 direction{load<Float>(rays.dir_x), load<Float>(rays.dir_y), load<Float>(rays.dir_z)};
  const Float time = load<Float>(rays.time);
  const Word geometry = load<Word>(hits.geomID);
  const Int is_hit = geometry != RTC_INVALID_GEOMETRY_ID;
  const Float distance = choose(is_hit, load<Float>(rays.tfar), all(1.0f));
  const Float second = load<Float>(hits.u);
  const Float third = load<Float>(hits.v);
  const Float first = 1.0f - second - third;

  // the object of the surface
  const Word instance = load<Word>(hits.instID[0]);
  const Int is_fixed = instance == RTC_INVALID_GEOMETRY_ID;
  Word object = (Word)(is_fixed ? (Int)(geometry >> 1) : (Int)instance);
  object = object + ((Word)load<Int>(traced.is_moving) & all_word(tables.first_moving_object));
  object = object & (Word)is_hit;
  const Word object_index = object * (std::uint32_t)(sizeof(ObjectRecord) / 4);
  const auto* object_words = (const std::uint32_t*)tables.objects;
  const auto* object_numbers = (const float*)tables.objects;
  const Word first_surface = gather(object_words, object_index + (geometry & 1u & (Word)is_hit));
  const Word surface = (first_surface + (load<Word>(hits.primID) & (Word)is_hit)) * 16u;
  const auto* surface_words = (const std::uint32_t*)tables.surfaces;
  const auto* surface_numbers = (const float*)tables.surfaces;

  Vector3 flat{load<Float>(hits.Ng_x), load<Float>(hits.Ng_y), load<Float>(hits.Ng_z)};
  Vector3 normal = first * unpacked_normal(gather(surface_words, surface)) +
                   second * unpacked_normal(gather(surface_words + 1, surface)) +
                   third * unpacked_normal(gather(surface_words + 2, surface));
  const Word gradient_0 = gather(surface_words + 13, surface);
  const Word gradient_1 = gather(surface_words + 14, surface);
  const Word gradient_2 = gather(surface_words + 15, surface);
  Vector3 u_gradient{bits_of(gradient_0 << 16), bits_of(gradient_0 & 0xffff0000u), bits_of(gradient_1 << 16)};
  Vector3 v_gradient{bits_of(gradient_1 & 0xffff0000u), bits_of(gradient_2 << 16), bits_of(gradient_2 & 0xffff0000u)};
  const Vector3 point = origin + distance * direction;
  const float share = traced.motion_share;
  const auto& turn = tables.camera_rotation;
  Vector3 motion = all(tables.camera_motion) +
                   distance * Vector3{turn[0] * direction.x + turn[1] * direction.y + turn[2] * direction.z,
                                      turn[3] * direction.x + turn[4] * direction.y + turn[5] * direction.z,
                                      turn[6] * direction.x + turn[7] * direction.y + turn[8] * direction.z};
  Vector3 object_tint{all(1.0f), all(1.0f), all(1.0f)};

  const Int is_instance = ~is_fixed & is_hit;  // a mover; standing models are copies, not instances
  const Int is_placed = ((Int)gather(object_words + 30, object_index) != 0) & is_hit;
  if (any(is_placed)) {
    const Int moves = (Int)gather(object_words + 29, object_index) != 0;
    Vector3 axis_x = gather3(object_numbers + 2, object_index);
    Vector3 axis_y = gather3(object_numbers + 5, object_index);
    Vector3 axis_z = gather3(object_numbers + 8, object_index);
    if (any(moves & is_placed)) {
      const Vector3 moved_x = gather3(object_numbers + 14, object_index);
      const Vector3 moved_y = gather3(object_numbers + 17, object_index);
      const Vector3 moved_z = gather3(object_numbers + 20, object_index);
      axis_x = axis_x + time * moved_x;
      axis_y = axis_y + time * moved_y;
      axis_z = axis_z + time * moved_z;
      const Vector3 place =
          gather3(object_numbers + 11, object_index) + time * gather3(object_numbers + 23, object_index);
      const Vector3 from_foot = (1.0f / dot(axis_x, axis_x)) * (point - place);
      const Vector3 own = gather3(object_numbers + 23, object_index) + dot(axis_x, from_foot) * moved_x +
                          dot(axis_y, from_foot) * moved_y + dot(axis_z, from_foot) * moved_z;
      motion = choose(moves & is_placed, motion - own, motion);
    }
    const auto turned = [&](const Int& which, const Vector3& vector) PANVO_ALWAYS {
      return choose(which, vector.x * axis_x + vector.y * axis_y + vector.z * axis_z, vector);
    };
    flat = turned(is_instance, flat);
    normal = turned(is_placed, normal);
    const Float shrunk = 1.0f / choose(is_placed, dot(axis_x, axis_x), all(1.0f));
    u_gradient = shrunk * turned(is_placed, u_gradient);
    v_gradient = shrunk * turned(is_placed, v_gradient);
    object_tint = gather3(object_numbers + 26, object_index);
  }
  flat = normalized(flat);
  normal = normalized(normal);
  flat = choose(dot(flat, direction) > 0.0f, all(-1.0f) * flat, flat);  // surfaces are two-sided
  normal = choose(dot(normal, flat) < 0.0f, all(-1.0f) * normal, normal);

  // material, tint and ambient light
  const Word material_light = gather(surface_words + 12, surface);
  const Word material = material_light & 0xffu;
  const Word material_index = material * 16u;
  const auto* material_words = (const std::uint32_t*)tables.materials;
  const auto* material_numbers = (const float*)tables.materials;
  const Word flags = gather(material_words + 12, material_index);
  const auto interpolated = [&](const Word& a, const Word& b, const Word& c) PANVO_ALWAYS {
    const Float value =
        first * to_float((Int)(a & 0xffu)) + second * to_float((Int)(b & 0xffu)) + third * to_float((Int)(c & 0xffu));
    return clamped((1.0f / 255.0f) * value, 0.0f, 1.0f);  // a card's fourth corner is extrapolated
  };
  const auto corner_light = [&](int bit) PANVO_ALWAYS { return to_float((Int)((material_light >> bit) & 0x3fu)); };
  const Float open =
      (1.0f / 63.0f) * ((1.0f - third) * ((1.0f - second) * corner_light(8) + second * corner_light(14)) +
                        third * ((1.0f - second) * corner_light(20) + second * corner_light(26)));
  const Word tint_0 = gather(surface_words + 9, surface);
  const Word tint_1 = gather(surface_words + 10, surface);
  const Word tint_2 = gather(surface_words + 11, surface);
  const Vector3 tint{interpolated(tint_0, tint_1, tint_2), interpolated(tint_0 >> 8, tint_1 >> 8, tint_2 >> 8),
                     interpolated(tint_0 >> 16, tint_1 >> 16, tint_2 >> 16)};
  const Float contrast = interpolated(tint_0 >> 24, tint_1 >> 24, tint_2 >> 24);

  // the pixel's footprint on the texture: the rays of its neighbours and its own later ray, intersected with the
  // surface's plane
  const Float slope = minimum(dot(direction, flat), all(-0.02f));
  const Float per_slope = 1.0f / slope;
  const auto on_plane = [&](const Vector3& change)
                            PANVO_ALWAYS { return change - (dot(change, flat) * per_slope) * direction; };
  const Vector3 across = on_plane(distance * load3(traced.across));
  const Vector3 down = on_plane(distance * load3(traced.down));
  const Vector3 moved = all(share) * on_plane(motion);
  Footprint metres{gather(surface_numbers + 3, surface) + second * gather(surface_numbers + 5, surface) +
                       third * gather(surface_numbers + 7, surface),
                   gather(surface_numbers + 4, surface) + second * gather(surface_numbers + 6, surface) +
                       third * gather(surface_numbers + 8, surface),
                   dot(u_gradient, across),
                   dot(v_gradient, across),
                   dot(u_gradient, down),
                   dot(v_gradient, down),
                   dot(u_gradient, moved),
                   dot(v_gradient, moved)};
  const auto in_periods = [&](const Float& s) PANVO_ALWAYS {
    return Footprint{metres.u * s,  metres.v * s,  metres.ux * s, metres.uy * s,
                     metres.vx * s, metres.vy * s, metres.mx * s, metres.my * s};
  };
  Footprint place = in_periods(gather(material_numbers + 8, material_index));
  place.u = place.u - to_float(floored(place.u));  // keeps texel indices small and exact
  place.v = place.v - to_float(floored(place.v));
  const Vector3 mean = gather3(material_numbers + 4, material_index);
  const Vector3 colour = sample(tables, gather(material_words + 3, material_index), place, tables.texture_taps);
  Vector3 albedo = (mean + contrast * (colour - mean)) * tint * gather3(material_numbers, material_index);
  const Int takes_tint = (Int)(flags & kTakesObjectTint) != 0;
  albedo = choose(takes_tint, albedo * object_tint, albedo);
  const Int has_overlay = (Int)(flags & kHasOverlay) != 0;
  if (any(has_overlay & is_hit)) {
    Footprint overlay_place = in_periods(gather(material_numbers + 9, material_index));
    scatter((Int)(flags & kOverlayIsScattered) != 0, overlay_place);
    const Vector3 overlay = sample(tables, gather(material_words + 7, material_index), overlay_place, 2);
    albedo = choose(has_overlay, all(2.0f) * (overlay * albedo), albedo);
  }

  // light: sky and ground as far as visible, sun from the front or through a leaf
  const Vector3 to_sun = all(tables.to_sun);
  const Float upwards = 0.5f + 0.5f * normal.z;
  const Vector3 indirect = open * (upwards * all(tables.sky) + (1.0f - upwards) * all(tables.ground));
  const Float translucency = gather(material_numbers + 11, material_index);
  const Float facing = dot(normal, to_sun);
  Float direct = choose(facing > 0.0f, (1.0f - translucency) * facing, -translucency * facing);
  const Float flat_facing = dot(flat, to_sun);
  direct = choose((flat_facing > 0.0f) | (translucency > 0.0f), direct, all(0.0f));
  Vector3 base = albedo * indirect;
  Vector3 sun = direct * (albedo * all(tables.sun));

  const Float gloss = gather(material_numbers + 10, material_index);
  if (any((gloss > 0.0f) & is_hit)) {
    const Float cosine = clamped(-dot(normal, direction), 0.0f, 1.0f);
    const Float rest = 1.0f - cosine;
    const Float mirrored =
        choose(gloss > 0.0f, gloss + (1.0f - gloss) * (rest * rest) * (rest * rest) * rest, all(0.0f));
    const Vector3 seen = seen_in_mirror(tables, direction + (2.0f * cosine) * normal);
    base = (1.0f - mirrored) * base + (mirrored * open) * seen;
    sun = (1.0f - mirrored) * sun;
  }
  const Float clear = rough_exp2(maximum(distance * (-1.442695f * tables.haze_per_m), all(-100.0f)));
  base = clear * base + (1.0f - clear) * all(tables.haze);
  sun = clear * sun;

  store3(shaded.base, base);
  store3(shaded.sun, sun);
  const Int wants_shadow = (direct > 0.0f) & is_hit;
  store(shaded.wants_shadow, wants_shadow);
  const Float offset = 1e-3f + 2e-4f * distance;
  const Vector3 above = point + choose(flat_facing > 0.0f, offset, -offset) * flat;
  auto& shadow = shaded.shadow;
  store(shadow.org_x, above.x);
  store(shadow.org_y, above.y);
  store(shadow.org_z, above.z);
  store(shadow.dir_x, to_sun.x);
  store(shadow.dir_y, to_sun.y);
  store(shadow.dir_z, to_sun.z);
  store(shadow.tnear, all(0.0f));
  store(shadow.tfar, all(std::numeric_limits<float>::infinity()));
  store(shadow.time, time);
  store(shadow.mask, all_word(kToShadow));
  store(shadow.flags, all_word(0));
  store(shaded.key, ((object << 8) | material) + 1u);
  const auto byte = [](const Float& value) PANVO_ALWAYS { return (Word)truncated(value * 127.0f) & 0xffu; };
  store(shaded.normal, byte(normal.x) | byte(normal.y) << 8 | byte(normal.z) << 16 | flags << 24);
}
