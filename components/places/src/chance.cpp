// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/chance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace panvo::places {
namespace {

constexpr double kLn10 = 2.302585092994046;
constexpr double kLeast = 1e-12;  // of a probability, so that an exact match is not infinite evidence

double log10_choose(int n, int k) {
  return (std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0)) / kLn10;
}

}  // namespace

Consensus least_expected(std::span<const double> probabilities, int sample, double log10_tests) {
  std::vector<double> sorted(probabilities.begin(), probabilities.end());
  std::sort(sorted.begin(), sorted.end());
  const int n = static_cast<int>(sorted.size());
  Consensus best;
  if (n <= sample) return best;
  const double log10_hypotheses = log10_tests + std::log10(static_cast<double>(n - sample));
  for (int k = sample + 1; k <= n; ++k) {
    const double p = std::max(kLeast, sorted[static_cast<std::size_t>(k - 1)]);
    if (p >= 1.0) break;
    const double log10_expected =
        log10_hypotheses + log10_choose(n, k) + log10_choose(k, sample) + (k - sample) * std::log10(p);
    if (log10_expected < best.log10_expected) best = {log10_expected, k, p};
  }
  return best;
}

}  // namespace panvo::places
