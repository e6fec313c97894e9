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

/// A .mcap file: by its index where it has one, by reading through it where it is cut off or damaged.
///
/// Chunks are read when their time comes. Of those whose times overlap the messages' places are held, 32 bytes each,
/// and of their bytes as much as fits kMostHeldBytes; what more is needed is read again.
class McapFileReader final : public BagFileReader {
 public:
  static constexpr std::size_t kMostHeldBytes = 256u << 20;

  /// Throws BagError when nothing of the file can be read.
  McapFileReader(std::filesystem::path file, std::vector<std::string>& warnings,
                 std::size_t most_held_bytes = kMostHeldBytes);

  Storage storage() const noexcept override { return Storage::kMcap; }
  bool damaged() const noexcept override { return !layout_.is_whole; }
  std::uint64_t lost() const noexcept override;

  std::map<std::int64_t, std::uint64_t> count_by_topic() override;
  void select(std::set<std::int64_t> topic_ids, std::int64_t begin_ns) override;
  bool next(Entry& entry, interfaces::Bytes& data) override;
  /// Every record, checksum, index and count.
  std::vector<std::string> check_integrity() override;

 private:
  struct Place {
    StoredMessage message;
    std::uint32_t number = 0;  ///< within its block
  };
  /// A block whose time has come.
  struct OpenBlock {
    std::size_t index = 0;        ///< into layout_.blocks
    std::vector<Place> places{};  ///< of the wanted messages, in order of time, then number
    std::size_t next = 0;
    std::optional<Bytes> bytes{};  ///< of a chunk, while they are held
    std::uint64_t used = 0;        ///< when they were last

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

  const std::size_t most_held_bytes_;
  InputFile file_;
  Layout layout_;
  std::vector<std::size_t> order_;                // of the blocks, by time
  std::map<std::size_t, std::uint64_t> damaged_;  // blocks that were found to be, with the messages lost of each
  std::set<std::int64_t> wanted_;
  std::int64_t begin_ns_ = INT64_MIN;
  std::size_t next_block_ = 0;  // into order_
  std::vector<OpenBlock> open_;
  std::uint64_t uses_ = 0;
};

}  // namespace panvo::recorder::mcap
