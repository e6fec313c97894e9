// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace panvo::vision {

/// Random numbers that are the same on every machine: the standard defines the generator exactly, but not the
/// distributions.
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : generator_(seed) {}

  /// In [0, 1).
  double share() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }

  /// Uniform in [from, to), real or integer; `from` if the interval is empty.
  double between(double from, double to) { return from + (to - from) * share(); }
  int whole(int from, int to) {
    return to > from ? from + static_cast<int>(share() * static_cast<double>(to - from)) : from;
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace panvo::vision
