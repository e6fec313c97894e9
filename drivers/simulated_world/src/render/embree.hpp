// SPDX-License-Identifier: Apache-2.0
#pragma once

// Embree 3 (Debian 12) and 4 (Debian 13), which names contexts otherwise.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace panvo::simulated_world {

/// Whether rays have similar origins and directions.
enum class Rays { kAnyDirection, kCoherent };

// Trace 16 rays, of the lanes that `valid` names by -1.
#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;

inline void init_context(RayContext& context) { rtcInitRayQueryContext(&context); }

inline RTCRayQueryFlags query_flags(Rays kind) {
  return kind == Rays::kCoherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
}

inline void intersect_16(const int* valid, RTCScene scene, RayContext& context, RTCRayHit16& rays, Rays kind) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = query_flags(kind);
  arguments.context = &context;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void occluded_16(const int* valid, RTCScene scene, RayContext& context, RTCRay16& rays, Rays kind) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = query_flags(kind);
  arguments.context = &context;
  rtcOccluded16(valid, scene, &rays, &arguments);
}
#else
using RayContext = RTCIntersectContext;

inline void init_context(RayContext& context) { rtcInitIntersectContext(&context); }

inline RTCIntersectContextFlags query_flags(Rays kind) {
  return kind == Rays::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

inline void intersect_16(const int* valid, RTCScene scene, RayContext& context, RTCRayHit16& rays, Rays kind) {
  context.flags = query_flags(kind);
  rtcIntersect16(valid, scene, &context, &rays);
}

inline void occluded_16(const int* valid, RTCScene scene, RayContext& context, RTCRay16& rays, Rays kind) {
  context.flags = query_flags(kind);
  rtcOccluded16(valid, scene, &context, &rays);
}
#endif

}  // namespace panvo::simulated_world
