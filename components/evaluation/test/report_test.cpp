// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "reports.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Table, HasAColumnForEachEstimateAndAUnitForEachRow) {
  const std::string table = to_table(small_report());
  EXPECT_THAT(table, HasSubstr("a walk\n"));
  EXPECT_THAT(table, ContainsRegex(" first +second\n"));
  EXPECT_THAT(table, ContainsRegex("path length +m +[0-9.]+ +[0-9.]+\n"));
  EXPECT_THAT(table, ContainsRegex("scale error by Sim3 +% +1.000 +-?0.000\n"));
  EXPECT_THAT(table, ContainsRegex("vo/match +ms +5.00 / 9.00, 5.00 +-\n"));
  EXPECT_THAT(table, ContainsRegex("frames without a measured motion +- +3\n"));
  EXPECT_THAT(table, HasSubstr("interpolated at the estimate's stamps"));
}

TEST(Table, SaysNothingForWhatCouldNotBeComputed) {
  const std::string table = to_table(still_report());
  EXPECT_THAT(table, ContainsRegex("translation, all +% +-\n"));
  EXPECT_THAT(table, Not(HasSubstr("without a measured motion")));
  EXPECT_THAT(table, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf")), Not(HasSubstr("normalised"))));
}

TEST(Json, HoldsEveryFigureAndNullForWhatIsNotThere) {
  const auto json = nlohmann::json::parse(to_json(small_report()));
  EXPECT_EQ(json["title"], "a walk");
  EXPECT_EQ(json["errors_aligned_by"], "start");
  EXPECT_EQ(json["estimates"][0]["name"], "first");
  EXPECT_NEAR(json["estimates"][0]["scale_error_percent"], 1.0, 1e-9);
  EXPECT_TRUE(json["estimates"][0]["nees"].is_null());
  EXPECT_EQ(json["estimates"][0]["timing"][0]["wall_ms"]["p95"], 9.0);
  EXPECT_TRUE(json["estimates"][1]["timing"].is_null());
  EXPECT_TRUE(json["estimates"][0]["frames_unreliable"].is_null());
  EXPECT_EQ(json["estimates"][1]["frames_unreliable"], 3);
  EXPECT_GT(json["estimates"][0]["segments"]["by_length"].size(), 0u);
  EXPECT_GT(json["estimates"][0]["rpe_per_metre"]["translation_m_per_m"]["rmse"], 0.0);
  const auto still = nlohmann::json::parse(to_json(still_report()));
  EXPECT_TRUE(still["estimates"][0]["ate_se3_m"].is_null());
}

TEST(Json, SurvivesANameThatIsNoUtf8) {
  EXPECT_TRUE(nlohmann::json::accept(to_json(small_report("bad \xff\xfe title"))));
}

TEST(Csv, HasALineForEachPoseOfEachEstimate) {
  std::istringstream csv(to_csv(small_report("t", "with \"quotes\", and comma")));
  std::string line;
  std::getline(csv, line);
  const auto columns = std::count(line.begin(), line.end(), ',') + 1;
  std::size_t lines = 0;
  while (std::getline(csv, line)) {
    const bool first = lines < 120;  // the name of the first estimate contains a comma
    ASSERT_TRUE(line.starts_with(first ? "\"with \"\"quotes\"\", and comma\"," : "\"second\",")) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ',') + 1, columns + (first ? 1 : 0));
    ++lines;
  }
  EXPECT_EQ(lines, 240u);
}

TEST(Report, IsTheSameTextEachTime) {
  EXPECT_EQ(to_table(small_report()), to_table(small_report()));
  EXPECT_EQ(to_json(small_report()), to_json(small_report()));
  EXPECT_EQ(to_csv(small_report()), to_csv(small_report()));
}

}  // namespace
}  // namespace panvo::evaluation
