// SPDX-License-Identifier: Apache-2.0
#include "clocks.hpp"
#include "context_state.hpp"

namespace panvo::runtime {
namespace {

/// nullopt for messages whose stamp is not the time of sending: unstamped, latched, or about the past.
std::optional<std::int64_t> stamp_to_check(const TopicDescription& topic, const Sample& sample) {
  if (!sample.type() || !sample.type()->is_stamped_when_sent) return std::nullopt;
  if (topic.qos.durability == interfaces::Durability::kTransientLocal) return std::nullopt;
  const void* const message = sample.message();
  const auto stamp_ns = message ? sample.type()->stamp_ns(message) : std::nullopt;
  return stamp_ns == 0 ? std::nullopt : stamp_ns;
}

}  // namespace

bool Context::State::admits_stamp(const TopicDescription& topic, const Sample& sample) {
  const auto arrival_ns = host.time.arrival_ns();
  const auto stamp_ns = arrival_ns ? stamp_to_check(topic, sample) : std::nullopt;
  if (!stamp_ns) return true;
  const bool is_of_now = host.time.pace() == PassingTime::Pace::kClock;
  const auto verdict = stamp_guard.check(topic.name, *stamp_ns, *arrival_ns,
                                         is_of_now ? std::optional(clocks::system_ns()) : std::nullopt);
  const double off_s = 1e-9 * static_cast<double>(verdict.off_ns);
  switch (verdict.outcome) {
    case StampGuard::Outcome::kAccepted:
      return true;
    case StampGuard::Outcome::kClockStep:
      logger.warn("{}: its sender's clock changed by {:+.3f} s; messages are accepted from now on", topic.name, off_s);
      return true;
    case StampGuard::Outcome::kRejected:
      rejections.add(topic.name, verdict.reason);
      if (verdict.is_to_report) {
        logger.warn("{}: dropped a message with {}, by {:+.3f} s ({} so far): set the clock of its sender", topic.name,
                    verdict.reason, off_s, verdict.rejected);
      }
      return false;
  }
  return true;
}

}  // namespace panvo::runtime
