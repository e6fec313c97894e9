// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "panvo/recorder/bag_metadata.hpp"
#include "panvo/recorder/bag_writer.hpp"
#include "storage_error.hpp"

namespace panvo::recorder {

/// Writes one file of a bag, in any storage. Throws StorageError. Data written between begin() and commit() is complete
/// and durable when commit() returns, even after a power failure.
class BagFileWriter {
 public:
  virtual ~BagFileWriter() = default;
  BagFileWriter(const BagFileWriter&) = delete;
  BagFileWriter& operator=(const BagFileWriter&) = delete;

  virtual void begin() = 0;
  virtual void add_topic(int id, const BagTopic& topic, const TypeDefinition& definition) = 0;
  virtual void insert(int topic_id, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) = 0;
  virtual void insert_metadata(const std::string& yaml) = 0;
  virtual void commit() = 0;
  virtual void rollback() noexcept = 0;
  /// Completes the file; nothing can be written afterwards.
  virtual void finish() = 0;

  const std::filesystem::path& path() const noexcept { return path_; }
  /// Size of the committed data plus at most one batch.
  std::uint64_t size_bytes() const;

 protected:
  explicit BagFileWriter(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path path_;
};

/// Creates a file of the storage in `options`. Throws StorageError.
std::unique_ptr<BagFileWriter> make_file_writer(const std::filesystem::path& file, const BagWriter::Options& options,
                                                const std::string& ros_distro);

}  // namespace panvo::recorder
