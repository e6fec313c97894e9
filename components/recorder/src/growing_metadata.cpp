// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/growing_metadata.hpp"

#include <algorithm>

namespace panvo::recorder {
namespace {

/// Extends a time range, which is empty if it has no messages yet.
void extend(std::int64_t& start_ns, std::int64_t& duration_ns, bool is_empty, std::int64_t first_ns,
            std::int64_t last_ns) {
  const auto end_ns = is_empty ? last_ns : std::max(start_ns + duration_ns, last_ns);
  start_ns = is_empty ? first_ns : std::min(start_ns, first_ns);
  duration_ns = end_ns - start_ns;
}

}  // namespace

void Batch::add(std::size_t topic, std::int64_t timestamp_ns, std::size_t size) {
  first_ns = messages == 0 ? timestamp_ns : std::min(first_ns, timestamp_ns);
  last_ns = messages == 0 ? timestamp_ns : std::max(last_ns, timestamp_ns);
  ++messages;
  bytes += size;
  if (by_topic.size() <= topic) by_topic.resize(topic + 1);
  ++by_topic[topic];
}

void GrowingMetadata::begin_file(const std::string& path) {
  ++files_begun_;
  metadata_.files.push_back({.path = path, .start_ns = BagMetadata::kNoStart});
  by_topic_.emplace_back();
}

void GrowingMetadata::commit(const Batch& batch) {
  if (batch.messages == 0) return;
  auto& file = metadata_.files.back();
  extend(file.start_ns, file.duration_ns, file.message_count == 0, batch.first_ns, batch.last_ns);
  extend(metadata_.start_ns, metadata_.duration_ns, metadata_.message_count == 0, batch.first_ns, batch.last_ns);
  file.message_count += batch.messages;
  metadata_.message_count += batch.messages;
  auto& counts = by_topic_.back();
  counts.resize(std::max(counts.size(), batch.by_topic.size()));
  for (std::size_t topic = 0; topic < batch.by_topic.size(); ++topic) {
    counts[topic] += batch.by_topic[topic];
    metadata_.topics[topic].message_count += batch.by_topic[topic];
  }
}

std::vector<std::string> GrowingMetadata::remove_oldest(std::size_t max_files) {
  std::vector<std::string> removed;
  while (metadata_.files.size() > max_files) {
    const auto& file = metadata_.files.front();
    removed.push_back(file.path);
    metadata_.message_count -= file.message_count;
    for (std::size_t topic = 0; topic < by_topic_.front().size(); ++topic) {
      metadata_.topics[topic].message_count -= by_topic_.front()[topic];
    }
    metadata_.files.erase(metadata_.files.begin());
    by_topic_.pop_front();
  }
  if (removed.empty()) return removed;
  bool is_empty = true;
  metadata_.start_ns = BagMetadata::kNoStart;
  metadata_.duration_ns = 0;
  for (const auto& file : metadata_.files) {
    if (file.message_count == 0) continue;
    extend(metadata_.start_ns, metadata_.duration_ns, is_empty, file.start_ns, file.start_ns + file.duration_ns);
    is_empty = false;
  }
  return removed;
}

}  // namespace panvo::recorder
