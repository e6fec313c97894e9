// SPDX-License-Identifier: Apache-2.0
#include "mcap_file_reader.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include "check.hpp"
#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder::mcap {
namespace {

BagTopic topic_of(const Channel& channel, const std::map<std::uint16_t, Schema>& schemas, bool& understood) {
  const auto text = [&](const char* key) {
    const auto found = channel.metadata.find(key);
    return found == channel.metadata.end() ? std::string() : found->second;
  };
  BagTopic topic;
  topic.name = channel.topic;
  if (const auto schema = schemas.find(channel.schema_id); schema != schemas.end()) {
    topic.type = schema->second.name;
  }
  topic.serialization_format = channel.message_encoding;
  auto profiles = parse_qos_profiles(text("offered_qos_profiles"));
  understood = profiles.has_value();
  topic.offered_qos_profiles = std::move(profiles).value_or(std::vector<QosProfile>{});
  topic.type_description_hash = text("topic_type_hash");
  return topic;
}

}  // namespace

bool McapFileReader::OpenBlock::comes_before(const OpenBlock& other) const {
  const auto key = [](const OpenBlock& block) {
    return std::tuple(block.front().message.log_time, block.index, block.front().number);
  };
  return key(*this) < key(other);
}

McapFileReader::McapFileReader(std::filesystem::path file, std::vector<std::string>& warnings,
                               std::size_t max_held_bytes)
    : BagFileReader(std::move(file), warnings), max_held_bytes_(max_held_bytes), file_(path_) {
  std::string reason;
  if (auto layout = read_summary(file_, reason)) {
    layout_ = std::move(*layout);
  } else {
    read_through(reason);
  }
  describe();
  order_.resize(layout_.blocks.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return layout_.blocks[a].first_ns < layout_.blocks[b].first_ns;
  });
}

void McapFileReader::read_through(const std::string& reason) {
  layout_ = scan(file_);
  layout_.is_whole = layout_.is_whole && reason.empty();
  if (layout_.is_whole) {
    return;
  }
  const auto what = reason.empty() ? "it is damaged" : reason;
  if (layout_.channels.empty() && layout_.lost > 0) {
    throw BagError(path_.string() + ": nothing in it can be read (" + what +
                   "; no topics found); use another copy of the bag");
  }
  warnings_.push_back(path_.string() + ": " + what + "; " + std::to_string(layout_.message_count()) +
                      " messages can be read (`panvo bag copy` writes them to a valid bag)");
  for (const auto& fault : layout_.faults) {
    warnings_.push_back(path_.string() + ": " + fault);
  }
}

void McapFileReader::describe() {
  for (const auto& [id, channel] : layout_.channels) {
    bool understood = true;
    content_.topics.emplace(id, topic_of(channel, layout_.schemas, understood));
    if (!understood) {
      warnings_.push_back(path_.string() + ": the QoS profiles of topic " + channel.topic +
                          " cannot be parsed; using the ROS 2 default");
    }
    wanted_.insert(id);
  }
  for (const auto& [id, schema] : layout_.schemas) {
    content_.definitions[schema.name] = {schema.encoding, schema.data};
  }
  if (layout_.bag_metadata) {
    try {
      content_.stored_metadata = parse_metadata(*layout_.bag_metadata, path_);
      content_.ros_distro = content_.stored_metadata->ros_distro;
    } catch (const BagError&) {
      // Optional data, used only if metadata.yaml is missing.
    }
  }
  content_.message_count = layout_.message_count();
  if (content_.message_count > 0) {
    content_.first_ns = layout_.first_ns;
    content_.last_ns = layout_.last_ns;
  }
}

std::uint64_t McapFileReader::lost() const noexcept {
  return std::accumulate(damaged_.begin(), damaged_.end(), layout_.lost,
                         [](std::uint64_t sum, const auto& block) { return sum + block.second; });
}

std::map<std::int64_t, std::uint64_t> McapFileReader::count_by_topic() {
  return {layout_.messages.begin(), layout_.messages.end()};
}

void McapFileReader::select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) {
  wanted_ = std::move(topic_ids);
  begin_ns_ = begin_ns;
  next_block_ = 0;
  open_.clear();
}

bool McapFileReader::next(Entry& entry, interfaces::Bytes& data) {
  while (true) {
    open_blocks_up_to_now();
    if (open_.empty()) {
      return false;
    }
    const auto block =
        std::min_element(open_.begin(), open_.end(), [](const auto& a, const auto& b) { return a.comes_before(b); });
    const auto place = block->places[block->next++];
    const bool is_read = read_data(*block, place.message, data);
    if (is_read) {
      entry = {place.message.log_time, static_cast<std::int64_t>((block->index << 32) | place.number),
               place.message.channel};
    } else {
      ++damaged_[block->index];
    }
    if (block->next == block->places.size()) {
      open_.erase(block);
    }
    if (is_read) {
      return true;
    }
  }
}

/// Opens every block that may hold a message earlier than those of the open blocks.
void McapFileReader::open_blocks_up_to_now() {
  const auto first_open = [this] {
    return std::accumulate(
        open_.begin(), open_.end(), std::numeric_limits<std::int64_t>::max(),
        [](std::int64_t least, const OpenBlock& block) { return std::min(least, block.front().message.log_time); });
  };
  for (auto now = first_open(); next_block_ < order_.size(); ++next_block_) {
    const auto index = order_[next_block_];
    if (layout_.blocks[index].first_ns > now) {
      return;
    }
    if (is_wanted(layout_.blocks[index])) {
      open_block(index);
      now = first_open();
    }
  }
}

bool McapFileReader::is_wanted(const Block& block) const {
  return block.last_ns >= begin_ns_ &&
         (block.channels.empty() ||
          std::any_of(block.channels.begin(), block.channels.end(),
                      [this](const auto& channel) { return wanted_.contains(channel.first); }));
}

void McapFileReader::open_block(std::size_t index) {
  const auto& block = layout_.blocks[index];
  OpenBlock opened{.index = index};
  std::vector<StoredMessage> messages;
  if (block.is_chunk) {
    try {
      auto chunk = read_chunk(file_, block.begin);
      report(index, chunk);
      messages = std::move(chunk.messages);
      opened.bytes = std::move(chunk.bytes);
    } catch (const FormatError& error) {
      Chunk none;
      none.fault = error.what();
      none.lost = 1;  // at least
      report(index, none);
    }
  } else {
    messages = read_lone_messages(file_, block);
  }
  std::uint32_t number = 0;
  for (const auto& message : messages) {
    if (wanted_.contains(message.channel) && message.log_time >= begin_ns_) {
      opened.places.push_back({message, number});
    }
    ++number;
  }
  std::stable_sort(opened.places.begin(), opened.places.end(),
                   [](const Place& a, const Place& b) { return a.message.log_time < b.message.log_time; });
  if (!opened.places.empty()) {
    opened.used = ++uses_;
    open_.push_back(std::move(opened));
    limit_held_bytes(open_.back());
  }
}

/// Adds a warning for damage that the summary did not reveal. A scan has already reported all damage.
void McapFileReader::report(std::size_t index, const Chunk& chunk) {
  if (chunk.fault.empty() || layout_.is_scanned || damaged_.contains(index)) {
    return;
  }
  damaged_[index] = chunk.lost;
  warnings_.push_back(path_.string() + ": the chunk at byte " + std::to_string(layout_.blocks[index].begin) + " " +
                      chunk.fault + "; " + std::to_string(chunk.messages.size()) + " of its messages can be read, " +
                      std::to_string(chunk.lost) + " are lost");
}

bool McapFileReader::read_data(OpenBlock& block, const StoredMessage& message, interfaces::Bytes& data) {
  if (!layout_.blocks[block.index].is_chunk) {
    data = file_.read(message.offset, message.size);
    return data.size() == message.size;
  }
  if (!block.bytes) {
    try {
      block.bytes = read_chunk(file_, layout_.blocks[block.index].begin).bytes;
    } catch (const FormatError&) {
      block.bytes.emplace();
    }
    limit_held_bytes(block);
  }
  block.used = ++uses_;
  if (message.offset > block.bytes->size() || message.size > block.bytes->size() - message.offset) {
    return false;
  }
  const auto begin = block.bytes->begin() + static_cast<std::ptrdiff_t>(message.offset);
  data.assign(begin, begin + message.size);
  return true;
}

/// Releases the least recently used chunks.
void McapFileReader::limit_held_bytes(const OpenBlock& keep) {
  const auto held = [this] {
    return std::accumulate(open_.begin(), open_.end(), std::size_t{0}, [](std::size_t sum, const OpenBlock& block) {
      return sum + (block.bytes ? block.bytes->size() : 0);
    });
  };
  while (held() > max_held_bytes_) {
    OpenBlock* oldest = nullptr;
    for (auto& block : open_) {
      if (&block != &keep && block.bytes && (!oldest || block.used < oldest->used)) {
        oldest = &block;
      }
    }
    if (!oldest) {
      return;
    }
    oldest->bytes.reset();
  }
}

std::vector<std::string> McapFileReader::check_integrity() {
  auto complaints = check(file_, layout_);
  for (auto& complaint : complaints) {
    complaint.insert(0, path_.string() + ": ");
  }
  return complaints;
}

}  // namespace panvo::recorder::mcap
