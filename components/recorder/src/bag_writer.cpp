// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_writer.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bag_file_writer.hpp"
#include "bag_folder.hpp"
#include "durable_file.hpp"
#include "file_guard.hpp"
#include "latched_messages.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

/// Longest time for which metadata.yaml may be outdated; readers detect this and use the files.
constexpr std::chrono::seconds kMetadataPeriod{5};

/// Of latched messages repeated in each file; less where the files are small.
constexpr std::uint64_t kMaxLatchedBytes = 16u << 20;

/// The files are named after the folder, which has no name in "bag/".
fs::path without_slash_at_end(const fs::path& folder) {
  return folder.filename().empty() ? folder.parent_path() : folder;
}

}  // namespace

BagWriter::BagWriter(fs::path bag, Options options)
    : bag_(without_slash_at_end(fs::absolute(bag).lexically_normal())), options_(std::move(options)) {
  if (options_.storage == Storage::kSqlite3 && options_.compression != Compression::kNone) {
    throw BagError(bag_.string() + ": the storage sqlite3 does not support compression; choose the storage mcap for " +
                   to_text(options_.compression));
  }
  folder_lock_ = std::make_unique<Descriptor>(take_folder(bag_, options_.overwrite));
  metadata_->storage_identifier = to_text(options_.storage);
  if (options_.max_files > 0) {
    const auto half_a_file = options_.max_file_bytes > 0 ? options_.max_file_bytes / 2 : kMaxLatchedBytes;
    latched_ = std::make_unique<LatchedMessages>(std::min(kMaxLatchedBytes, half_a_file));
  }
  const std::unique_lock lock(mutex_);
  open_next_file();
  write_metadata(bag_, *metadata_, true);
  metadata_saved_ = Clock::now();
  idle_committer_ = std::jthread([this](std::stop_token stop) { commit_when_idle(stop); });
}

BagWriter::~BagWriter() {
  try {
    close();
  } catch (const BagError&) {
  }
}

int BagWriter::add_topic(const BagTopic& topic, std::string_view definition) {
  return add_topic(topic, definition.empty() ? TypeDefinition{} : TypeDefinition{"ros2msg", std::string(definition)});
}

int BagWriter::add_topic(const BagTopic& topic, const TypeDefinition& definition) {
  const std::unique_lock lock(mutex_);
  const int handle = static_cast<int>(topics_.size());
  topics_.push_back({topic, definition});
  topics_.back().description.message_count = 0;
  metadata_->topics.push_back(topics_.back().description);
  topics_changed_ = true;
  try {
    begin_batch();
    file_->add_topic(handle + 1, topics_.back().description, definition);
  } catch (const StorageError& error) {
    fail(error);
  }
  return handle;
}

void BagWriter::write(int topic, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) {
  const std::unique_lock lock(mutex_);
  if (is_over(timestamp_ns)) split_locked();
  if (latched_ && is_file_empty()) {
    for (const auto& message : latched_->all()) insert(message.topic, timestamp_ns, message.data);
  }
  insert(topic, timestamp_ns, data);
  if (latched_ && is_latched(topics_[static_cast<std::size_t>(topic)].description)) latched_->add(topic, data);
  if (batch_.bytes >= options_.batch_bytes || Clock::now() >= batch_deadline_) {
    commit_locked();
  }
}

void BagWriter::insert(int topic, std::int64_t timestamp_ns, std::span<const std::uint8_t> data) {
  try {
    begin_batch();
    file_->insert(topic + 1, timestamp_ns, data);
  } catch (const StorageError& error) {
    ++batch_.messages;
    fail(error);
  }
  batch_.add(static_cast<std::size_t>(topic), timestamp_ns, data.size());
}

void BagWriter::count_dropped(const std::string& topic, std::uint64_t count) {
  const std::unique_lock lock(mutex_);
  set_dropped_messages(*metadata_, topic, recorder::dropped_messages(*metadata_, topic) + count);
  set_dropped_messages(*metadata_, "", recorder::dropped_messages(*metadata_) + count);
}

void BagWriter::commit() {
  const std::unique_lock lock(mutex_);
  commit_locked();
}

void BagWriter::split() {
  const std::unique_lock lock(mutex_);
  split_locked();
}

void BagWriter::split_locked() {
  commit_locked();
  if (!is_file_empty()) start_next_file();  // else the commit has filled the file, and started the next one
}

std::vector<BagWriter::Split> BagWriter::take_splits() {
  const std::unique_lock lock(mutex_);
  return std::exchange(splits_, {});
}

void BagWriter::close() {
  idle_committer_.request_stop();
  const std::unique_lock lock(mutex_);
  if (closed_) {
    return;
  }
  closed_ = true;
  const auto lock_until_then = std::move(folder_lock_);
  if (failure_) {
    file_.reset();
    save_metadata(true);
    if (!failure_told_) {
      throw_failure();
    }
    return;
  }
  commit_locked();
  finish_file();
  save_metadata(true);
}

std::uint64_t BagWriter::committed_messages() const {
  const std::unique_lock lock(mutex_);
  return metadata_->message_count;
}

std::uint64_t BagWriter::lost_messages() const {
  const std::unique_lock lock(mutex_);
  return lost_;
}

std::uint64_t BagWriter::dropped_messages() const {
  const std::unique_lock lock(mutex_);
  return recorder::dropped_messages(*metadata_);
}

void BagWriter::open_next_file() {
  const auto name = bag_.filename().string() + "_" + std::to_string(metadata_.files_begun()) +
                    (options_.storage == Storage::kMcap ? ".mcap" : ".db3");
  metadata_.begin_file(name);
  try {
    file_ = make_file_writer(bag_ / name, options_, metadata_->ros_distro);
    guard_ = std::make_unique<FileGuard>(bag_ / name);
    file_->begin();
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      file_->add_topic(static_cast<int>(i) + 1, topics_[i].description, topics_[i].definition);
    }
    // Its version tells readers the notation of this file's QoS profiles.
    file_->insert_metadata(to_yaml(*metadata_, true));
    file_->commit();
    sync_folder(bag_);
  } catch (const StorageError& error) {
    fail(error);
  }
}

void BagWriter::begin_batch() {
  throw_failure();
  if (closed_) {
    throw BagError(bag_.string() + ": is closed; nothing can be added to it");
  }
  if (!batch_open_) {
    file_->begin();
    batch_open_ = true;
    batch_deadline_ = Clock::now() + options_.batch_time;
    batch_begun_.notify_one();
  }
}

void BagWriter::commit_locked() {
  throw_failure();
  if (!batch_open_) {
    return;
  }
  try {
    file_->commit();
  } catch (const StorageError& error) {
    fail(error);
  }
  batch_open_ = false;
  metadata_.commit(std::exchange(batch_, {}));
  check_file();
  if (is_full() && !closed_) {
    start_next_file();
  } else if (topics_changed_ || Clock::now() - metadata_saved_ >= kMetadataPeriod) {
    save_metadata(false);
  }
}

bool BagWriter::is_full() const {
  return options_.max_file_bytes > 0 && file_->size_bytes() >= options_.max_file_bytes;
}

bool BagWriter::is_file_empty() const { return metadata_->files.back().message_count + batch_.messages == 0; }

bool BagWriter::is_over(std::int64_t timestamp_ns) const {
  if (options_.max_file_time.count() <= 0 || is_file_empty()) return false;
  const auto& file = metadata_->files.back();
  const auto start_ns = batch_.messages > 0 ? std::min(file.start_ns, batch_.first_ns) : file.start_ns;
  return timestamp_ns - start_ns >= options_.max_file_time.count();
}

void BagWriter::start_next_file() {
  throw_failure();
  if (closed_) {
    throw BagError(bag_.string() + ": is closed; nothing can be added to it");
  }
  const auto closed = bag_ / metadata_->files.back().path;
  finish_file();
  open_next_file();
  splits_.push_back({closed, bag_ / metadata_->files.back().path});
  remove_oldest_files();
}

/// Saves the metadata before a file is removed: so it never names a file that is missing.
void BagWriter::remove_oldest_files() {
  const auto removed =
      options_.max_files > 0 ? metadata_.remove_oldest(options_.max_files) : std::vector<std::string>();
  save_metadata(true);
  for (const auto& file : removed) {
    std::error_code ignored;  // a file that stays is found and read by readers
    fs::remove(bag_ / file, ignored);
  }
}

void BagWriter::finish_file() {
  try {
    file_->begin();
    file_->insert_metadata(to_yaml(*metadata_, true));
    file_->commit();
    file_->finish();
    file_.reset();
  } catch (const StorageError& error) {
    fail(error);
  }
}

/// Called after a commit: fails if the file was removed, moved or replaced, after preserving its content.
void BagWriter::check_file() {
  const auto loss = guard_->find_loss();
  if (!loss) {
    return;
  }
  const auto file = bag_ / metadata_->files.back().path;
  file_.reset();
  std::string text = file.string() + ": " + *loss + "; the recording has stopped. The " +
                     std::to_string(metadata_->message_count) + " messages recorded so far ";
  try {
    const auto kept = guard_->keep();
    folder_lost_ = kept != file;
    text += "are in " + kept.string();
  } catch (const fs::filesystem_error& error) {
    folder_lost_ = true;
    text += "could not be saved (" + std::string(error.what()) + ")";
  }
  save_metadata(true);
  fail(std::move(text));
}

void BagWriter::save_metadata(bool durable) {
  if (folder_lost_) {
    return;
  }
  topics_changed_ = false;
  metadata_saved_ = Clock::now();
  try {
    write_metadata(bag_, *metadata_, durable);
  } catch (const BagError&) {
    // E.g. a full disk: the previous metadata.yaml stays; readers trust the files over it.
  }
}

void BagWriter::fail(const StorageError& error) {
  if (file_) {
    file_->rollback();
  }
  batch_open_ = false;
  lost_ += std::exchange(batch_, {}).messages;
  std::string text = (bag_ / metadata_->files.back().path).string() + ": cannot be written (" + error.what() + ")";
  if (metadata_->message_count + lost_ > 0) {
    text += "; the " + std::to_string(metadata_->message_count) + " messages committed before stay readable, " +
            std::to_string(lost_) + " are lost";
  }
  fail(text + (error.is_disk() ? "; free some space or record to another disk" : ""));
}

void BagWriter::fail(std::string text) {
  failure_ = std::move(text);
  throw_failure();
}

void BagWriter::throw_failure() {
  if (failure_) {
    failure_told_ = true;
    throw BagError(*failure_);
  }
}

void BagWriter::commit_when_idle(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (batch_begun_.wait(lock, stop, [this] { return batch_open_; })) {
    const auto deadline = batch_deadline_;  // copied, since it is read without the lock
    batch_begun_.wait_until(lock, stop, deadline, [] { return false; });
    if (stop.stop_requested()) {
      return;  // close() commits
    }
    try {
      if (batch_open_ && Clock::now() >= batch_deadline_) {
        commit_locked();
      }
    } catch (const BagError&) {
      failure_told_ = false;  // the next write() or close() throws it
      return;
    }
  }
}

}  // namespace panvo::recorder
