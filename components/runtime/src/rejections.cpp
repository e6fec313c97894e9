// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/rejections.hpp"

namespace panvo::runtime {

bool Rejections::add(std::string_view topic, std::string_view reason) {
  const std::lock_guard lock(mutex_);
  auto found = topics_.find(topic);
  if (found == topics_.end()) found = topics_.try_emplace(std::string(topic)).first;
  auto& [count, is_rejected] = found->second;
  const bool is_news = !is_rejected || count.last_reason != reason;
  ++count.messages;
  count.last_reason = reason;
  is_rejected = true;
  return is_news;
}

void Rejections::accepted(std::string_view topic) {
  const std::lock_guard lock(mutex_);
  if (const auto found = topics_.find(topic); found != topics_.end()) found->second.is_rejected = false;
}

std::map<std::string, Rejections::Count, std::less<>> Rejections::snapshot() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Count, std::less<>> counts;
  for (const auto& [name, topic] : topics_) counts.emplace(name, topic.count);
  return counts;
}

}  // namespace panvo::runtime
