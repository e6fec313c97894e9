// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/journey_revisits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "journey_errors.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::evaluation {
namespace {

// Distance travelled before and after the closest approach that belongs to a visit: a landmark is not at the centre of
// its junction and is recognised some metres before and after. Junctions in a town are two or three times as far apart.
constexpr double kReach_m = 25.0;
constexpr double kWrong_m = 1.0;  // tolerance of a correction, in addition to the landmark's own error

/// A pass by a known place.
struct ListedRevisit {
  int place = 0;
  std::int64_t stamp_ns = 0;
  std::int64_t first_ns = 0;
  bool first_was_earlier = false;  ///< in the earlier journey
  double entrance_rad = 0.0;
  std::string route;
};

std::vector<ListedRevisit> listed_revisits(const JourneyFrames& frames) {
  struct First {
    std::int64_t stamp_ns = 0;
    double heading_rad = 0.0;
    bool was_earlier = false;
    std::string route;  // since the last pass
  };
  std::map<int, First> known;
  if (frames.earlier != nullptr) {
    for (const auto& visit : frames.earlier->visits) {
      known.try_emplace(visit.place, First{visit.stamp_ns, visit.heading_in_rad, true, ""});
    }
  }
  std::vector<ListedRevisit> revisits;
  for (const auto& visit : frames.recording.visits) {
    const auto number = std::to_string(visit.place);
    for (auto& [place, first] : known) {
      if (!first.route.empty()) first.route.append("-").append(number);
    }
    const auto [found, is_new] = known.try_emplace(visit.place, First{visit.stamp_ns, visit.heading_in_rad, false, ""});
    if (!is_new) {
      revisits.push_back({visit.place, visit.stamp_ns, found->second.stamp_ns, found->second.was_earlier,
                          vision::wrapped(visit.heading_in_rad - found->second.heading_rad), found->second.route});
    }
    found->second.route = number;
  }
  return revisits;
}

class Scorer {
 public:
  explicit Scorer(const JourneyFrames& frames) : frames_(frames), errors_(frames) {
    for (const auto& landmark : frames.run.landmarks) landmarks_.try_emplace(landmark.id, errors_.landmark(landmark));
  }

  RevisitScore score() {
    read_applied();
    const auto listed = within_run(listed_revisits(frames_));
    assign(listed);
    for (std::size_t i = 0; i < listed.size(); ++i) score_.revisits.push_back(at_place(listed[i], of_listed_[i]));
    for (const auto& outcomes : elsewhere_) score_.revisits.push_back(elsewhere(outcomes));
    finish();
    return std::move(score_);
  }

 private:
  std::vector<ListedRevisit> within_run(std::vector<ListedRevisit> listed) {
    const auto& poses = frames_.run.enhanced.poses;
    score_.not_reached = static_cast<int>(std::erase_if(listed, [&](const ListedRevisit& revisit) {
      return revisit.stamp_ns < poses.front().stamp_ns || revisit.stamp_ns > poses.back().stamp_ns;
    }));
    return listed;
  }

  using Outcomes = std::vector<const RunOutcome*>;

  void read_applied() {
    for (const auto& outcome : frames_.run.outcomes) {
      if (!errors_.has_truth(outcome.stamp_ns)) {
        ++score_.before_start;
        continue;
      }
      if (outcome.outcome == "applied") score_.applied.push_back(judged(outcome));
    }
    if (score_.before_start > 0 && score_.before_start == static_cast<int>(frames_.run.outcomes.size())) {
      throw InputError(frames_.run.folder / "outcomes.csv", 2, "no stamp is within the time span of the ground truth",
                       "use the recording that was played in this run, with the same clock");
    }
  }

  AppliedCorrection judged(const RunOutcome& outcome) const {
    AppliedCorrection applied;
    applied.stamp_ns = outcome.stamp_ns;
    applied.landmark = outcome.landmark;
    applied.travelled_m = errors_.travelled_m(outcome.stamp_ns);
    const auto before = errors_.of_map(outcome.map_from_base_before, outcome.stamp_ns);
    const auto after = errors_.of_map(outcome.map_from_base_after, outcome.stamp_ns);
    applied.before_position_m = before->position_m;
    applied.after_position_m = after->position_m;
    applied.before_m = before->flat_m;
    applied.after_m = after->flat_m;
    applied.before_heading_rad = before->heading_rad;
    applied.after_heading_rad = after->heading_rad;
    if (const auto* own = landmark(outcome.landmark); own && own->error) applied.landmark_m = own->error->flat_m;
    applied.is_wrong = applied.after_m > std::max(applied.before_m, applied.landmark_m.value_or(0.0)) + kWrong_m;
    return applied;
  }

  const LandmarkTruth* landmark(std::int64_t id) const {
    const auto found = landmarks_.find(id);
    return found == landmarks_.end() ? nullptr : &found->second;
  }

  /// Assigns each outcome to the nearest revisit by distance travelled, within kReach_m.
  void assign(const std::vector<ListedRevisit>& listed) {
    of_listed_.resize(listed.size());
    for (const auto& outcome : frames_.run.outcomes) {
      if (!errors_.has_truth(outcome.stamp_ns)) continue;
      const double at_m = errors_.travelled_m(outcome.stamp_ns);
      const auto gap_m = [&](const ListedRevisit& revisit) {
        return std::abs(errors_.travelled_m(revisit.stamp_ns) - at_m);
      };
      const auto nearest = std::min_element(listed.begin(), listed.end(),
                                            [&](const auto& a, const auto& b) { return gap_m(a) < gap_m(b); });
      if (nearest != listed.end() && gap_m(*nearest) <= kReach_m) {
        of_listed_[static_cast<std::size_t>(nearest - listed.begin())].push_back(&outcome);
      } else if (!elsewhere_.empty() && elsewhere_.back().back()->landmark == outcome.landmark &&
                 at_m - errors_.travelled_m(elsewhere_.back().back()->stamp_ns) <= kReach_m) {
        elsewhere_.back().push_back(&outcome);
      } else {
        elsewhere_.push_back({&outcome});
      }
    }
  }

  Revisit at_place(const ListedRevisit& listed, const Outcomes& outcomes) const {
    Revisit revisit;
    revisit.place = listed.place;
    if (const auto place = frames_.recording.places.find(listed.place); place != frames_.recording.places.end()) {
      revisit.name = place->second.name;
    }
    revisit.route = listed.route;
    revisit.stamp_ns = listed.stamp_ns;
    revisit.entrance_rad = listed.entrance_rad;
    revisit.landmark_stamp_ns = listed.first_ns;
    revisit.landmark_was_earlier = listed.first_was_earlier;
    take(revisit, outcomes);
    if (outcomes.empty()) say_why_missed(revisit);
    measure(revisit);
    return revisit;
  }

  Revisit elsewhere(const Outcomes& outcomes) const {
    Revisit revisit;
    revisit.stamp_ns = outcomes.front()->stamp_ns;
    take(revisit, outcomes);
    measure(revisit);
    revisit.entrance_rad = revisit.true_heading_rad;
    return revisit;
  }

  /// Summarises the outcomes of one visit: the error before the first applied correction and after the last.
  void take(Revisit& revisit, const Outcomes& outcomes) const {
    const RunOutcome* last = nullptr;
    for (const auto* outcome : outcomes) {
      if (outcome->outcome == "applied") {
        const auto applied = judged(*outcome);
        if (revisit.corrections++ == 0) {
          revisit.before_m = applied.before_m;
          revisit.before_heading_rad = applied.before_heading_rad;
        }
        revisit.after_m = applied.after_m;
        revisit.after_heading_rad = applied.after_heading_rad;
        revisit.is_wrong = revisit.is_wrong || applied.is_wrong;
        const bool moves = !is_rotation_only(*outcome);
        revisit.result = moves || revisit.result == RevisitResult::kCorrected ? RevisitResult::kCorrected
                                                                              : RevisitResult::kHeadingOnly;
        last = outcome;
      } else if (revisit.corrections == 0) {
        const bool is_known = outcome->outcome == "better_known";
        if (!is_known && revisit.result == RevisitResult::kGivenUp) continue;
        revisit.result = is_known ? RevisitResult::kGivenUp : RevisitResult::kRejected;
        revisit.reason = outcome->reason;
        last = outcome;
      }
    }
    if (last == nullptr) return;
    if (revisit.corrections > 0) revisit.reason.clear();
    revisit.stamp_ns = last->stamp_ns;
    name_landmark(revisit, last->landmark);
  }

  void name_landmark(Revisit& revisit, std::int64_t id) const {
    revisit.landmark = id;
    const auto* known = landmark(id);
    if (known == nullptr) return;
    revisit.landmark_stamp_ns = known->stamp_ns;
    revisit.landmark_was_earlier = known->was_earlier;
  }

  bool is_rotation_only(const RunOutcome& outcome) const {
    return std::any_of(frames_.run.corrections.begin(), frames_.run.corrections.end(), [&](const auto& correction) {
      return correction.stamp_ns == outcome.stamp_ns && correction.landmark == outcome.landmark &&
             correction.state == "rotation_only";
    });
  }

  /// Sets the reason from the step that came furthest during the visit.
  void say_why_missed(Revisit& revisit) const {
    const double at_m = errors_.travelled_m(revisit.stamp_ns);
    const auto near = [&](std::int64_t stamp_ns) {
      return errors_.has_truth(stamp_ns) && std::abs(errors_.travelled_m(stamp_ns) - at_m) <= kReach_m;
    };
    for (const auto& correction : frames_.run.corrections) {
      if (!near(correction.stamp_ns)) continue;
      revisit.result = RevisitResult::kRejected;
      name_landmark(revisit, correction.landmark);
      revisit.reason = correction.reason.empty() ? "the correction has no recorded outcome" : correction.reason;
    }
    if (revisit.landmark) return;
    static constexpr std::array<std::string_view, 5> kByProgress{"unusable", "searching", "rejected", "locked",
                                                                 "matched"};
    std::size_t furthest = 0;
    double nearest_m = kReach_m;
    revisit.reason = frames_.run.matches.empty() ? "unknown, no matches.csv" : "no panorama near it was processed";
    for (const auto& match : frames_.run.matches) {
      if (!near(match.stamp_ns)) continue;
      const auto progress = static_cast<std::size_t>(std::find(kByProgress.begin(), kByProgress.end(), match.state) -
                                                     kByProgress.begin());
      const double gap_m = std::abs(errors_.travelled_m(match.stamp_ns) - at_m);
      if (progress < furthest || (progress == furthest && gap_m >= nearest_m)) continue;
      furthest = progress;
      nearest_m = gap_m;
      revisit.reason = match.state + (match.reason.empty() ? "" : ": " + match.reason);
    }
  }

  void measure(Revisit& revisit) const {
    revisit.travelled_m = errors_.travelled_m(revisit.stamp_ns);
    const auto now = errors_.truth(revisit.stamp_ns);
    if (const auto error = errors_.of_binocular(revisit.stamp_ns)) {
      revisit.binocular_m = error->flat_m;
      revisit.binocular_heading_rad = error->heading_rad;
    }
    if (!revisit.before_m) {
      if (const auto error = errors_.of_enhanced(revisit.stamp_ns)) {
        revisit.before_m = error->flat_m;
        revisit.before_heading_rad = error->heading_rad;
      }
    }
    if (revisit.landmark) {
      if (const auto* own = landmark(*revisit.landmark); own && own->error) {
        revisit.landmark_m = own->error->flat_m;
        revisit.landmark_heading_rad = own->error->heading_rad;
        if (revisit.after_m) revisit.beyond_m = *revisit.after_m - own->error->flat_m;
      }
    }
    const auto then = revisit.landmark_stamp_ns
                          ? errors_.truth(*revisit.landmark_stamp_ns, revisit.landmark_was_earlier)
                          : std::nullopt;
    if (then && now) {
      revisit.true_heading_rad = vision::wrapped(yaw_of(*now) - yaw_of(*then));
      revisit.distance_m = (now->translation() - then->translation()).head<2>().norm();
    }
    for (const auto& match : frames_.run.matches) {
      if (match.stamp_ns == revisit.stamp_ns && revisit.landmark == match.landmark) {
        revisit.heading_rad = match.heading_rad;
      }
    }
  }

  void finish() {
    std::stable_sort(score_.revisits.begin(), score_.revisits.end(),
                     [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
    int number = 0;
    for (auto& revisit : score_.revisits) {
      revisit.number = ++number;
      if (!revisit.place) {
        ++score_.elsewhere;
        continue;
      }
      ++score_.listed;
      score_.corrected += revisit.result == RevisitResult::kCorrected ? 1 : 0;
      score_.heading_only += revisit.result == RevisitResult::kHeadingOnly ? 1 : 0;
      score_.given_up += revisit.result == RevisitResult::kGivenUp ? 1 : 0;
      score_.rejected += revisit.result == RevisitResult::kRejected ? 1 : 0;
      score_.missed += revisit.result == RevisitResult::kMissed ? 1 : 0;
    }
    for (const auto& applied : score_.applied) score_.wrong += applied.is_wrong ? 1 : 0;
  }

  const JourneyFrames& frames_;
  const JourneyErrors errors_;
  std::map<std::int64_t, LandmarkTruth> landmarks_;  // as first published
  std::vector<Outcomes> of_listed_, elsewhere_;
  RevisitScore score_;
};

}  // namespace

std::string_view to_string(RevisitResult result) {
  switch (result) {
    case RevisitResult::kCorrected:
      return "corrected";
    case RevisitResult::kHeadingOnly:
      return "heading only";
    case RevisitResult::kGivenUp:
      return "given up";
    case RevisitResult::kRejected:
      return "rejected";
    case RevisitResult::kMissed:
      return "missed";
  }
  return "";
}

RevisitScore score_revisits(const JourneyFrames& frames) { return Scorer(frames).score(); }

}  // namespace panvo::evaluation
