// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "bag_file_writer.hpp"
#include "panvo/recorder/storage.hpp"
#include "record.hpp"

namespace panvo::recorder::mcap {

/// A .mcap file of profile ros2: chunks, each with the indexes of its messages, and a summary when it is finished.
///
/// How it survives: a commit writes the chunk that is being filled, so that a process that is killed leaves whole
/// chunks behind, which every reader finds. Schemas and channels lie before the chunks rather than in them: a chunk
/// that is damaged takes none of them along.
class McapFileWriter final : public BagFileWriter {
 public:
  struct Options {
    Compression compression = Compression::kNone;
    std::size_t chunk_bytes = 4u << 20;  ///< size at which a chunk is ended; one message may be larger
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
  std::uint64_t committed_size_ = 0;  // and known to be on the disk

  Bytes records_;  // of the chunk that is being filled
  std::map<std::uint16_t, MessageIndex> indexes_;
  std::uint64_t chunk_start_ = 0, chunk_end_ = 0;
  Bytes outside_;  // records that come before it

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::map<std::uint16_t, std::uint32_t> sequences_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;
};

}  // namespace panvo::recorder::mcap
