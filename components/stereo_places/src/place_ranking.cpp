// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/place_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace panvo::stereo_places {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kWeightScale = 20.0;  // of weights stored as bytes: ln 100,000 is 230

}  // namespace

PlaceRanking::PlaceRanking() : places_with_key_(kTables * kKeys, 0) {
  std::mt19937_64 random(kSeed);
  std::array<std::uint8_t, 128> order{};
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  for (auto& terms : terms_) {
    for (std::size_t i = 0; i < kTerms; ++i) std::swap(order[i], order[i + random() % (order.size() - i)]);
    std::copy_n(order.begin(), kTerms, terms.begin());
  }
}

PlaceRanking::Keys PlaceRanking::keys_of(const landmarks::Keypoint& keypoint) const {
  Keys keys{};
  for (std::size_t table = 0; table < kTables; ++table) {
    unsigned key = 0;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      const auto& terms = terms_[table * kBits + bit];
      int sum = 0;
      for (std::size_t i = 0; i < kTerms; i += 2) {
        sum += static_cast<int>(keypoint.descriptor[terms[i]]) - static_cast<int>(keypoint.descriptor[terms[i + 1]]);
      }
      key = 2 * key + (sum > 0 ? 1U : 0U);
    }
    keys[table] = static_cast<std::uint16_t>(key);
  }
  return keys;
}

void PlaceRanking::add(std::uint32_t id, std::span<const landmarks::Keypoint> keypoints) {
  const auto [place, is_new] = places_.try_emplace(id);
  if (!is_new) throw std::invalid_argument("place ranking: the id " + std::to_string(id) + " is taken");
  auto& keys = place->second;
  std::transform(keypoints.begin(), keypoints.end(), std::back_inserter(keys),
                 [this](const auto& keypoint) { return keys_of(keypoint); });
  for (std::size_t table = 0; table < kTables; ++table) {
    std::vector<std::uint16_t> different;
    for (const auto& of_one : keys) different.push_back(of_one[table]);
    std::sort(different.begin(), different.end());
    different.erase(std::unique(different.begin(), different.end()), different.end());
    for (const auto key : different) {
      auto& count = places_with_key_[table * kKeys + key];
      if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
    }
  }
}

std::vector<PlaceRanking::Ranked> PlaceRanking::rank(std::span<const landmarks::Keypoint> query,
                                                     const std::function<bool(std::uint32_t)>& is_asked,
                                                     std::size_t most) const {
  std::vector<std::uint8_t> weights(kTables * kKeys, 0);  // bytes, so that they stay in the processor's cache
  const double places = static_cast<double>(places_.size());
  for (const auto& keypoint : query) {
    const Keys keys = keys_of(keypoint);
    for (std::size_t table = 0; table < kTables; ++table) {
      const std::size_t at = table * kKeys + keys[table];
      if (places_with_key_[at] == 0) continue;
      const double weight = kWeightScale * std::log((places + 1.0) / places_with_key_[at]);
      weights[at] = static_cast<std::uint8_t>(std::clamp(weight, 1.0, 255.0));
    }
  }
  std::vector<Ranked> ranked;
  for (const auto& [id, keys] : places_) {
    if (keys.empty() || !is_asked(id)) continue;
    unsigned sum = 0;
    for (const auto& of_one : keys) {
      for (std::size_t table = 0; table < kTables; ++table) sum += weights[table * kKeys + of_one[table]];
    }
    // more keypoints share more keys by chance
    if (sum > 0) ranked.push_back({id, static_cast<double>(sum) / std::sqrt(static_cast<double>(keys.size()))});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (ranked.size() > most) ranked.resize(most);
  return ranked;
}

}  // namespace panvo::stereo_places
