// SPDX-License-Identifier: Apache-2.0
#include "../src/render_journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::simulation {
namespace {

using ::testing::HasSubstr;

class RenderedBefore : public ::testing::Test {
 protected:
  std::vector<RenderJournal::Entry> found() const { return RenderJournal(file_).found(); }

  const panvo::test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "rendered.csv";
};

TEST_F(RenderedBefore, IsFoundWithItsExposureToTheLastBit) {
  const Exposure third{1.0 / 3.0, 0.1 + 0.2};
  {
    RenderJournal journal(file_);
    EXPECT_TRUE(journal.found().empty());
    journal.add({1'700'000'000'040'000'000, {}});
    journal.add({1'700'000'000'080'000'000, third});
  }
  const auto entries = found();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].stamp_ns, 1'700'000'000'080'000'000);
  EXPECT_EQ(entries[1].exposure.stereo_gain, third.stereo_gain);
  EXPECT_EQ(entries[1].exposure.panorama_gain, third.panorama_gain);
}

TEST_F(RenderedBefore, EndsAtTheFirstLineThatIsNotWhole) {
  { RenderJournal(file_).add({40, {0.5, 2.0}}); }
  std::ofstream(file_, std::ios::app) << "80,0x1p-1,0x1p+";  // killed in the middle of a number
  EXPECT_EQ(found().size(), 1u);
  std::ofstream(file_, std::ios::app) << "1\nnonsense\n120,0x1p-1,0x1p+1\n";
  EXPECT_EQ(found().size(), 2u);
}

TEST_F(RenderedBefore, IsForgottenFromWhereItIsNotKept) {
  {
    RenderJournal journal(file_);
    for (const std::int64_t stamp_ns : {40, 80, 120}) journal.add({stamp_ns, {}});
  }
  {
    RenderJournal journal(file_);
    journal.keep(1);
    journal.add({81, {}});
  }
  const auto entries = found();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].stamp_ns, 40);
  EXPECT_EQ(entries[1].stamp_ns, 81);
}

TEST_F(RenderedBefore, BelongsToOneWriterAtATime) {
  const RenderJournal first(file_);
  try {
    const RenderJournal second(file_);
    FAIL() << "two writers opened one rendering";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another process renders there"));
    EXPECT_THAT(error.what(), HasSubstr(file_.string()));
  }
}

}  // namespace
}  // namespace panvo::simulation
