// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_copy.hpp"

#include <optional>

#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {

BagMetadata reindex_bag(const std::filesystem::path& bag, std::vector<std::string>& warnings) {
  if (!std::filesystem::is_directory(bag)) {
    throw BagError(bag.string() + ": is not a folder; name the bag's folder");
  }
  const BagReader reader(bag, BagReader::Trust::kDatabases);
  warnings = reader.warnings();
  write_metadata(bag, reader.metadata(), true);
  return reader.metadata();
}

CopyResult copy_bag(const std::filesystem::path& from, const std::filesystem::path& to, const TopicFilter& topics,
                    const BagWriter::Options& options) {
  BagReader reader(from);
  BagWriter writer(to, options);
  std::vector<std::optional<int>> handles;
  for (auto topic : reader.metadata().topics) {
    if (!topics.accepts(topic.name)) {
      handles.emplace_back();
      continue;
    }
    topic.type = full_type_name(topic.type);
    const auto* type = interfaces::find_message_type(topic.type);
    handles.emplace_back(writer.add_topic(topic, type ? type->definition : std::string_view()));
    if (const auto dropped = dropped_messages(reader.metadata(), topic.name)) {
      writer.count_dropped(topic.name, dropped);
    }
  }
  reader.select([&](const BagTopic& topic) { return topics.accepts(topic.name); });
  CopyResult result;
  while (const BagMessage* message = reader.next()) {
    writer.write(*handles[message->topic], message->timestamp_ns, message->data);
    ++result.copied;
  }
  writer.close();
  result.lost = reader.lost_messages();
  result.warnings = reader.warnings();
  return result;
}

}  // namespace panvo::recorder
