// SPDX-License-Identifier: Apache-2.0
// A sequence of different faults, for long runs.
#include <cmath>
#include <iterator>
#include <memory>

#include "kinds.hpp"

namespace panvo::test {
namespace {

constexpr double kPeriod_s = 20.0;             // one fault in each
constexpr double kFrom_s = 8.0, kTo_s = 11.0;  // within the period; leaves time to recover

/// Kinds that start and end and do not change later stamps.
std::vector<FaultKind> passing_kinds() {
  std::vector<FaultKind> kinds;
  for (const auto& part : {image_kinds(), optics_kinds(), timing_kinds(), panorama_kinds(), message_kinds()}) {
    std::copy_if(part.begin(), part.end(), std::back_inserter(kinds),
                 [](const FaultKind& kind) { return kind.lasting == Lasting::kWhile && kind.name != "kidnapped"; });
  }
  return kinds;
}

/// Provides the current fault; keeps only one at a time.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : seed_(seed), kinds_(passing_kinds()) {}

  Fault& at(double t_s) {
    const auto period = static_cast<std::uint64_t>(t_s / kPeriod_s);
    if (period + 1 != begun_) {
      begun_ = period + 1;
      const double begin_s = static_cast<double>(period) * kPeriod_s;
      window_ = {begin_s + kFrom_s, begin_s + kTo_s};
      Draw draw(seed_ + period, "mixed");
      const FaultKind& kind = kinds_[static_cast<std::size_t>(draw.integer(0, static_cast<int>(kinds_.size())))];
      fault_ = kind.make(draw, window_);
    }
    return fault_;
  }

  bool is_on(double t_s) const { return window_.contains(t_s); }

 private:
  const std::uint64_t seed_;
  const std::vector<FaultKind> kinds_;
  std::uint64_t begun_ = 0;  // periods
  FaultWindow window_;
  Fault fault_;
};

template <class Message>
Passage<Message> in_turn(const std::shared_ptr<Sequence>& sequence, Passage<Message> Fault::*stream) {
  return [sequence, stream](const Message& message, const Moment& moment) {
    const auto& passage = sequence->at(moment.t_s).*stream;
    if (!passage) return std::vector<Message>{message};
    return passage(message, {moment.t_s, sequence->is_on(moment.t_s)});
  };
}

Fault mixed(Draw& draw, const FaultWindow&) {
  const auto sequence = std::make_shared<Sequence>(draw.seed() >> 8);
  Fault fault;
  fault.pairs = in_turn(sequence, &Fault::pairs);
  fault.panoramas = in_turn(sequence, &Fault::panoramas);
  fault.odometry = in_turn(sequence, &Fault::odometry);
  fault.qualities = in_turn(sequence, &Fault::qualities);
  fault.azimuths = in_turn(sequence, &Fault::azimuths);
  fault.landmarks = in_turn(sequence, &Fault::landmarks);
  fault.corrections = in_turn(sequence, &Fault::corrections);
  return fault;
}

}  // namespace

std::vector<FaultKind> mixed_kinds() {
  return {{"mixed", "every 20 s a different temporary fault, for 3 s", Lasting::kWhole, mixed}};
}

}  // namespace panvo::test
