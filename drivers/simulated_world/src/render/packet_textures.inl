// SPDX-License-Identifier: Apache-2.0
// Samples sixteen places on textures. Included once per instruction set; see packet_math.inl.

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
  const Word right_index = column_part(((Word)column + 1u) & (width - 1));
  const Word upper = row_part((Word)row & (height - 1));
  const Word lower = row_part(((Word)row + 1u) & (height - 1));
  const Vector3 upper_left = texel(texels, upper + left_index);
  const Vector3 lower_left = texel(texels, lower + left_index);
  const Vector3 up = upper_left + right * (texel(texels, upper + right_index) - upper_left);
  const Vector3 down = lower_left + right * (texel(texels, lower + right_index) - lower_left);
  return up + low * (down - up);
}

/// The probes whose mean is the colour over a footprint.
struct Probes {
  Float count;           ///< along the footprint's longer axis
  Float step_u, step_v;  ///< from one to the next, in periods
  Int fine, coarse;      ///< levels of the pyramid
  Float coarse_share;
};

/// The footprint is an ellipse whose squared half axes are the eigenvalues of J J': the shorter axis determines the
/// level, the longer one the number of probes.
PANVO_INLINE Probes probes_of(const Footprint& at, const Float& width, const Float& height, const Float& last_level,
                              int taps) {
  Probes probes;
  const Float xx = (at.ux * at.ux + at.vx * at.vx + at.mx * at.mx) * width * width;
  const Float yy = (at.uy * at.uy + at.vy * at.vy + at.my * at.my) * height * height;
  const Float xy = (at.ux * at.uy + at.vx * at.vy + at.mx * at.my) * width * height;
  const Float middle = 0.5f * (xx + yy);
  const Float half_difference = 0.5f * (xx - yy);
  const Float spread = root(half_difference * half_difference + xy * xy);
  const Float longer = minimum(all(1e12f), middle + spread);
  const Float shorter = maximum(all(1e-6f), middle - spread);
  const Float ratio = root(maximum(longer, all(1.0f)) / maximum(shorter, all(1.0f)));
  probes.count = to_float(truncated(minimum(ratio + 0.99f, all((float)taps))));
  const Float one_probe = maximum(shorter, longer / (probes.count * probes.count));
  const Float detail = minimum(maximum(0.5f * rough_log2(maximum(all(1.0f), one_probe)), all(0.0f)), last_level);
  // two levels are mixed only about half way between them; elsewhere only the nearer one is fetched
  const Float below = to_float(truncated(detail));
  const Float mixed = clamped((detail - below - 0.3f) * 2.5f, 0.0f, 1.0f);
  const Int is_coarse = mixed >= 1.0f;
  probes.fine = truncated(choose(is_coarse, minimum(below + 1.0f, last_level), below));
  probes.coarse = truncated(minimum(below + 1.0f, last_level));
  probes.coarse_share = choose(is_coarse, all(0.0f), mixed);
  // the longer axis: the form of the eigenvector without cancellation
  const Int is_wide = half_difference >= 0.0f;
  const Float axis_x = choose(is_wide, half_difference + spread, xy);
  const Float axis_y = choose(is_wide, xy, spread - half_difference);
  const Float scale = root(longer / maximum(axis_x * axis_x + axis_y * axis_y, all(1e-20f))) / probes.count;
  probes.step_u = axis_x * scale / width;
  probes.step_v = axis_y * scale / height;
  return probes;
}

/// The colour averaged over the footprint: trilinear, with up to `taps` probes.
PANVO_INLINE Vector3 sample(const ShadingTables& tables, const Word& texture, const Footprint& at, int taps) {
  const auto* records = &tables.textures->log2_width;
  const Word record = texture * (std::uint32_t)(sizeof(TextureRecord) / 4);
  const Word log2_width = gather(records, record);
  const Word log2_height = gather(records + 1, record);
  const Float last_level = to_float((Int)gather(records + 2, record));
  const Float width = to_float((Int)(all_word(1) << log2_width));
  const Float height = to_float((Int)(all_word(1) << log2_height));
  const Probes probes = probes_of(at, width, height, last_level, taps);
  const bool has_two = any(probes.coarse_share > 0.0f);
  const Word fine_offset = gather(records + 4, record + (Word)probes.fine);
  const Word coarse_offset = gather(records + 4, record + (Word)probes.coarse);
  const auto at_level = [](const Word& log2_size, const Int& level) PANVO_ALWAYS {
    const Int left = (Int)log2_size - level;
    return (Word)(left & (left > 0));
  };
  const Word fine_width = at_level(log2_width, probes.fine), fine_height = at_level(log2_height, probes.fine);
  const Word coarse_width = at_level(log2_width, probes.coarse), coarse_height = at_level(log2_height, probes.coarse);
  const Float first = 0.5f - 0.5f * probes.count;
  Vector3 sum{all(0.0f), all(0.0f), all(0.0f)};
  for (int probe = 0; probe < taps; ++probe) {
    const Int counts = all((float)probe) < probes.count;
    if (!any(counts)) break;
    const Float along = first + (float)probe;
    const Float u = at.u + along * probes.step_u;
    const Float v = at.v + along * probes.step_v;
    const Vector3 sharp = bilinear(tables.texels, fine_offset, fine_width, fine_height, u, v);
    Vector3 colour = sharp;
    if (has_two) {
      const Vector3 soft = bilinear(tables.texels, coarse_offset, coarse_width, coarse_height, u, v);
      colour = sharp + probes.coarse_share * (soft - sharp);
    }
    sum = sum + choose(counts, colour, {all(0.0f), all(0.0f), all(0.0f)});
  }
  return (1.0f / (65025.0f * probes.count)) * sum;
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
