// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "layout.hpp"

namespace panvo::recorder::mcap {
namespace {

constexpr std::size_t kWindow = 1u << 20;  // bytes read at a time when searching for the next record

/// Visits record after record and builds a Layout.
class Scan {
 public:
  explicit Scan(const InputFile& file) : file_(file) {}

  Layout run() {
    layout_.is_scanned = true;
    const auto begin = file_.read(0, kMagic.size());
    std::uint64_t at = std::equal(kMagic.begin(), kMagic.end(), begin.begin(), begin.end()) ? kMagic.size() : 0;
    take_channels_of_summary();
    while (at < file_.size() && !at_footer_) {
      const auto next = take_record(at);
      at = next > at ? next : leap(at);
    }
    if (unknown_channel_ > 0) {
      layout_.faults.push_back(std::to_string(unknown_channel_) +
                               " messages belong to unknown channels and are skipped");
    }
    // Statistics, if readable, give the original number of messages.
    layout_.lost = std::max(layout_.lost, counted_ - std::min(counted_, layout_.message_count()));
    layout_.is_whole = at_footer_ && layout_.faults.empty() && layout_.lost == 0;
    return std::move(layout_);
  }

 private:
  Bytes content(std::uint64_t at, const RecordHead& head) const {
    if (head.length > kMaxRecordBytes) {
      throw FormatError("is too large");
    }
    auto bytes = file_.read(at + RecordHead::kBytes, head.length);
    if (bytes.size() < head.length) {
      throw FormatError("is cut off");
    }
    return bytes;
  }

  /// Returns the position after the record at `at`, or `at` if there is no valid record.
  std::uint64_t take_record(std::uint64_t at) {
    const auto bytes = file_.read(at, RecordHead::kBytes);
    if (bytes.size() < RecordHead::kBytes) {
      return is_magic(at) ? file_.size() : at;
    }
    const auto head = parse_record_head(bytes);
    const auto rest = file_.size() - at - RecordHead::kBytes;
    try {
      if (head.opcode == Opcode::kChunk) {
        return take_chunk(at, head);
      }
      if (!head.is_known() || head.length > rest) {
        return at;
      }
      if (head.opcode == Opcode::kMessage) {
        return take_message(at, head);
      }
      take_other(at, head);
    } catch (const FormatError&) {
      return at;
    }
    return at + RecordHead::kBytes + head.length;
  }

  std::uint64_t take_chunk(std::uint64_t at, const RecordHead& head) {
    auto chunk = read_chunk(file_, at);
    for (auto& schema : chunk.schemas) {
      layout_.schemas.try_emplace(schema.id, std::move(schema));
    }
    for (auto& channel : chunk.channels) {
      layout_.channels.try_emplace(channel.id, std::move(channel));
    }
    const auto rest = file_.size() - at - RecordHead::kBytes;
    const auto end = head.length > rest ? file_.size() : at + RecordHead::kBytes + head.length;
    Block block{.is_chunk = true,
                .begin = at,
                .end = end,
                .first_ns = std::numeric_limits<std::int64_t>::max(),
                .last_ns = std::numeric_limits<std::int64_t>::min()};
    std::uint64_t count = 0;
    for (const auto& message : chunk.messages) {
      if (is_known(message)) {
        block.first_ns = std::min(block.first_ns, message.log_time);
        block.last_ns = std::max(block.last_ns, message.log_time);
        ++block.channels[message.channel];
        count_message(message);
        ++count;
      }
    }
    if (!chunk.fault.empty()) {
      layout_.faults.push_back("the chunk at byte " + std::to_string(at) + " " + chunk.fault + "; " +
                               std::to_string(count) + " of its messages can be read");
      layout_.lost += chunk.lost;
    }
    if (count > 0) {
      layout_.blocks.push_back(std::move(block));
    }
    return end;
  }

  std::uint64_t take_message(std::uint64_t at, const RecordHead& head) {
    StoredMessage message;
    const auto data = at + RecordHead::kBytes + MessageHead::kBytes;
    const auto bytes = file_.read(at + RecordHead::kBytes, MessageHead::kBytes);
    if (head.length < MessageHead::kBytes ||
        !describe(parse_message_head(bytes), data, head.length - MessageHead::kBytes, message)) {
      return at;
    }
    const auto end = at + RecordHead::kBytes + head.length;
    if (is_known(message)) {
      add_lone_message(layout_, message, at, end);
      count_message(message);
    }
    return end;
  }

  void take_other(std::uint64_t at, const RecordHead& head) {
    if (head.opcode == Opcode::kSchema) {
      auto schema = parse_schema(content(at, head));
      layout_.schemas.try_emplace(schema.id, std::move(schema));
    } else if (head.opcode == Opcode::kChannel) {
      auto channel = parse_channel(content(at, head));
      layout_.channels.try_emplace(channel.id, std::move(channel));
    } else if (head.opcode == Opcode::kMetadata) {
      take_metadata(layout_, content(at, head));
    } else if (head.opcode == Opcode::kStatistics) {
      counted_ = parse_statistics(content(at, head)).message_count;
    } else if (head.opcode == Opcode::kFooter) {
      at_footer_ = true;
    }
  }

  /// Reads the channels in the summary, since the chunk that defines them may be lost.
  void take_channels_of_summary() {
    constexpr std::uint64_t kFooterAndMagic = RecordHead::kBytes + Footer::kBytes + kMagic.size();
    if (file_.size() < kFooterAndMagic) {
      return;
    }
    try {
      const auto footer_at = file_.size() - kFooterAndMagic;
      const auto bytes = file_.read(footer_at, kFooterAndMagic);
      if (parse_record_head(bytes).opcode != Opcode::kFooter) {
        return;
      }
      auto at = parse_footer(ByteSpan(bytes).subspan(RecordHead::kBytes)).summary_start;
      while (at > 0 && at < footer_at) {
        const auto head = parse_record_head(file_.read(at, RecordHead::kBytes));
        if (head.opcode == Opcode::kSchema || head.opcode == Opcode::kChannel) {
          take_other(at, head);
        }
        if (!head.is_known() || head.length > footer_at - at) {
          return;
        }
        at += RecordHead::kBytes + head.length;
      }
    } catch (const FormatError&) {
    }
  }

  bool is_known(const StoredMessage& message) {
    const bool known = layout_.channels.contains(message.channel);
    if (!known) {
      ++unknown_channel_;
      ++layout_.lost;
    }
    return known;
  }

  void count_message(const StoredMessage& message) {
    const bool first = layout_.messages.empty();
    layout_.first_ns = first ? message.log_time : std::min(layout_.first_ns, message.log_time);
    layout_.last_ns = first ? message.log_time : std::max(layout_.last_ns, message.log_time);
    ++layout_.messages[message.channel];
  }

  bool is_magic(std::uint64_t at) const {
    const auto bytes = file_.read(at, kMagic.size());
    return bytes.size() == kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
  }

  /// Skips damaged data. Returns the position of the next plausible record, or the end of the file.
  std::uint64_t leap(std::uint64_t from) {
    for (auto window = from + 1; window < file_.size(); window += kWindow) {
      const auto bytes = file_.read(window, kWindow + kLookAhead);
      for (std::size_t i = 0; i < std::min(kWindow, bytes.size()); ++i) {
        if (looks_like_a_record(ByteSpan(bytes).subspan(i), window + i)) {
          layout_.faults.push_back("bytes " + std::to_string(from) + " to " + std::to_string(window + i) +
                                   " are damaged and skipped");
          ++layout_.lost;  // at least
          return window + i;
        }
      }
    }
    layout_.faults.push_back("the data from byte " + std::to_string(from) + " on are cut off or damaged");
    const auto first = file_.read(from, 1);
    const auto opcode = first.empty() ? Opcode::kMessage : static_cast<Opcode>(first.front());
    const bool holds_no_message = opcode != Opcode::kMessage && opcode >= Opcode::kHeader && opcode <= Opcode::kDataEnd;
    layout_.lost += holds_no_message ? 0 : 1;
    return file_.size();
  }

  /// A chunk states its size twice; a message must have a known channel and be followed by a record.
  bool looks_like_a_record(ByteSpan bytes, std::uint64_t at) const {
    const auto opcode = static_cast<Opcode>(bytes.front());
    if ((opcode != Opcode::kChunk && opcode != Opcode::kMessage) || bytes.size() < kLookAhead) {
      return false;
    }
    try {
      const auto head = parse_record_head(bytes);
      const auto content = bytes.subspan(RecordHead::kBytes, kLookAhead - RecordHead::kBytes);
      if (opcode == Opcode::kChunk) {
        parse_chunk_head(content, head.length);
        return true;
      }
      StoredMessage message;
      if (head.length < MessageHead::kBytes || head.length > file_.size() - at ||
          !describe(parse_message_head(content), at, head.length, message) ||
          !layout_.channels.contains(message.channel)) {
        return false;
      }
      const auto next = parse_record_head(file_.read(at + RecordHead::kBytes + head.length, RecordHead::kBytes));
      return next.opcode >= Opcode::kSchema && next.opcode <= Opcode::kDataEnd && next.length <= file_.size() - at;
    } catch (const FormatError&) {
      return false;
    }
  }

  static constexpr std::size_t kLookAhead = 64;  // a chunk's header with the name of the compression

  const InputFile& file_;
  Layout layout_;
  std::uint64_t counted_ = 0;
  std::uint64_t unknown_channel_ = 0;
  bool at_footer_ = false;
};

}  // namespace

Layout scan(const InputFile& file) { return Scan(file).run(); }

}  // namespace panvo::recorder::mcap
