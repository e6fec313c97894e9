// SPDX-License-Identifier: Apache-2.0
// Arithmetic on sixteen rays at a time. Included once per instruction set, in its own namespace and under "#pragma GCC
// target", so that the compiler uses that instruction set for the vector types. PANVO_PACKET_ISA is 512 for AVX-512, 2
// for AVX2, else 0, because the compiler's own macros do not follow the pragma. No includes here.

#define PANVO_ALWAYS __attribute__((always_inline))
#define PANVO_INLINE inline PANVO_ALWAYS

using Float = float __attribute__((vector_size(64)));
using Int = std::int32_t __attribute__((vector_size(64)));
using Word = std::uint32_t __attribute__((vector_size(64)));

PANVO_INLINE Float all(float value) { return Float{} + value; }
PANVO_INLINE Int all_int(std::int32_t value) { return Int{} + value; }
PANVO_INLINE Word all_word(std::uint32_t value) { return Word{} + value; }

template <typename Vector, typename Element>
PANVO_INLINE Vector load(const Element* from) {
  Vector value;
  __builtin_memcpy(&value, from, sizeof(value));
  return value;
}
template <typename Vector, typename Element>
PANVO_INLINE void store(Element* to, const Vector& value) {
  __builtin_memcpy(to, &value, sizeof(value));
}

PANVO_INLINE Float to_float(const Int& value) { return __builtin_convertvector(value, Float); }
PANVO_INLINE Int truncated(const Float& value) { return __builtin_convertvector(value, Int); }
PANVO_INLINE Float bits_of(const Word& value) { return (Float)value; }
PANVO_INLINE Word bits_of(const Float& value) { return (Word)value; }
PANVO_INLINE Float choose(const Int& mask, const Float& then, const Float& otherwise) {
  return mask ? then : otherwise;
}

#if PANVO_PACKET_ISA == 2
struct FloatHalves {
  __m256 low, high;
};
struct IntHalves {
  __m256i low, high;
};
#endif

PANVO_INLINE Float minimum(const Float& a, const Float& b) {
#if PANVO_PACKET_ISA == 512
  return (Float)_mm512_maskz_min_ps(0xffff, (__m512)a, (__m512)b);
#else
  return a < b ? a : b;
#endif
}
PANVO_INLINE Float maximum(const Float& a, const Float& b) {
#if PANVO_PACKET_ISA == 512
  return (Float)_mm512_maskz_max_ps(0xffff, (__m512)a, (__m512)b);
#else
  return a > b ? a : b;
#endif
}
PANVO_INLINE Float clamped(const Float& value, float low, float high) {
  return minimum(maximum(value, all(low)), all(high));
}
PANVO_INLINE Float absolute(const Float& value) { return bits_of(bits_of(value) & 0x7fffffffu); }

PANVO_INLINE Float root(const Float& value) {
#if PANVO_PACKET_ISA == 512
  return (Float)_mm512_maskz_sqrt_ps(0xffff, (__m512)value);
#elif PANVO_PACKET_ISA == 2
  const auto halves = __builtin_bit_cast(FloatHalves, value);
  return __builtin_bit_cast(Float, FloatHalves{_mm256_sqrt_ps(halves.low), _mm256_sqrt_ps(halves.high)});
#else
  Float result;
  for (int i = 0; i < 16; ++i) result[i] = __builtin_sqrtf(value[i]);
  return result;
#endif
}

PANVO_INLINE bool any(const Int& mask) {
#if PANVO_PACKET_ISA == 512
  return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#else
  std::int32_t found = 0;
  for (int i = 0; i < 16; ++i) found |= mask[i];
  return found != 0;
#endif
}

PANVO_INLINE Word gather(const std::uint32_t* from, const Word& index) {
#if PANVO_PACKET_ISA == 512
  return (Word)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index, from, 4);
#elif PANVO_PACKET_ISA == 2
  const auto at = __builtin_bit_cast(IntHalves, index);
  const auto* base = (const int*)from;
  return __builtin_bit_cast(
      Word, IntHalves{_mm256_i32gather_epi32(base, at.low, 4), _mm256_i32gather_epi32(base, at.high, 4)});
#else
  Word result;
  for (int i = 0; i < 16; ++i) result[i] = from[index[i]];
  return result;
#endif
}
PANVO_INLINE Float gather(const float* from, const Word& index) {
  return bits_of(gather((const std::uint32_t*)from, index));
}

/// Largest whole number not above `value`; |value| < 2^31. Lanes that hit nothing may hold anything: they wrap around.
PANVO_INLINE Int floored(const Float& value) {
  const Int whole = truncated(value);
  return (Int)((Word)whole + (Word)(to_float(whole) > value));  // a true comparison is -1
}

/// log2 to 0.01: enough to choose a level of detail.
PANVO_INLINE Float rough_log2(const Float& value) {
  const Word bits = bits_of(value);
  const Float exponent = to_float((Int)(bits >> 23) - 127);
  const Float mantissa = bits_of((bits & 0x007fffffu) | 0x3f800000u);
  return exponent + (-0.33582878f * mantissa + 2.0f) * mantissa - 1.65871f;
}

/// 2^value to 2e-4; value in [-120, 0].
PANVO_INLINE Float rough_exp2(const Float& value) {
  const Int whole = floored(value);
  const Float part = value - to_float(whole);
  const Float mantissa = 1.0f + part * (0.6957f + part * (0.2251f + part * 0.0792f));
  return mantissa * bits_of((Word)(whole + 127) << 23);
}

/// A random number of 32 bits from a cell of a grid and a seed.
PANVO_INLINE Word scrambled(const Int& x, const Int& y, const Int& z, std::uint32_t seed) {
  Word mixed = (Word)x * 0x9e3779b1u + (Word)y * 0x85ebca77u + (Word)z * 0xc2b2ae3du + seed;
  mixed = (mixed ^ (mixed >> 15)) * 0x2c1b3c6du;
  return (mixed ^ (mixed >> 12)) * 0x297a2d39u;
}

/// Share of the light that a smooth surface reflects, given that at normal incidence [Schlick 1994].
PANVO_INLINE Float fresnel(const Float& at_normal, const Float& cosine) {
  const Float rest = 1.0f - cosine;
  return at_normal + (1.0f - at_normal) * (rest * rest) * (rest * rest) * rest;
}

struct Vector3 {
  Float x, y, z;
};
PANVO_INLINE Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
PANVO_INLINE Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
PANVO_INLINE Vector3 operator*(const Float& s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
PANVO_INLINE Vector3 operator*(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
PANVO_INLINE Float dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
PANVO_INLINE Vector3 normalized(const Vector3& a) { return (1.0f / root(maximum(dot(a, a), all(1e-30f)))) * a; }
PANVO_INLINE Vector3 choose(const Int& mask, const Vector3& a, const Vector3& b) {
  return {choose(mask, a.x, b.x), choose(mask, a.y, b.y), choose(mask, a.z, b.z)};
}
PANVO_INLINE Vector3 all(const std::array<float, 3>& a) { return {all(a[0]), all(a[1]), all(a[2])}; }
PANVO_INLINE Vector3 load3(const float (*from)[16]) {
  return {load<Float>(from[0]), load<Float>(from[1]), load<Float>(from[2])};
}
PANVO_INLINE void store3(float (*to)[16], const Vector3& value) {
  store(to[0], value.x);
  store(to[1], value.y);
  store(to[2], value.z);
}
/// Three adjacent values of a table.
PANVO_INLINE Vector3 gather3(const float* from, const Word& index) {
  return {gather(from, index), gather(from + 1, index), gather(from + 2, index)};
}
