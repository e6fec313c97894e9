// SPDX-License-Identifier: Apache-2.0
/// MCAP bags: writing, reading, truncation and damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../src/mcap/crc32.hpp"
#include "../src/mcap/mcap_file_reader.hpp"
#include "../src/mcap/record.hpp"
#include "panvo/recorder/bag_check.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kPayloadSize = 100;
constexpr std::uint64_t kMessageCount = 35;

class Mcap : public testing::TestWithParam<Compression> {
 protected:
  BagWriter::Options options() const {
    return {.storage = Storage::kMcap, .compression = GetParam(), .chunk_bytes = 1000};
  }
  /// Reads the single file, without metadata.yaml.
  std::vector<Read> read_file(std::vector<std::string>* warnings = nullptr, std::uint64_t* lost = nullptr) {
    BagReader reader(file_);
    auto messages = read_all(reader);
    if (warnings) {
      *warnings = reader.warnings();
    }
    if (lost) {
      *lost = reader.lost_messages();
    }
    return messages;
  }
  void write_numbered_bag() {
    BagWriter writer(folder_ / "bag", options());
    write_numbered(writer, kMessageCount, kPayloadSize);
    writer.close();
    whole_ = folder_.read(file_);
  }
  /// Offsets of the chunks.
  std::vector<std::size_t> chunks() const {
    std::vector<std::size_t> offsets;
    for (std::size_t at = mcap::kMagic.size(); at + mcap::RecordHead::kBytes < whole_.size();) {
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(whole_.data()) + at;
      const auto head = mcap::parse_record_head({bytes, mcap::RecordHead::kBytes});
      if (head.opcode == mcap::Opcode::kChunk) {
        offsets.push_back(at);
      }
      at += mcap::RecordHead::kBytes + head.length;
    }
    return offsets;
  }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "bag" / "bag_0.mcap";
  std::string whole_;
};

TEST_P(Mcap, GivesBackWhatWasWrittenInOrderOfTime) {
  const auto* type = interfaces::find_message_type("nav_msgs/msg/Odometry");
  ASSERT_TRUE(type);
  {
    BagWriter writer(folder_ / "bag", options());
    const int a = writer.add_topic(BagTopic::of("/a", *type, interfaces::qos::kLatched), type->definition);
    const int b = writer.add_topic(topic("/b"), TypeDefinition{"ros2idl", "module b {};"});
    writer.write(b, kStart + 9, payload(1, 300'000));
    writer.write(a, kStart + 2, payload(2, 0));
    writer.write(a, kStart + 9, payload(3, 17));
    writer.write(b, kStart + 1, payload(4, 1200));
    writer.write(b, kStart + 5, payload(5, 1200));
  }
  BagReader reader(folder_ / "bag");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(read_all(reader), (std::vector<Read>{{"/b", kStart + 1, payload(4, 1200)},
                                                 {"/a", kStart + 2, payload(2, 0)},
                                                 {"/b", kStart + 5, payload(5, 1200)},
                                                 {"/b", kStart + 9, payload(1, 300'000)},
                                                 {"/a", kStart + 9, payload(3, 17)}}));
  const auto& metadata = reader.metadata();
  EXPECT_EQ(metadata.storage_identifier, "mcap");
  EXPECT_EQ(metadata.start_ns, kStart + 1);
  EXPECT_EQ(metadata.duration_ns, 8);
  EXPECT_EQ(metadata.topics.at(0).type_description_hash, type->hash);
  EXPECT_EQ(metadata.topics.at(0).offered_qos_profiles,
            std::vector<QosProfile>{offered_profile(interfaces::qos::kLatched)});
  EXPECT_EQ(metadata.topics.at(1).message_count, 3u);
  EXPECT_EQ(reader.definition(metadata.topics.at(0)).text, type->definition);
  EXPECT_EQ(reader.definition(metadata.topics.at(1)).encoding, "ros2idl");
  EXPECT_TRUE(check_bag(folder_ / "bag").problems.empty());
}

TEST_P(Mcap, GivesOnlyWantedTopicsFromATimeOn) {
  write_numbered_bag();
  BagReader reader(folder_ / "bag");
  reader.select([](const BagTopic&) { return true; }, kStart + 25 * kStep);
  const auto messages = read_all(reader);
  ASSERT_EQ(messages.size(), 10u);
  EXPECT_EQ(messages.front().timestamp_ns, kStart + 25 * kStep);
  reader.select([](const BagTopic&) { return false; });
  EXPECT_EQ(reader.next(), nullptr);
}

TEST_P(Mcap, CutOffAtAnyByteKeepsWhatIsBeforeTheCut) {
  write_numbered_bag();
  const auto offsets = chunks();
  ASSERT_GE(offsets.size(), 5u);
  const auto per_chunk = kMessageCount / offsets.size();
  for (std::size_t bytes = whole_.size() - 1; bytes > 0; --bytes) {
    std::filesystem::resize_file(file_, bytes);
    std::vector<std::string> warnings;
    std::vector<Read> messages;
    const auto error = error_of([&] { messages = read_file(&warnings); });
    EXPECT_EQ(wrong_in_first_numbered(messages, kPayloadSize), "") << bytes;
    const auto whole_chunks =
        static_cast<std::size_t>(std::upper_bound(offsets.begin(), offsets.end(), bytes) - offsets.begin());
    ASSERT_GE(messages.size() + per_chunk, whole_chunks * per_chunk) << bytes << " " << error;
    ASSERT_TRUE(!warnings.empty() || !error.empty()) << bytes;
  }
}

TEST_P(Mcap, WithAFlippedBitLosesNothingOfOtherChunks) {
  write_numbered_bag();
  const auto offsets = chunks();
  for (std::size_t at = offsets[1] + 60; at < offsets[2]; at += 7) {
    auto damaged = whole_;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    folder_.write(file_, damaged);
    std::uint64_t lost = 0;
    const auto messages = read_file(nullptr, &lost);
    EXPECT_GE(messages.size(), kMessageCount - 2 * kMessageCount / offsets.size()) << at;
    EXPECT_LE(messages.size() + lost, kMessageCount) << at;
    std::size_t whole = 0;
    for (const auto& message : messages) {
      whole += wrong_in_numbered({message}, kPayloadSize).empty() ? 1 : 0;
    }
    EXPECT_GE(whole + 2 * kMessageCount / offsets.size(), kMessageCount) << at;
  }
}

TEST_P(Mcap, TellsOfAChunkWhoseChecksumIsWrong) {
  write_numbered_bag();
  auto damaged = whole_;
  const auto at = chunks()[1] + 9 + 24;  // the checksum itself
  damaged[at] = static_cast<char>(damaged[at] ^ 1);
  folder_.write(file_, damaged);
  std::vector<std::string> warnings;
  std::uint64_t lost = 0;
  EXPECT_EQ(read_file(&warnings, &lost).size(), kMessageCount);
  EXPECT_EQ(lost, 0u);
  EXPECT_TRUE(any_contains(warnings, "bag_0.mcap: the chunk at byte " + std::to_string(chunks()[1])));
  EXPECT_FALSE(check_bag(folder_ / "bag").is_sound());
}

TEST_P(Mcap, ReadsThroughAFileWhoseSummaryIsDamaged) {
  write_numbered_bag();
  auto damaged = whole_;
  const auto at = damaged.size() - 60;
  damaged[at] = static_cast<char>(damaged[at] ^ 1);
  folder_.write(file_, damaged);
  std::vector<std::string> warnings;
  const auto messages = read_file(&warnings);
  EXPECT_EQ(messages.size(), kMessageCount);
  EXPECT_EQ(wrong_in_first_numbered(messages, kPayloadSize), "");
  EXPECT_TRUE(any_contains(warnings, "its summary has a wrong checksum; 35 messages"));
}

TEST_P(Mcap, FindsWhatLiesBehindAHole) {
  write_numbered_bag();
  const auto offsets = chunks();
  auto damaged = whole_.substr(0, whole_.size() - 50);  // no summary either
  std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(offsets[1]),
            damaged.begin() + static_cast<std::ptrdiff_t>(offsets[2] + 20), '\0');
  folder_.write(file_, damaged);
  std::vector<std::string> warnings;
  const auto messages = read_file(&warnings);
  EXPECT_GE(messages.size(), kMessageCount - 3 * kMessageCount / offsets.size());
  EXPECT_EQ(wrong_in_numbered(messages, kPayloadSize), "");
  EXPECT_TRUE(any_contains(warnings, "are damaged and skipped"));
}

TEST_P(Mcap, TakesNoMemoryForSizesThatAreNotThere) {
  write_numbered_bag();
  const auto offsets = chunks();
  for (const std::size_t field : {std::size_t{1}, std::size_t{9 + 16}}) {  // of the record, and uncompressed
    auto damaged = whole_;
    damaged.replace(offsets[1] + field, 8, std::string("\xff\xff\xff\xff\xff\xff\xff\x0f", 8));
    folder_.write(file_, damaged);
    EXPECT_GE(read_file().size(), kMessageCount - 2 * kMessageCount / offsets.size());
  }
}

TEST_P(Mcap, ReadsChunksAgainWhereAllOverlapAndFewCanBeHeld) {
  {
    BagWriter writer(folder_ / "bag", options());
    const int data = writer.add_topic(topic("/data"));
    for (std::uint64_t i = 0; i < 100; ++i) {
      const auto number = i * 37 % 100;  // early and late ones in every chunk
      writer.write(data, kStart + static_cast<std::int64_t>(number) * kStep, payload(number, kPayloadSize));
    }
  }
  std::vector<std::string> warnings;
  mcap::McapFileReader reader(file_, warnings, 3000);
  std::vector<Read> messages;
  BagFileReader::Entry entry;
  for (interfaces::Bytes bytes; reader.next(entry, bytes);) {
    messages.push_back({"/data", entry.timestamp_ns, bytes});
  }
  EXPECT_EQ(messages.size(), 100u);
  EXPECT_EQ(wrong_in_first_numbered(messages, kPayloadSize), "");
  EXPECT_EQ(reader.lost(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Compressions, Mcap, testing::Values(Compression::kNone, Compression::kLz4, Compression::kZstd),
                         [](const auto& compression) { return to_text(compression.param); });

/// Files with the records that other writers produce.
class ForeignMcap : public testing::Test {
 protected:
  ForeignMcap() : bytes_(mcap::kMagic.begin(), mcap::kMagic.end()) {
    mcap::append(bytes_, mcap::Header{.profile = "", .library = "other"});
    mcap::append(bytes_, mcap::Schema{.id = 7, .name = "other.Type", .encoding = "protobuf", .data = "x"});
    mcap::append(bytes_,
                 mcap::Channel{.id = 3, .schema_id = 7, .topic = "/t", .message_encoding = "protobuf", .metadata = {}});
  }
  void add_message(std::uint64_t time, std::uint8_t byte) {
    const std::array<std::uint8_t, 1> data{byte};
    mcap::append(bytes_, {.channel = 3, .sequence = 0, .log_time = time, .publish_time = time}, data);
  }
  std::filesystem::path finish() {
    mcap::append_data_end(bytes_);
    mcap::Bytes nothing;
    mcap::append_footer(nothing, {});
    bytes_.insert(bytes_.end(), nothing.begin(), nothing.end());
    bytes_.insert(bytes_.end(), mcap::kMagic.begin(), mcap::kMagic.end());
    folder_.write(folder_ / "other.mcap", {bytes_.begin(), bytes_.end()});
    return folder_ / "other.mcap";
  }

  TemporaryFolder folder_;
  mcap::Bytes bytes_;
};

TEST_F(ForeignMcap, WithoutChunksOrSummaryIsReadInOrderOfTime) {
  add_message(30, 1);
  add_message(10, 2);
  add_message(20, 3);
  BagReader reader(finish());
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(reader.metadata().topics.at(0).serialization_format, "protobuf");
  EXPECT_EQ(reader.metadata().topics.at(0).type, "other.Type");
  EXPECT_EQ(read_all(reader), (std::vector<Read>{{"/t", 10, {2}}, {"/t", 20, {3}}, {"/t", 30, {1}}}));
}

TEST_F(ForeignMcap, WithAMessageOfNoChannelSaysSo) {
  add_message(1, 1);
  mcap::append(bytes_, {.channel = 4, .log_time = 2}, {});
  BagReader reader(finish());
  EXPECT_TRUE(any_contains(reader.warnings(), "1 messages belong to unknown channels"));
  EXPECT_EQ(read_all(reader).size(), 1u);
  EXPECT_EQ(reader.lost_messages(), 1u);
}

TEST_F(ForeignMcap, WithRecordsOfALaterVersionIsRead) {
  bytes_.insert(bytes_.end(), {0x91, 2, 0, 0, 0, 0, 0, 0, 0, 'h', 'i'});
  add_message(1, 1);
  BagReader reader(finish());
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_EQ(read_all(reader).size(), 1u);
}

TEST(Crc32, IsThatOfZip) {
  const std::string text = "123456789";
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  EXPECT_EQ(mcap::crc32(bytes), 0xcbf43926u);
  EXPECT_EQ(mcap::crc32({}), 0u);
}

TEST(McapWriter, RefusesATimeBefore1970) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "bag", {.storage = Storage::kMcap});
  const int data = writer.add_topic(topic("/data"));
  EXPECT_THAT(error_of([&] { writer.write(data, -1, payload(0, 1)); }), HasSubstr("before 1970"));
}

TEST(McapWriter, RefusesToCompressSqlite) {
  const TemporaryFolder folder;
  const auto error = error_of([&] { BagWriter writer(folder / "bag", {.compression = Compression::kZstd}); });
  EXPECT_THAT(error, HasSubstr("choose the storage mcap"));
  EXPECT_FALSE(std::filesystem::exists(folder / "bag"));
}

TEST(McapWriter, BeginsTheNextFileWhenOneIsFull) {
  const TemporaryFolder folder;
  {
    BagWriter writer(folder / "bag", {.max_file_bytes = 50'000, .batch_bytes = 10'000, .storage = Storage::kMcap});
    write_numbered(writer, 200, 1000);
  }
  BagReader reader(folder / "bag");
  EXPECT_THAT(reader.warnings(), IsEmpty());
  EXPECT_GT(reader.metadata().files.size(), 3u);
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), 200u);
  EXPECT_EQ(wrong_in_first_numbered(messages, 1000), "");
}

}  // namespace
}  // namespace panvo::recorder
