// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "panvo/recorder/bag_reader.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;

constexpr std::size_t kSize = 3000;
constexpr std::uint64_t kCount = 2000;

class DamagedBag : public testing::Test {
 protected:
  void SetUp() override {
    BagWriter writer(bag_, {.batch_bytes = 1'000'000});
    write_numbered(writer, kCount, kSize);
    writer.close();
    whole_ = folder_.read(database_);
  }

  TemporaryFolder folder_;
  const std::filesystem::path bag_ = folder_ / "bag";
  const std::filesystem::path database_ = bag_ / "bag_0.db3";
  std::string whole_;
};

TEST_F(DamagedBag, ThatIsCutOffAnywhereIsReadUpToThereOrRefused) {
  std::size_t refused = 0;
  std::size_t most = 0;
  for (std::size_t eighth = 0; eighth < 8 * 40; ++eighth) {
    const std::size_t bytes = whole_.size() * eighth / (8 * 40) + eighth % 3;
    std::filesystem::resize_file(database_, 0);
    folder_.write(database_, whole_.substr(0, bytes));
    std::vector<Read> messages;
    const auto error = error_of([&] {
      BagReader reader(bag_);
      EXPECT_TRUE(any_contains(reader.warnings(), "cut off")) << bytes;
      EXPECT_EQ(reader.metadata().message_count + reader.lost_messages(), kCount);
      messages = read_all(reader);
      EXPECT_EQ(reader.metadata().message_count, messages.size());
    });
    EXPECT_EQ(wrong_in_numbered(messages, kSize), "") << bytes;
    if (!error.empty()) {
      EXPECT_THAT(error, HasSubstr("bag_0.db3"));
      ++refused;
    } else {
      // All messages in the remaining bytes, except for the first pages, which hold the other tables.
      EXPECT_GE((messages.size() + 280) * kSize, std::min(bytes, static_cast<std::size_t>(kCount * kSize))) << bytes;
      EXPECT_GE(messages.size(), most);
      most = messages.size();
    }
  }
  EXPECT_LE(refused, 40u) << "only a bag that has lost its beginning is refused";
}

TEST_F(DamagedBag, WithAHoleIsReadBeforeAndAfterIt) {
  auto damaged = whole_;
  const std::size_t hole = 65536 * 40;
  std::fill_n(damaged.begin() + hole, 65536 * 3, '\0');
  folder_.write(database_, damaged);
  BagReader reader(bag_);
  const auto messages = read_all(reader);
  EXPECT_GT(reader.lost_messages(), 0u);
  EXPECT_TRUE(any_contains(reader.warnings(), "damaged"));
  EXPECT_EQ(messages.size() + reader.lost_messages(), kCount);
  EXPECT_GE(messages.size(), kCount - 3 * 65536 / kSize - 3);
  EXPECT_EQ(wrong_in_numbered(messages, kSize), "");
}

TEST_F(DamagedBag, NeverCrashesWhateverByteIsWrong) {
  std::uint64_t state = 1;
  for (int round = 0; round < 60; ++round) {
    auto damaged = whole_;
    for (int i = 0; i < 200; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      // Half of the faults in the first pages, which hold the roots of the b-trees.
      const std::size_t range = i % 2 == 0 ? 65536 * 10 : damaged.size();
      damaged[(state >> 16) % range] = static_cast<char>(state >> 8);
    }
    folder_.write(database_, damaged);
    std::size_t count = 0;
    error_of([&] {
      BagReader reader(bag_);
      count = read_all(reader).size();
    });
    EXPECT_LE(count, 2 * kCount);
  }
}

}  // namespace
}  // namespace panvo::recorder
