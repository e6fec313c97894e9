// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trust.hpp"

#include <algorithm>

#include "panvo/evaluation/statistics.hpp"

namespace panvo::evaluation {
namespace {

constexpr std::int64_t kAlarmTime_ns = static_cast<std::int64_t>(kAlarmTime_s * 1e9);

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

bool is_over_sigma(const TrustSample& sample) { return sample.error_over_sigma > kMisleadingSigmas; }

bool is_beyond_level(const TrustSample& sample) {
  return sample.protection_level_m && sample.error_m > *sample.protection_level_m;
}

bool is_alarm(const TrustSample& sample) { return !sample.is_tracking || !sample.is_usable; }

/// A pose and the interval in which it is the latest one.
struct Standing {
  const TrustSample* sample;
  std::int64_t from_ns, to_ns;
  bool is_followed_by_silence;
};

std::vector<Standing> standings(std::span<const TrustSample> samples) {
  std::vector<Standing> all;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::int64_t from_ns = samples[i].stamp_ns;
    const std::int64_t next_ns = i + 1 < samples.size() ? samples[i + 1].stamp_ns : from_ns;
    const bool is_silent = next_ns - from_ns > kAlarmTime_ns;
    all.push_back({&samples[i], from_ns, is_silent ? from_ns + kAlarmTime_ns : next_ns, is_silent});
  }
  return all;
}

/// Consecutive poses for which a condition holds.
struct Stretch {
  std::size_t first, last;
};

template <class Holds>
std::vector<Stretch> stretches(const std::vector<Standing>& all, Holds holds) {
  std::vector<Stretch> found;
  bool goes_on = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool does = holds(*all[i].sample);
    if (does && goes_on) found.back().last = i;
    if (does && !goes_on) found.push_back({i, i});
    goes_on = does && !all[i].is_followed_by_silence;
  }
  return found;
}

std::int64_t length_ns(const std::vector<Standing>& all, const Stretch& stretch) {
  return all[stretch.last].to_ns - all[stretch.first].from_ns;
}

/// From the start of a stretch to the first alarm or gap in it; nullopt if it ends without.
std::optional<std::int64_t> alarm_after_ns(const std::vector<Standing>& all, const Stretch& stretch) {
  const std::int64_t begin_ns = all[stretch.first].from_ns;
  for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
    if (is_alarm(*all[i].sample)) return all[i].from_ns - begin_ns;
    if (all[i].is_followed_by_silence) return all[i].to_ns - begin_ns;
  }
  return std::nullopt;
}

std::optional<double> time_to_alarm_s(const std::vector<Standing>& all) {
  std::optional<double> max_s;
  for (const auto& stretch :
       stretches(all, [](const TrustSample& sample) { return is_over_sigma(sample) || is_beyond_level(sample); })) {
    const auto alarm_ns = alarm_after_ns(all, stretch);
    const std::int64_t waited_ns = alarm_ns.value_or(length_ns(all, stretch));
    if (!alarm_ns && waited_ns <= kAlarmTime_ns) continue;
    max_s = std::max(max_s.value_or(0.0), seconds(waited_ns));
  }
  return max_s;
}

double max_misleading_s(const std::vector<Standing>& all) {
  std::int64_t max_ns = 0;
  for (const auto& stretch :
       stretches(all, [](const TrustSample& sample) { return is_over_sigma(sample) && sample.is_tracking; })) {
    max_ns = std::max(max_ns, length_ns(all, stretch));
  }
  return seconds(max_ns);
}

std::optional<double> noticed_s(const std::vector<Standing>& all, std::int64_t from_ns) {
  for (const auto& standing : all) {
    if (standing.from_ns >= from_ns && is_alarm(*standing.sample)) return seconds(standing.from_ns - from_ns);
    if (standing.is_followed_by_silence && standing.to_ns >= from_ns) return seconds(standing.to_ns - from_ns);
  }
  return std::nullopt;
}

/// End of the last alarm, gap or longer error over 3 sigma; nullopt if there is none.
std::optional<std::int64_t> last_wrong_ns(const std::vector<Standing>& all) {
  std::optional<std::int64_t> last_ns;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_alarm(*all[i].sample)) last_ns = all[i].to_ns;
    if (all[i].is_followed_by_silence) last_ns = all[i + 1].from_ns;
  }
  for (const auto& stretch : stretches(all, is_over_sigma)) {
    if (length_ns(all, stretch) <= kAlarmTime_ns) continue;
    last_ns = std::max(last_ns.value_or(0), all[stretch.last].to_ns);
  }
  return last_ns;
}

void count(TrustScore& score, const TrustSample& sample) {
  constexpr int kDimensions = 2;
  static const double bound_95 = chi_square_quantile(kDimensions, 0.95);
  static const double bound_999 = chi_square_quantile(kDimensions, 0.999);
  const double squared = sample.error_over_sigma * sample.error_over_sigma;
  ++score.poses;
  score.outside_95 += squared > bound_95;
  score.outside_999 += squared > bound_999;
  score.max_error_m = std::max(score.max_error_m, sample.error_m);
  score.max_error_over_sigma = std::max(score.max_error_over_sigma, sample.error_over_sigma);
  if (!sample.protection_level_m) return;
  ++score.with_level;
  score.beyond_level += is_beyond_level(sample);
  if (*sample.protection_level_m > 0.0) {
    score.worst_over_level =
        std::max(score.worst_over_level.value_or(0.0), sample.error_m / *sample.protection_level_m);
  }
  if (sample.is_tracking) score.levels_while_tracking_m.push_back(*sample.protection_level_m);
}

}  // namespace

TrustScore score_trust(std::span<const TrustSample> samples, const std::optional<Disturbance>& disturbance) {
  TrustScore score;
  for (const auto& sample : samples) count(score, sample);
  const auto all = standings(samples);
  score.max_misleading_s = max_misleading_s(all);
  score.time_to_alarm_s = time_to_alarm_s(all);
  if (!disturbance) return score;
  score.noticed_s = noticed_s(all, disturbance->from_ns);
  score.is_never_noticed = !score.noticed_s;
  if (!disturbance->to_ns) return score;
  const auto wrong_ns = last_wrong_ns(all);
  // Not recovered if the run has no pose after the disturbance, or is still wrong at its end.
  score.is_never_recovered =
      all.empty() || all.back().from_ns < *disturbance->to_ns || (wrong_ns && *wrong_ns >= all.back().from_ns);
  if (!score.is_never_recovered) {
    score.time_to_recover_s = std::max(0.0, seconds(wrong_ns.value_or(*disturbance->to_ns) - *disturbance->to_ns));
  }
  return score;
}

}  // namespace panvo::evaluation
