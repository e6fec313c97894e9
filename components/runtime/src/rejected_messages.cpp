// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/rejected_messages.hpp"

#include "clocks.hpp"

namespace panvo::runtime {
namespace {

constexpr std::string_view kOthers = "for one of many other reasons";

}  // namespace

bool RejectedMessages::add(std::string_view topic, std::string_view reason, std::string_view sender) {
  const std::int64_t now_ns = clocks::monotonic_ns();
  const std::lock_guard lock(mutex_);
  auto found = topics_.find(topic);
  if (found == topics_.end()) found = topics_.try_emplace(std::string(topic)).first;
  auto& [count, told_ns] = found->second;
  ++count.messages;
  count.last_reason = reason;
  Cause cause(sender, reason);
  if (count.causes.size() >= kMaxCauses && !count.causes.contains(cause)) cause = Cause("", kOthers);
  ++count.causes[cause];
  const auto told = told_ns.find(cause.second);
  if (told != told_ns.end() && now_ns - told->second < kLogPeriod_ns) return false;
  told_ns.insert_or_assign(cause.second, now_ns);
  return true;
}

std::map<std::string, RejectedMessages::Count, std::less<>> RejectedMessages::snapshot() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Count, std::less<>> counts;
  for (const auto& [name, topic] : topics_) counts.emplace(name, topic.count);
  return counts;
}

}  // namespace panvo::runtime
