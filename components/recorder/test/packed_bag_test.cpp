// SPDX-License-Identifier: Apache-2.0
/// Bags with rosbag2's zstd compression by file or by message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../src/mcap/compression.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;

interfaces::Bytes packed(const interfaces::Bytes& bytes) { return mcap::compress(Compression::kZstd, bytes); }

class PackedBag : public testing::TestWithParam<Storage> {
 protected:
  std::filesystem::path written() const {
    return folder_ / "bag" / (GetParam() == Storage::kMcap ? "bag_0.mcap" : "bag_0.db3");
  }
  void say_in_metadata(const std::string& from, const std::string& to) {
    auto text = folder_.read(folder_ / "bag" / "metadata.yaml");
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
    folder_.write(folder_ / "bag" / "metadata.yaml", text);
  }

  TemporaryFolder folder_;
};

TEST_P(PackedBag, IsReadFileByFile) {
  {
    BagWriter writer(folder_ / "bag", {.storage = GetParam()});
    write_numbered(writer, 50, 1000);
  }
  const auto text = folder_.read(written());
  const auto bytes = packed({text.begin(), text.end()});
  folder_.write(written().string() + ".zstd", {bytes.begin(), bytes.end()});
  std::filesystem::remove(written());
  say_in_metadata(written().filename(), written().filename().string() + ".zstd");
  say_in_metadata("compression_format: \"\"", "compression_format: zstd");
  say_in_metadata("compression_mode: \"\"", "compression_mode: FILE");
  BagReader reader(folder_ / "bag");
  EXPECT_THAT(reader.warnings(), testing::IsEmpty());
  const auto messages = read_all(reader);
  EXPECT_EQ(reader.metadata().compression_mode, "FILE");
  EXPECT_EQ(messages.size(), 50u);
  EXPECT_EQ(wrong_in_first_numbered(messages, 1000), "");
}

TEST_P(PackedBag, ThatIsCutOffKeepsWhatIsBeforeTheCut) {
  {
    BagWriter writer(folder_ / "bag", {.storage = GetParam(), .chunk_bytes = 10'000});
    write_numbered(writer, 1000, 1000);
  }
  const auto text = folder_.read(written());
  const auto bytes = packed({text.begin(), text.end()});
  folder_.write(folder_ / "cut.zstd",
                {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * 3 / 4)});
  BagReader reader(folder_ / "cut.zstd");
  ASSERT_FALSE(reader.warnings().empty());
  EXPECT_TRUE(reader.warnings().front().starts_with((folder_ / "cut.zstd").string())) << reader.warnings().front();
  const auto messages = read_all(reader);
  EXPECT_GT(messages.size(), 400u);
  EXPECT_EQ(wrong_in_numbered(messages, 1000), "");
}

TEST_P(PackedBag, IsReadMessageByMessage) {
  {
    BagWriter writer(folder_ / "bag", {.storage = GetParam()});
    const int data = writer.add_topic(topic("/data"));
    writer.write(data, kStart, packed(payload(0, 1000)));
    auto damaged = packed(payload(1, 1000));
    damaged.resize(damaged.size() / 2);
    writer.write(data, kStart + kStep, damaged);
    writer.write(data, kStart + 2 * kStep, packed(payload(2, 1000)));
  }
  BagReader reader(folder_ / "bag");
  const auto messages = read_all(reader);
  EXPECT_EQ(messages.size(), 2u);
  EXPECT_EQ(wrong_in_numbered(messages, 1000), "");
  EXPECT_EQ(reader.lost_messages(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Storages, PackedBag, testing::Values(Storage::kSqlite3, Storage::kMcap),
                         [](const auto& storage) { return to_text(storage.param); });

}  // namespace
}  // namespace panvo::recorder
