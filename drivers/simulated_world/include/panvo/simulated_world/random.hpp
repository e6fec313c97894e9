// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace panvo::simulated_world {

/// Mixes 64 bits thoroughly (the finaliser of SplitMix64, Steele et al. 2014): a hash of `value`.
constexpr std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

/// Random numbers for one purpose. The same seed and purpose give the same numbers on every machine and with every
/// standard library, independently of other purposes.
class Random {
 public:
  constexpr Random(std::uint64_t seed, std::string_view purpose) : state_(mix(seed)) {
    for (const char letter : purpose) state_ = mix(state_ ^ static_cast<unsigned char>(letter));
  }

  /// Random numbers for part `index` of this purpose, independent of how many were drawn from other parts.
  constexpr Random part(std::uint64_t index) const {
    Random random = *this;
    random.state_ = mix(state_ + mix(index + 1));
    return random;
  }

  constexpr std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }

  /// In [0, 1).
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In {0, ..., count - 1}; count > 0.
  constexpr int below(int count) { return static_cast<int>(uniform() * count); }
  constexpr bool chance(double probability) { return uniform() < probability; }
  /// Normal, mean 0, deviation 1 (Box and Muller 1958).
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace panvo::simulated_world
