// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/printable.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime {
namespace {

TEST(Printable, LeavesWhatIsTextAsItIs) {
  for (const char* text : {"", "/odom", "two\nlines\tand a tab", "\xc3\xbc \xe2\x82\xac \xf0\x9f\x93\xb7"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ShowsWhatWouldSteerATerminal) {
  EXPECT_EQ(printable("\033[2J"), "\\x1b[2J");                     // clears the screen
  EXPECT_EQ(printable("\033]0;title\007"), "\\x1b]0;title\\x07");  // renames the window
  EXPECT_EQ(printable("good\rbad"), "good\\x0dbad");               // overwrites the text before
  EXPECT_EQ(printable("\x7f\x08"), "\\x7f\\x08");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // the same sequence with a single-character introducer
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");  // with a single-byte introducer
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "dab"),
            "\\xe2\\x80\\xae"
            "dab");  // written from right to left
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");           // cut off
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");           // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a single UTF-16 surrogate
  EXPECT_EQ(printable("\xc3(x"), "\\xc3(x");
}

}  // namespace
}  // namespace panvo::runtime
