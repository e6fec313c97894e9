// SPDX-License-Identifier: Apache-2.0
#include "frame_assembly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol_error.hpp"

namespace panvo::web_view {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;

constexpr std::uint8_t kFinal = 0x80, kText = 1, kBinary = 2, kPing = 9;

TEST(FrameAssembly, GivesWholeMessagesAtOnce) {
  FrameAssembly assembly(10);
  const auto text = assembly.add(kFinal | kText, Bytes{1, 2});
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->is_text);
  EXPECT_THAT(text->data, ElementsAre(1, 2));
  EXPECT_FALSE(assembly.add(kFinal | kBinary, Bytes{})->is_text);
}

TEST(FrameAssembly, JoinsFragmentsAroundControlFrames) {
  FrameAssembly assembly(10);
  EXPECT_FALSE(assembly.add(kBinary, Bytes{1}));
  EXPECT_FALSE(assembly.add(kFinal | kPing, Bytes{7}));
  EXPECT_FALSE(assembly.add(0, Bytes{2}));
  EXPECT_THAT(assembly.add(kFinal, Bytes{3})->data, ElementsAre(1, 2, 3));
}

TEST(FrameAssembly, RefusesLargeMessagesOnceAndGoesOn) {
  FrameAssembly assembly(3);
  EXPECT_FALSE(assembly.add(kBinary, Bytes{1, 2, 3}));
  EXPECT_THROW(assembly.add(0, Bytes{4}), ProtocolError);
  EXPECT_FALSE(assembly.add(0, Bytes{5}));
  EXPECT_FALSE(assembly.add(kFinal, Bytes{6}));
  EXPECT_THAT(assembly.add(kFinal | kText, Bytes{7})->data, ElementsAre(7));
  EXPECT_THROW(assembly.add(kFinal | kText, Bytes(4)), ProtocolError);
}

TEST(FrameAssembly, RefusesFragmentsOutOfOrderAndUnknownOperations) {
  FrameAssembly assembly(3);
  EXPECT_THROW(assembly.add(kFinal, Bytes{1}), ProtocolError);
  EXPECT_FALSE(assembly.add(kText, Bytes{1}));
  EXPECT_THROW(assembly.add(kFinal | kText, Bytes{1}), ProtocolError);
  EXPECT_THROW(assembly.add(kFinal | 5, Bytes{1}), ProtocolError);
  EXPECT_TRUE(assembly.add(kFinal | kText, Bytes{1}));
}

}  // namespace
}  // namespace panvo::web_view
