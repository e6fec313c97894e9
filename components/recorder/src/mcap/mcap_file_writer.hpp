// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "bag_file_writer.hpp"
#include "panvo/recorder/storage.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// Writes a .mcap file of profile ros2: chunks with message indexes, and a summary at finish().
///
/// A commit writes the current chunk, so that a killed process leaves complete chunks, which every reader finds.
/// Schemas and channels precede the chunks, so that a damaged chunk does not lose them.
class McapFileWriter final : public BagFileWriter {
 public:
  struct Options {
    Compression compression = Compression::kNone;
    std::size_t chunk_bytes = 4u << 20;  ///< size at which a chunk ends; a single message may be larger
  };

  McapFileWriter(const std::filesystem::path& file, const Options& options);
  ~McapFileWriter() override;

  void begin() override {}
  void add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) override;
  void insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) override;
  void insert_metadata(const std::string& yaml) override;
  void commit() override;
  void rollback() noexcept override;
  void finish() override;

 private:
  void write(ByteSpan bytes);
  void write_chunk();
  void sync();
  Bytes make_summary(std::uint64_t start) const;

  const Options options_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;            // written
  std::uint64_t committed_size_ = 0;  // synced to disk

  Bytes records_;  // of the current chunk
  std::map<std::uint16_t, MessageIndex> indexes_;
  std::uint64_t chunk_start_ = 0, chunk_end_ = 0;
  Bytes outside_;  // pending records that precede the chunk

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::map<std::uint16_t, std::uint32_t> sequences_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;
};

}  // namespace panvo::recorder::mcap
