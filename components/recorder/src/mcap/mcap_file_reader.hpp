// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bag_file_reader.hpp"
#include "input_file.hpp"
#include "layout.hpp"

namespace panvo::recorder::mcap {

/// Reads a .mcap file by its index, or by scanning it if the index is missing or damaged.
///
/// A chunk is read when its first message is due. For chunks that overlap in time the reader holds the message
/// locations, 32 bytes each, and at most kMaxHeldBytes of data; released data is read again when needed.
class McapFileReader final : public BagFileReader {
 public:
  static constexpr std::size_t kMaxHeldBytes = 256u << 20;

  /// Throws BagError if nothing in the file is readable.
  McapFileReader(std::filesystem::path file, std::vector<std::string>& warnings,
                 std::size_t max_held_bytes = kMaxHeldBytes);

  Storage storage() const noexcept override { return Storage::kMcap; }
  bool damaged() const noexcept override { return !layout_.is_whole; }
  std::uint64_t lost() const noexcept override;

  std::map<std::int64_t, std::uint64_t> count_by_topic() override;
  void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) override;
  bool next(Entry& entry, interfaces::Bytes& data) override;
  /// Checks every record, checksum, index and count.
  std::vector<std::string> check_integrity() override;

 private:
  struct Place {
    StoredMessage message;
    std::uint32_t number = 0;  ///< within its block
  };
  /// A block that contains messages due now.
  struct OpenBlock {
    std::size_t index = 0;        ///< into layout_.blocks
    std::vector<Place> places{};  ///< of the selected messages, ordered by time, then number
    std::size_t next = 0;
    std::optional<Bytes> bytes{};  ///< of a chunk, while held in memory
    std::uint64_t used = 0;        ///< value of uses_ at the last use of `bytes`

    const Place& front() const { return places[next]; }
    bool comes_before(const OpenBlock& other) const;
  };

  void read_through(const std::string& reason);
  void describe();
  bool is_wanted(const Block& block) const;
  void open_block(std::size_t index);
  void report(std::size_t index, const Chunk& chunk);
  void open_blocks_up_to_now();
  bool read_data(OpenBlock& block, const StoredMessage& message, interfaces::Bytes& data);
  void limit_held_bytes(const OpenBlock& keep);

  const std::size_t max_held_bytes_;
  InputFile file_;
  Layout layout_;
  std::vector<std::size_t> order_;                // block indices by time
  std::map<std::size_t, std::uint64_t> damaged_;  // lost messages of each damaged block
  std::set<std::int64_t> wanted_;
  std::int64_t begin_ns_ = INT64_MIN;
  std::size_t next_block_ = 0;  // into order_
  std::vector<OpenBlock> open_;
  std::uint64_t uses_ = 0;
};

}  // namespace panvo::recorder::mcap
