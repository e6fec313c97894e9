// SPDX-License-Identifier: Apache-2.0
// Sixteen hits and the surfaces there. Included once per instruction set, after packet_math.inl.

/// Unpacks octahedral normals.
PANVO_INLINE Vector3 unpacked_normal(const Word& packed) {
  const Float x = to_float((Int)(packed << 16) >> 16) * (1.0f / 32767.0f);
  const Float y = to_float((Int)packed >> 16) * (1.0f / 32767.0f);
  const Float z = 1.0f - absolute(x) - absolute(y);
  const Float over = maximum(-z, all(0.0f));
  return {x + choose(x >= 0.0f, -over, over), y + choose(y >= 0.0f, -over, over), z};
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
