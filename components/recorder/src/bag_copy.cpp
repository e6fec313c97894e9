// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_copy.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {
namespace {

/// Handles in the new bag by the old bag's topic index; nullopt for excluded topics.
std::vector<std::optional<int>> add_topics(const BagReader& reader, BagWriter& writer, const TopicFilter& topics) {
  std::vector<std::optional<int>> handles;
  for (auto topic : reader.metadata().topics) {
    if (!topics.accepts(topic.name)) {
      handles.emplace_back();
      continue;
    }
    auto definition = reader.definition(topic);
    topic.type = full_type_name(topic.type);
    if (const auto* type = interfaces::find_message_type(topic.type); type && definition.text.empty()) {
      definition = {"ros2msg", std::string(type->definition)};
    }
    handles.emplace_back(writer.add_topic(topic, definition));
    if (const auto dropped = dropped_messages(reader.metadata(), topic.name)) {
      writer.count_dropped(topic.name, dropped);
    }
  }
  return handles;
}

}  // namespace

BagMetadata reindex_bag(const std::filesystem::path& bag, std::vector<std::string>& warnings) {
  if (!std::filesystem::is_directory(bag)) {
    throw BagError(bag.string() + ": is not a folder; specify the bag's folder");
  }
  const BagReader reader(bag, BagReader::Trust::kFiles);
  warnings = reader.warnings();
  write_metadata(bag, reader.metadata(), true);
  return reader.metadata();
}

CopyResult copy_bag(const std::filesystem::path& from, const std::filesystem::path& to, const CopySelection& selection,
                    const BagWriter::Options& options) {
  BagReader reader(from);
  BagWriter writer(to, options);
  const auto handles = add_topics(reader, writer, selection.topics);
  CopyResult result;
  const auto copy = [&](const BagMessage& message) {
    writer.write(*handles[message.topic], std::max(message.timestamp_ns, selection.from_ns), message.data);
    ++result.copied;
  };
  if (selection.from_ns > reader.metadata().start_ns) {
    reader.select([&](const BagTopic& topic) { return selection.topics.accepts(topic.name) && is_latched(topic); });
    for (auto* message = reader.next(); message && message->timestamp_ns < selection.from_ns; message = reader.next()) {
      copy(*message);
    }
  }
  reader.select([&](const BagTopic& topic) { return selection.topics.accepts(topic.name); }, selection.from_ns);
  for (auto* message = reader.next(); message && message->timestamp_ns < selection.to_ns; message = reader.next()) {
    copy(*message);
  }
  writer.close();
  result.lost = reader.lost_messages();
  result.warnings = reader.warnings();
  return result;
}

}  // namespace panvo::recorder
