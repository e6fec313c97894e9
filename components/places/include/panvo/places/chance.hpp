// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace panvo::places {

/// Evidence against chance: of `count` matches that agree by chance with the probabilities p, the best subset.
struct Consensus {
  double log10_expected = 0.0;  ///< log10 of the expected number of equally good subsets by chance; 0 if there is none
  int size = 0;                 ///< matches in the subset
  double probability = 1.0;     ///< the largest p of the subset: matches with at most this p belong to it
};

/// A-contrario test [Moisan2004]: a subset of k matches whose largest probability is p is found by chance
/// (n - s) C(n, k) C(k, s) p^(k - s) times per tested hypothesis, because s matches define the hypothesis and any k of n
/// may agree. Returns the k for which this is least. `probabilities`: of each match to agree at least as well by chance;
/// `sample`: s; `log10_tests`: log10 of the number of independent tests, e.g. of places.
Consensus least_expected(std::span<const double> probabilities, int sample, double log10_tests);

}  // namespace panvo::places
