// SPDX-License-Identifier: Apache-2.0
#include "dds/announcement.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace panvo::runtime::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes header() {
  Bytes message{'R', 'T', 'P', 'S', 2, 2, 1, 15};
  message.insert(message.end(), 12, 0x11);
  return message;
}

Bytes operator+(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

const Bytes kTime{0x09, 0x01, 8, 0, 1, 2, 3, 4, 5, 6, 7, 8};
const Bytes kTimeBigEndian{0x09, 0x00, 0, 8, 1, 2, 3, 4, 5, 6, 7, 8};

Bytes data(std::uint8_t writer_kind) {
  return {0x15, 0x05, 20, 0, 0, 0, 16, 0, 0, 1, 0, 0xc7, 0, 1, 0, writer_kind, 0, 0, 0, 0, 1, 0, 0, 0};
}
const Bytes kAnnouncement = data(0xc2), kOtherData = data(0x03);

TEST(Announcement, IsDataOfTheAnnouncingWriter) {
  EXPECT_TRUE(is_announcement(header() + kAnnouncement));
  EXPECT_TRUE(is_announcement(header() + kTime + kAnnouncement));
  EXPECT_TRUE(is_announcement(header() + kTimeBigEndian + kAnnouncement));
  EXPECT_TRUE(is_announcement(header() + kOtherData + kAnnouncement));
}

TEST(Announcement, IsNothingElse) {
  EXPECT_FALSE(is_announcement(header() + kTime + kOtherData));
  EXPECT_FALSE(is_announcement(header() + kTime));
  EXPECT_FALSE(is_announcement(header()));
}

TEST(Announcement, IsNotReadBeyondTheEndOfAMessage) {
  const Bytes whole = header() + kTime + kAnnouncement;
  for (std::size_t size = 0; size < header().size() + kTime.size() + 16; ++size) {
    EXPECT_FALSE(is_announcement(std::span(whole).first(size))) << size;
  }
  Bytes endless = header() + kTime;
  endless[22] = endless[23] = 0xff;  // the length of the time stamp
  EXPECT_FALSE(is_announcement(endless + kAnnouncement));
  endless[22] = endless[23] = 0;
  EXPECT_FALSE(is_announcement(endless + kAnnouncement));
}

}  // namespace
}  // namespace panvo::runtime::dds
