// SPDX-License-Identifier: Apache-2.0
// Faults of clocks, buses and drivers, and a cut recording.
#include <cmath>

#include "kinds.hpp"
#include "passages.hpp"

namespace panvo::test {
namespace {

constexpr double kNs = 1e9;

std::int64_t to_ns(double seconds) { return static_cast<std::int64_t>(std::llround(seconds * kNs)); }

void shift(StereoPair& pair, std::int64_t by_ns) {
  pair.left_ns += by_ns;
  pair.right_ns += by_ns;
}

Fault half_dropped(Draw& draw, const FaultWindow&) {
  return {.pairs = dropped<StereoPair>([draw](const Moment&) mutable { return draw.chance(0.5); })};
}

/// Bursts of lost frames during half of each period.
Fault bursts_dropped(Draw& draw, const FaultWindow& window) {
  const double period_s = draw.uniform(0.5, 1.2);
  return {.pairs = dropped<StereoPair>([period_s, window](const Moment& moment) {
            return std::fmod(moment.t_s - window.from_s, period_s) < 0.5 * period_s;
          })};
}

Fault long_gap(Draw&, const FaultWindow&) { return {.pairs = stopped<StereoPair>()}; }

Fault all_silent(Draw&, const FaultWindow&) {
  return {.pairs = stopped<StereoPair>(), .panoramas = stopped<Panorama>()};
}

Fault one_eye_missing(Draw& draw, const FaultWindow&) {
  const bool is_left = draw.chance(0.5);
  return {.pairs = altered<StereoPair>(
              [is_left](StereoPair& pair, const Moment&) { (is_left ? pair.left : pair.right) = cv::Mat(); })};
}

/// Up to 40 % of the frame period, so that the order does not change.
Fault stamp_jitter(Draw& draw, const FaultWindow&) {
  return {.pairs = altered<StereoPair>([draw](StereoPair& pair, const Moment&) mutable {
            constexpr double kMax_s = 0.016;
            shift(pair, to_ns(draw.uniform(-kMax_s, kMax_s)));
          })};
}

/// Every other frame is repeated in place of the next one, with the next stamp.
Fault duplicates(Draw&, const FaultWindow&) {
  return {.pairs = [is_second = false, before = StereoPair{}](const StereoPair& pair, const Moment& moment) mutable {
    StereoPair passed = pair;
    is_second = moment.is_on && !is_second && !before.left.empty();
    if (is_second) passed = {pair.left_ns, pair.right_ns, before.left, before.right};
    before = pair;
    return std::vector<StereoPair>{passed};
  }};
}

Passage<StereoPair> stepped(double by_s) {
  return altered<StereoPair>([by_s](StereoPair& pair, const Moment&) { shift(pair, to_ns(by_s)); });
}

Fault stamps_ahead(Draw&, const FaultWindow&) { return {.pairs = stepped(10.0)}; }
Fault stamps_back(Draw& draw, const FaultWindow&) { return {.pairs = stepped(-draw.uniform(1.0, 3.0))}; }

/// A single pair with a stamp far in the future.
Fault one_stamp_ahead(Draw& draw, const FaultWindow&) {
  const double by_s = draw.chance(0.5) ? 10.0 : 3.6e8;
  return {.pairs = altered<StereoPair>([by_s, is_done = false](StereoPair& pair, const Moment&) mutable {
            if (!is_done) shift(pair, to_ns(by_s));
            is_done = true;
          })};
}

/// Swaps the order of consecutive frames in pairs.
Fault out_of_order(Draw&, const FaultWindow&) {
  return {.pairs = [held = std::vector<StereoPair>{}](const StereoPair& pair, const Moment& moment) mutable {
    if (moment.is_on && held.empty()) {
      held.push_back(pair);
      return std::vector<StereoPair>{};
    }
    std::vector<StereoPair> passed{pair};
    if (!held.empty()) passed.push_back(held.front());
    held.clear();
    return passed;
  }};
}

/// Cuts out a part of the recording and makes the stamps continuous, as if the vehicle had been carried away. Applies
/// to the ground truth, too.
Fault kidnapped(Draw&, const FaultWindow& window) {
  const std::int64_t cut_ns = to_ns(window.to_s - window.from_s);
  const auto is_after = [window](const Moment& moment) { return moment.t_s >= window.to_s; };
  const auto cut = [is_after]<class Message>(Passage<Message> move) {
    return [is_after, move](const Message& message, const Moment& moment) {
      if (moment.is_on) return std::vector<Message>{};
      return is_after(moment) ? move(message, moment) : std::vector<Message>{message};
    };
  };
  Fault fault;
  fault.pairs = cut(Passage<StereoPair>([cut_ns](StereoPair pair, const Moment&) {
    shift(pair, -cut_ns);
    return std::vector<StereoPair>{pair};
  }));
  fault.panoramas = cut(Passage<Panorama>([cut_ns](Panorama panorama, const Moment&) {
    panorama.stamp_ns -= cut_ns;
    return std::vector<Panorama>{panorama};
  }));
  fault.truth = cut(Passage<nav_msgs::msg::Odometry>([cut_ns](nav_msgs::msg::Odometry pose, const Moment&) {
    auto& stamp = pose.header().stamp();
    const std::int64_t ns = std::int64_t{stamp.sec()} * 1'000'000'000 + std::int64_t{stamp.nanosec()} - cut_ns;
    stamp.sec(static_cast<std::int32_t>(ns / 1'000'000'000));
    stamp.nanosec(static_cast<std::uint32_t>(ns % 1'000'000'000));
    return std::vector<nav_msgs::msg::Odometry>{pose};
  }));
  return fault;
}

}  // namespace

std::vector<FaultKind> timing_kinds() {
  return {
      {"half_dropped", "half of the stereo pairs are lost at random", Lasting::kWhile, half_dropped},
      {"bursts_dropped", "stereo pairs are lost in bursts", Lasting::kWhile, bursts_dropped},
      {"long_gap", "no stereo pairs", Lasting::kWhile, long_gap},
      {"all_silent", "neither stereo pairs nor panoramas", Lasting::kWhile, all_silent},
      {"eye_missing", "the images of one camera are lost", Lasting::kWhile, one_eye_missing},
      {"stamp_jitter", "stamp errors of up to 16 ms", Lasting::kWhile, stamp_jitter},
      {"duplicates", "every other stereo pair repeats the previous one", Lasting::kWhile, duplicates},
      {"stamps_ahead", "stereo pairs are stamped 10 s ahead", Lasting::kWhile, stamps_ahead},
      {"stamps_back", "stereo pairs are stamped 1 to 3 s late", Lasting::kWhile, stamps_back},
      {"one_stamp_ahead", "one stereo pair is stamped 10 s or 11 years ahead", Lasting::kWhile, one_stamp_ahead},
      {"out_of_order", "consecutive stereo pairs are swapped", Lasting::kWhile, out_of_order},
      {"kidnapped", "the vehicle is moved by some metres between two frames", Lasting::kWhile, kidnapped},
  };
}

}  // namespace panvo::test
