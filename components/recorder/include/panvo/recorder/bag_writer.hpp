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
#include "panvo/recorder/growing_metadata.hpp"
#include "panvo/recorder/storage.hpp"

namespace panvo::recorder {

class BagFileWriter;
class Descriptor;
class FileGuard;
class LatchedMessages;
class StorageError;

/// Default bag name of `ros2 bag record` in local time: "rosbag2_2026_11_20-23_05_00".
std::string dated_bag_name();

/// Writes a rosbag2 folder: metadata.yaml (version 9) and NAME_0.db3, NAME_1.db3 ... (ROS 2 Jazzy's schema 4), or
/// NAME_0.mcap ... (profile ros2).
///
/// Messages are committed in batches. After SIGKILL or power loss the bag holds every committed batch, so at most the
/// last batch is lost: Options::batch_time or batch_bytes, whichever comes first. Other tools can open such a .db3
/// directly, since between commits the .db3 alone is complete (rollback journal, no write-ahead log). Such an .mcap has
/// no summary; readers scan it.
///
/// Thread-safe. An internal thread commits pending messages when no more arrive.
class BagWriter {
 public:
  struct Options {
    bool overwrite = false;                     ///< replace an existing bag
    std::uint64_t max_file_bytes = 0;           ///< size at which the next file is started; 0: no limit
    std::chrono::nanoseconds max_file_time{0};  ///< time between stamps at which the next file is started; 0: no limit
    std::size_t max_files = 0;  ///< files kept: the oldest are removed, and each begins with the latched
                                ///< messages so far; 0: all
    std::chrono::milliseconds batch_time{500};  ///< age at which a batch is committed
    std::size_t batch_bytes = 16u << 20;        ///< size at which a batch is committed; bounds the writer's memory
    Storage storage = Storage::kSqlite3;
    Compression compression = Compression::kNone;  ///< MCAP only
    std::size_t chunk_bytes = 4u << 20;            ///< MCAP: size at which a chunk ends; readers hold whole chunks
  };

  /// Creates the bag and its first metadata.yaml. Throws BagError if the folder exists and `overwrite` is false or it
  /// is not a bag, if another writer has locked it, if it cannot be created or written, or if the storage does not
  /// support the compression.
  explicit BagWriter(std::filesystem::path bag) : BagWriter(std::move(bag), Options{}) {}
  BagWriter(std::filesystem::path bag, Options options);

  /// Calls close() and ignores its errors.
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Adds a topic; call once for each topic. `definition` is the type in ROS 2's .msg notation, empty if unknown.
  /// Returns the handle for write(). Throws BagError.
  int add_topic(const BagTopic& topic, std::string_view definition = {});
  /// As above, with the definition in any notation.
  int add_topic(const BagTopic& topic, const TypeDefinition& definition);

  /// Adds a message. Throws BagError if the bag cannot be written (disk full): committed messages stay readable, the
  /// current batch is lost, and every later call throws the same error. Also throws if the file was removed, moved or
  /// replaced, which is detected at a commit: the messages recorded so far are kept, and the error names the file that
  /// holds them.
  void write(int topic, std::int64_t timestamp_ns, std::span<const std::uint8_t> data);

  /// Counts messages of a topic that were dropped before write(); stored in the metadata's custom_data.
  void count_dropped(const std::string& topic, std::uint64_t count);

  /// Commits the current batch. Throws BagError.
  void commit();

  /// A file that was closed, and the next one.
  struct Split {
    std::filesystem::path closed, opened;
  };
  /// Closes the current file and starts the next one, unless the current one has no messages. Throws BagError.
  void split();
  /// Splits since the last call, whether asked for or by the limits of the options.
  std::vector<Split> take_splits();

  /// Commits, writes the final metadata and closes the files. Later calls of write() throw. Throws BagError.
  void close();

  const std::filesystem::path& path() const noexcept { return bag_; }
  std::uint64_t committed_messages() const;
  std::uint64_t lost_messages() const;  ///< messages of the batch that could not be committed
  std::uint64_t dropped_messages() const;

 private:
  struct Topic {
    BagTopic description;
    TypeDefinition definition;
  };
  using Clock = std::chrono::steady_clock;

  void open_next_file();
  void start_next_file();
  void remove_oldest_files();
  void insert(int topic, std::int64_t timestamp_ns, std::span<const std::uint8_t> data);
  void split_locked();
  bool is_full() const;
  bool is_file_empty() const;
  bool is_over(std::int64_t timestamp_ns) const;
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
  GrowingMetadata metadata_;                  // of the committed messages
  std::unique_ptr<LatchedMessages> latched_;  // null if no file is ever removed
  std::vector<Split> splits_;
  bool topics_changed_ = false;
  Clock::time_point metadata_saved_;

  Batch batch_;
  bool batch_open_ = false;
  Clock::time_point batch_deadline_;

  std::uint64_t lost_ = 0;
  std::optional<std::string> failure_;
  bool failure_told_ = false;
  bool folder_lost_ = false;  // the metadata.yaml at this path no longer belongs to this bag
  bool closed_ = false;
  std::jthread idle_committer_;  // declared last: is stopped first
};

}  // namespace panvo::recorder
