// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_reader.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "bag_file_reader.hpp"
#include "bag_files.hpp"
#include "packed_message.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;

std::string plural(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

/// A file and its next message. Before the first advance(), next_ns() is the time of the file's first message.
struct BagReader::File {
  File(const fs::path& path, std::vector<std::string>& warnings) : reader(open_bag_file(path, warnings)) {}

  void advance() {
    started = true;
    at_end = !reader->next(entry, data);
    while (!at_end && is_cdr() && !unpack_message(data)) {
      ++packed_lost;
      at_end = !reader->next(entry, data);
    }
  }
  bool is_cdr() const { return reader->content().topics.at(entry.topic_id).serialization_format == "cdr"; }
  std::int64_t next_ns() const { return started ? entry.timestamp_ns : reader->content().first_ns; }
  std::uint64_t lost() const { return reader->lost() + packed_lost; }

  std::unique_ptr<BagFileReader> reader;
  std::uint64_t packed_lost = 0;                    // damaged messages with message compression
  std::map<std::int64_t, std::size_t> topic_by_id;  // index into the bag's topics
  bool started = false;
  bool at_end = false;
  BagFileReader::Entry entry;
  interfaces::Bytes data;
};

BagReader::BagReader(const fs::path& bag, Trust trust) : bag_(fs::absolute(bag).lexically_normal()) {
  if (bag_.filename().empty()) {
    bag_ = bag_.parent_path();  // "bag/"
  }
  auto found = find_bag_files(bag_, trust == Trust::kMetadata, warnings_);
  folder_ = found.folder;
  for (const auto& file : found.files) {
    open_file(file);
  }
  if (files_.empty()) {
    throw BagError(warnings_.back());
  }
  describe(found.metadata);
  const bool incomplete =
      found.missing > 0 || files_.size() < found.files.size() ||
      std::any_of(files_.begin(), files_.end(), [](const auto& file) { return file->reader->damaged(); });
  if (incomplete && found.metadata && found.metadata->message_count > metadata_.message_count) {
    lost_by_count_ = found.metadata->message_count - metadata_.message_count;
  }
  if (trust == Trust::kFiles || !found.metadata || !agrees(*found.metadata)) {
    count_messages();
    if (trust == Trust::kMetadata && found.metadata) {
      warnings_.push_back((bag_ / kMetadataFile).string() + ": lists " +
                          plural(found.metadata->message_count, "message") + ", the files contain " +
                          std::to_string(metadata_.message_count) +
                          " or other times; using the files (`panvo bag reindex` corrects the metadata)");
    }
  }
  select([](const BagTopic&) { return true; });
}

BagReader::~BagReader() = default;

void BagReader::open_file(const fs::path& file) {
  try {
    files_.push_back(std::make_unique<File>(file, warnings_));
  } catch (const BagError& error) {
    if (bag_ == file) {
      throw;
    }
    warnings_.push_back(error.what());  // the other files are still read
  }
}

/// Fills metadata_ from the files, and from `written` or the file's own copy what the files do not contain.
void BagReader::describe(const std::optional<BagMetadata>& written) {
  std::map<std::pair<std::string, std::string>, std::size_t> index_by_name_and_type;
  for (const auto& file : files_) {
    for (const auto& [id, topic] : file->reader->content().topics) {
      const auto [place, is_new] =
          index_by_name_and_type.try_emplace({topic.name, topic.type}, metadata_.topics.size());
      if (is_new) {
        metadata_.topics.push_back(topic);
      }
      file->topic_by_id[id] = place->second;
    }
    const auto& content = file->reader->content();
    const bool empty = content.message_count == 0;
    metadata_.files.push_back({.path = file->reader->path().lexically_relative(folder_).string(),
                               .start_ns = content.first_ns,
                               .duration_ns = empty ? 0 : content.last_ns - content.first_ns,
                               .message_count = content.message_count});
    metadata_.message_count += content.message_count;
    if (!empty) {
      const auto end_ns = metadata_.start_ns == BagMetadata::kNoStart
                              ? content.last_ns
                              : std::max(content.last_ns, metadata_.start_ns + metadata_.duration_ns);
      metadata_.start_ns = std::min(metadata_.start_ns, content.first_ns);
      metadata_.duration_ns = end_ns - metadata_.start_ns;
    }
  }
  const auto& told = written ? written : files_.front()->reader->content().stored_metadata;
  metadata_.storage_identifier = to_text(files_.front()->reader->storage());
  if (files_.front()->reader->path().extension() == ".zstd") {
    metadata_.compression_format = "zstd";
    metadata_.compression_mode = "FILE";
  }
  metadata_.ros_distro = told ? told->ros_distro : std::string();
  if (metadata_.ros_distro.empty()) {
    metadata_.ros_distro = files_.front()->reader->content().ros_distro;
  }
  if (told) {
    metadata_.version = told->version;
    metadata_.custom_data = told->custom_data;
    metadata_.compression_format = told->compression_format;
    metadata_.compression_mode = told->compression_mode;
    for (auto& topic : metadata_.topics) {
      const auto same = std::find_if(told->topics.begin(), told->topics.end(),
                                     [&](const BagTopic& t) { return t.name == topic.name; });
      topic.message_count = same != told->topics.end() ? same->message_count : 0;
    }
  }
}

/// Whether `written` agrees with the files' totals; does not read the messages.
bool BagReader::agrees(const BagMetadata& written) const {
  const auto sum =
      std::accumulate(metadata_.topics.begin(), metadata_.topics.end(), std::uint64_t{0},
                      [](std::uint64_t total, const BagTopic& topic) { return total + topic.message_count; });
  return written.message_count == metadata_.message_count && sum == metadata_.message_count &&
         (metadata_.message_count == 0 ||
          (written.start_ns == metadata_.start_ns && written.duration_ns == metadata_.duration_ns));
}

void BagReader::count_messages() {
  for (auto& topic : metadata_.topics) {
    topic.message_count = 0;
  }
  for (const auto& file : files_) {
    for (const auto& [id, count] : file->reader->count_by_topic()) {
      if (const auto topic = file->topic_by_id.find(id); topic != file->topic_by_id.end()) {
        metadata_.topics[topic->second].message_count += count;
      }
    }
  }
}

std::uint64_t BagReader::size_bytes() const {
  return std::accumulate(files_.begin(), files_.end(), std::uint64_t{0}, [](std::uint64_t sum, const auto& file) {
    std::error_code error;
    const auto size = fs::file_size(file->reader->path(), error);
    return sum + (error ? 0 : size);
  });
}

void BagReader::select(const std::function<bool(const BagTopic&)>& wanted, std::int64_t begin_ns) {
  for (auto& file : files_) {
    std::set<std::int64_t> ids;
    for (const auto& [id, topic] : file->reader->content().topics) {
      if (wanted(topic)) {
        ids.insert(id);
      }
    }
    file->reader->select(std::move(ids), begin_ns);
    file->started = false;
    file->at_end = file->reader->content().message_count == 0;
  }
}

BagMessage* BagReader::next() {
  while (true) {
    File* first = nullptr;
    for (const auto& file : files_) {
      if (!file->at_end && (!first || file->next_ns() < first->next_ns())) {
        first = file.get();
      }
    }
    if (!first) {
      return nullptr;
    }
    if (!first->started) {
      first->advance();
      continue;  // the first selected message may be later than another file's
    }
    message_.topic = first->topic_by_id.at(first->entry.topic_id);
    message_.timestamp_ns = first->entry.timestamp_ns;
    std::swap(message_.data, first->data);
    first->advance();
    return &message_;
  }
}

TypeDefinition BagReader::definition(const BagTopic& topic) const {
  for (const auto& file : files_) {
    const auto& definitions = file->reader->content().definitions;
    if (const auto found = definitions.find(topic.type); found != definitions.end() && !found->second.text.empty()) {
      return found->second;
    }
  }
  return {};
}

std::uint64_t BagReader::lost_messages() const {
  const auto met = std::accumulate(files_.begin(), files_.end(), std::uint64_t{0},
                                   [](std::uint64_t sum, const auto& file) { return sum + file->lost(); });
  return std::max(met, lost_by_count_);
}

std::vector<std::string> BagReader::check_integrity() {
  std::vector<std::string> complaints;
  for (const auto& file : files_) {
    const auto found = file->reader->check_integrity();
    complaints.insert(complaints.end(), found.begin(), found.end());
  }
  return complaints;
}

std::string full_type_name(const std::string& type) {
  const auto slash = type.find('/');
  const bool short_form = slash != std::string::npos && type.find('/', slash + 1) == std::string::npos;
  return short_form ? type.substr(0, slash) + "/msg" + type.substr(slash) : type;
}

}  // namespace panvo::recorder
