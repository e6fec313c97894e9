// SPDX-License-Identifier: Apache-2.0
#include "latched_history.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace panvo::runtime {
namespace {

constexpr std::size_t kMaxInMemory = 10'000;  // messages of a topic that keeps all, if its file cannot be used

}  // namespace

LatchedHistory::LatchedHistory(const TopicDescription& topic, std::function<std::int64_t()> clock,
                               std::filesystem::path folder, std::function<void(const std::string&)> warn)
    : topic_(topic.name),
      keeps_all_(topic.qos.keep_all && topic.qos.durability == interfaces::Durability::kTransientLocal),
      depth_(std::max<std::size_t>(topic.qos.depth, 1)),
      lifespan_ns_(std::chrono::nanoseconds(topic.qos.lifespan).count()),
      clock_(std::move(clock)),
      folder_(std::move(folder)),
      warn_(std::move(warn)) {}

SamplePtr LatchedHistory::add(const SamplePtr& sample, bool is_from_here, bool is_checked) {
  const std::lock_guard lock(mutex_);
  const SamplePtr kept = keeps_all_ && is_file_usable_ ? store(sample) : sample;
  entries_.push_back({kept, clock_(), ++last_number_, is_from_here, is_checked});
  if (entries_.size() > (is_file_usable_ ? depth_ : std::min(depth_, kMaxInMemory))) entries_.pop_front();
  return kept;
}

SamplePtr LatchedHistory::store(const SamplePtr& sample) {
  try {
    if (!file_) file_ = std::make_shared<HistoryFile>(folder_);
    const auto place = file_->append(sample->bytes());
    return sample->stored([file = file_, place] { return file->read(place); });
  } catch (const std::system_error& error) {
    is_file_usable_ = false;
    warn_(fmt::format("{}: {}: its messages stay in memory, the last {}. Set TMPDIR to a folder with room", topic_,
                      error.what(), kMaxInMemory));
    return sample;
  }
}

std::vector<LatchedHistory::Entry> LatchedHistory::current() const {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> current;
  std::ranges::copy_if(entries_, std::back_inserter(current), [this](const Entry& entry) { return !is_old(entry); });
  return current;
}

std::vector<LatchedHistory::Entry> LatchedHistory::after(std::uint64_t number, std::size_t count) const {
  const std::lock_guard lock(mutex_);
  const auto first = std::ranges::upper_bound(entries_, number, {}, &Entry::number);
  const auto left = static_cast<std::size_t>(entries_.end() - first);
  return {first, first + static_cast<std::ptrdiff_t>(std::min(count, left))};
}

void LatchedHistory::forget_those_from_here() {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [](const Entry& entry) { return entry.is_from_here; });
}

void LatchedHistory::forget_those_of_others() {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [](const Entry& entry) { return !entry.is_from_here; });
}

bool LatchedHistory::is_old(const Entry& entry) const {
  return lifespan_ns_ > 0 && clock_() - entry.since_ns > lifespan_ns_;
}

}  // namespace panvo::runtime
