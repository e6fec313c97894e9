// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "panvo/recorder/bag_error.hpp"
#include "panvo/recorder/bag_metadata.hpp"
#include "panvo/recorder/storage.hpp"

namespace panvo::recorder {

class BagFileWriter;
class Descriptor;
class FileGuard;
class StorageError;

/// "rosbag2_2026_11_20-23_05_00": how `ros2 bag record` names a bag that was given no name. Local time.
std::string dated_bag_name();

/// Writes a rosbag2 folder: metadata.yaml (version 9) and NAME_0.db3, NAME_1.db3 ... (ROS 2 Jazzy's schema 4), or
/// NAME_0.mcap ... (profile ros2).
///
/// Messages are committed in batches. When the process is killed or the power fails, the bag holds every committed
/// batch. A .db3 then opens at once in every other tool too, for between commits all of it is in the .db3 file (a
/// rollback journal, no write-ahead log); of an .mcap the summary is missing, and readers read through it. A killed
/// process loses at most the last batch: Options::batch_time or batch_bytes, whichever comes first.
///
/// Safe to use from several threads; a thread of the writer's commits what has waited when no further message comes.
class BagWriter {
 public:
  struct Options {
    bool overwrite = false;                     ///< replace a bag that is already there
    std::uint64_t max_file_bytes = 0;           ///< start the next file when one has reached this size; 0: one file
    std::chrono::milliseconds batch_time{500};  ///< age at which a batch is committed
    std::size_t batch_bytes = 16u << 20;        ///< size at which it is; also what the writer holds in memory
    Storage storage = Storage::kSqlite3;
    Compression compression = Compression::kNone;  ///< of MCAP only
    std::size_t chunk_bytes = 4u << 20;            ///< of MCAP: size at which a chunk ends; what a reader must hold
  };

  /// Creates the bag and its first metadata.yaml. Throws BagError: the folder exists and is not to be overwritten or
  /// is no bag, another writer is at it, it cannot be made, or is not writable; the storage does not compress.
  explicit BagWriter(std::filesystem::path bag) : BagWriter(std::move(bag), Options{}) {}
  BagWriter(std::filesystem::path bag, Options options);

  /// close(), errors lost.
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Declares a topic, once. `definition` is the type in ROS 2's .msg notation, empty where not known. Returns its
  /// handle for write().
  int add_topic(const BagTopic& topic, std::string_view definition = {});
  /// The same, in any notation.
  int add_topic(const BagTopic& topic, const TypeDefinition& definition);

  /// Adds a message. Throws BagError when the bag cannot be written (disk full): what was committed stays readable,
  /// the batch being written is lost, and every later call throws the same. Likewise when its file was removed, moved or replaced meanwhile, which
  /// is noticed when a batch is committed: what was recorded until then is kept, and the error says where.
  void write(int topic, std::int64_t timestamp_ns, std::span<const std::uint8_t> data);

  /// Says that messages of a topic were dropped before they could be written; kept in the metadata's custom_data.
  void count_dropped(const std::string& topic, std::uint64_t count);

  /// Commits what waits. Throws BagError.
  void commit();

  /// Commits, finishes the metadata and closes the files. Throws BagError; nothing can be written afterwards.
  void close();

  const std::filesystem::path& path() const noexcept { return bag_; }
  std::uint64_t committed_messages() const;
  std::uint64_t lost_messages() const;  ///< of a batch that could not be committed
  std::uint64_t dropped_messages() const;

 private:
  struct Topic {
    BagTopic description;
    TypeDefinition definition;
    std::uint64_t waiting = 0;  ///< messages of the batch
  };
  using Clock = std::chrono::steady_clock;

  std::unique_ptr<BagFileWriter> make_file(const std::filesystem::path& file) const;
  void open_next_file();
  void begin_batch();
  void commit_locked();
  void finish_file();
  void check_file();
  void save_metadata(bool durable);
  void fail(const StorageError& error);
  void fail(std::string text);
  void throw_failure();
  void commit_when_idle(std::stop_token stop);

  const std::filesystem::path bag_;
  const Options options_;

  mutable std::mutex mutex_;  // guards all below
  std::condition_variable_any batch_begun_;
  std::unique_ptr<Descriptor> folder_lock_;
  std::unique_ptr<BagFileWriter> file_;
  std::unique_ptr<FileGuard> guard_;  // of file_
  std::vector<Topic> topics_;
  BagMetadata metadata_;  // of what is committed
  bool topics_changed_ = false;
  Clock::time_point metadata_saved_;

  std::uint64_t batch_messages_ = 0;
  std::size_t batch_size_ = 0;
  bool batch_open_ = false;
  Clock::time_point batch_deadline_;
  std::int64_t batch_first_ns_ = 0, batch_last_ns_ = 0;

  std::uint64_t lost_ = 0;
  std::optional<std::string> failure_;
  bool failure_told_ = false;
  bool folder_lost_ = false;  // metadata.yaml there is not this bag's any more
  bool closed_ = false;
  std::jthread idle_committer_;  // last, so that it stops first
};

}  // namespace panvo::recorder
