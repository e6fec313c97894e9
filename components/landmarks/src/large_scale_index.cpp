// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/large_scale_index.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core/hal/intrin.hpp>
#include <span>
#include <tuple>

#include "feature_spread.hpp"
#include "large_scale_kernels.hpp"

namespace panvo::landmarks {
namespace {

constexpr float kUnit = 8192.0F;     // of a response of 1: responses of up to 4 fit; larger ones are clamped
constexpr float kMaxSum = 65535.0F;  // of all terms of a landmark at one heading

// The heaviest features choose those that are compared by all. On 380 panoramas of seven simulated drives, night and
// snow included, in a library of 2,300 places, none of the three truly most similar places was lost.
constexpr std::size_t kHeavy = 80;
constexpr std::size_t kKeptShare = 8;
constexpr std::size_t kMinKept = 1000;

std::int16_t quantised(float response) {
  return static_cast<std::int16_t>(std::lround(std::clamp(response * kUnit, -32767.0F, 32767.0F)));
}

/// Of the rules' range also where a landmark breaks them: terms are integers, which have no room for others.
float valid_weight(const AdaptiveFeature& feature) {
  return feature.weight > 0.0F ? std::min(1.0F, feature.weight) : 0.0F;  // 0 for NaN, too
}

void add_terms_plain(std::span<const IndexedFeature> features, const std::int16_t* responses,
                     std::span<std::uint16_t> sums) {
  constexpr std::size_t kLanes = cv::v_uint16x8::nlanes;
  for (const IndexedFeature& feature : features) {
    const std::int16_t* row = responses + feature.row * sums.size();
    const cv::v_int16x8 value = cv::v_setall_s16(feature.value);
    const cv::v_uint16x8 factor = cv::v_setall_u16(feature.factor), cap = cv::v_setall_u16(feature.cap);
    for (std::size_t i = 0; i < sums.size(); i += kLanes) {
      const cv::v_uint16x8 difference = cv::v_absdiff(cv::v_load(row + i), value);
      const cv::v_uint16x8 term = cv::v_min(cap, cv::v_mul_hi(difference, factor));
      cv::v_store(&sums[i], cv::v_load(&sums[i]) + term);
    }
  }
}

/// For this processor.
const LargeScaleKernel& kernel() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return kLargeScaleAvx2;
#endif
  return kLargeScalePlain;
}

/// The query's responses in integers.
class Comparison {
 public:
  explicit Comparison(const QueryDescription& query)
      : headings_(static_cast<std::size_t>(query.basis->parameters.headings)),
        sums_((headings_ + kernel().lanes - 1) / kernel().lanes * kernel().lanes),
        responses_(static_cast<int>(query.large_responses.size() / headings_), static_cast<int>(sums_.size()), CV_16SC1,
                   cv::Scalar(0)) {
    for (std::size_t i = 0; i < query.large_responses.size(); ++i) {
      responses_.ptr<std::int16_t>()[i / headings_ * sums_.size() + i % headings_] =
          quantised(query.large_responses[i]);
    }
  }

  /// As of match_large_scale: at the best heading, relative to the mean over all.
  float distance(std::span<const IndexedFeature> features, std::span<const IndexedFeature> more = {}) {
    std::ranges::fill(sums_, std::uint16_t{0});
    for (const auto some : {features, more}) kernel().add_terms(some, responses_.ptr<std::int16_t>(), sums_);
    const auto sums = std::span(sums_).first(headings_);
    const auto sum = std::accumulate(sums.begin(), sums.end(), std::uint32_t{0});
    if (sum == 0) return 1.0F;
    return static_cast<float>(*std::ranges::min_element(sums)) * static_cast<float>(headings_) /
           static_cast<float>(sum);
  }

 private:
  std::size_t headings_;
  std::vector<std::uint16_t> sums_;
  cv::Mat responses_;  // aligned, so that no load crosses a cache line
};

}  // namespace

const LargeScaleKernel kLargeScalePlain{cv::v_uint16x8::nlanes, add_terms_plain};

/// The heaviest features of all landmarks lie one after the other in memory, as the first pass reads no others.
class LargeScaleIndex::Features {
 public:
  /// Copies the features of a landmark to an address that does not change.
  std::span<const IndexedFeature> add(std::span<const IndexedFeature> features) {
    if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < features.size()) {
      blocks_.emplace_back().reserve(std::max(kBlock, features.size()));
    }
    auto& block = blocks_.back();
    block.insert(block.end(), features.begin(), features.end());
    return std::span(block).last(features.size());
  }

 private:
  static constexpr std::size_t kBlock = 1 << 14;
  std::vector<std::vector<IndexedFeature>> blocks_;
};

struct LargeScaleIndex::Entry {
  std::uint32_t id;
  std::span<const IndexedFeature> heavy, rest;  // by descending weight
};

LargeScaleIndex::LargeScaleIndex() : heavy_(std::make_unique<Features>()), rest_(std::make_unique<Features>()) {}
LargeScaleIndex::~LargeScaleIndex() = default;
LargeScaleIndex::LargeScaleIndex(LargeScaleIndex&&) noexcept = default;
LargeScaleIndex& LargeScaleIndex::operator=(LargeScaleIndex&&) noexcept = default;

void LargeScaleIndex::add(std::uint32_t id, const PanoramaDescription& description) {
  const auto& features = description.large;
  const float weights = std::accumulate(features.begin(), features.end(), 1.0F,
                                        [](float sum, const auto& feature) { return sum + valid_weight(feature); });
  // Factors fit into 16 bits if no cap exceeds the smallest spread.
  const float per_weight = std::min(kMaxSum / weights, kUnit * kMinFeatureSpread);
  std::vector<IndexedFeature> indexed;
  for (const auto& feature : features) {
    const float cap = std::floor(valid_weight(feature) * per_weight);
    const float factor = std::round(cap * 65536.0F / (kUnit * std::max(kMinFeatureSpread, feature.scale)));
    indexed.push_back({feature.row, quantised(feature.value), static_cast<std::uint16_t>(std::min(factor, 65535.0F)),
                       static_cast<std::uint16_t>(cap)});
  }
  const auto heavy = std::span<const IndexedFeature>(indexed).first(std::min(kHeavy, indexed.size()));
  const auto rest = std::span<const IndexedFeature>(indexed).subspan(heavy.size());
  entries_.push_back({id, heavy_->add(heavy), rest_->add(rest)});
}

LargeScaleIndex::Ranking LargeScaleIndex::rank(const QueryDescription& query, std::size_t count,
                                               const Asked& is_asked) const {
  struct Candidate {
    float distance;
    const Entry* entry;
  };
  const auto is_nearer = [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.entry->id) < std::tie(b.distance, b.entry->id);
  };
  Comparison comparison(query);
  std::vector<Candidate> candidates;
  const auto keep_nearest = [&](std::size_t most) {
    if (candidates.size() <= most) return;
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(candidates.begin(), end, candidates.end(), is_nearer);
    candidates.erase(end, candidates.end());
  };
  for (const Entry& entry : entries_) {
    if (is_asked(entry.id)) candidates.push_back({comparison.distance(entry.heavy), &entry});
  }
  Ranking ranking{{}, candidates.size()};
  keep_nearest(std::max({kMinKept, count, candidates.size() / kKeptShare}));
  for (auto& candidate : candidates)
    candidate.distance = comparison.distance(candidate.entry->heavy, candidate.entry->rest);
  keep_nearest(count);
  std::sort(candidates.begin(), candidates.end(), is_nearer);
  for (const auto& candidate : candidates) ranking.nearest.push_back({candidate.entry->id, candidate.distance});
  return ranking;
}

}  // namespace panvo::landmarks
