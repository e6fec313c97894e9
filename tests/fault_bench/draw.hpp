// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <string_view>

namespace panvo::test {

/// Random numbers that depend only on seed and name, not on the compiler, unlike the distributions of the standard
/// library.
class Draw {
 public:
  Draw(std::uint64_t seed, std::string_view name) : engine_(mix(seed, name)) {}

  double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int integer(int from, int below) { return static_cast<int>(uniform(from, below)); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  std::uint64_t seed() { return engine_(); }

  /// Generator for image noise.
  cv::RNG image_noise() { return cv::RNG(engine_()); }

 private:
  static std::uint64_t mix(std::uint64_t seed, std::string_view name) {
    std::uint64_t mixed = 0xcbf29ce484222325U ^ (seed * 0x9e3779b97f4a7c15U);
    for (const char letter : name) mixed = (mixed ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    return mixed;
  }

  std::mt19937_64 engine_;
};

}  // namespace panvo::test
