// SPDX-License-Identifier: Apache-2.0
#include "fault_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace panvo::test {
namespace {

using testing::HasSubstr;

evaluation::TrustScore score(double over_sigma, std::optional<double> alarm_s, std::optional<double> recover_s) {
  evaluation::TrustScore score;
  score.poses = 1000;
  score.max_error_over_sigma = over_sigma;
  score.time_to_alarm_s = alarm_s;
  score.noticed_s = alarm_s;
  score.is_never_noticed = !alarm_s;
  score.time_to_recover_s = recover_s;
  return score;
}

FaultTable table() {
  FaultTable table;
  table.rows.resize(2);
  table.rows[0].kind = "both_frozen";
  table.rows[0].runs = 3;
  table.rows[0].add(score(4.0, 0.4, 0.5));
  table.rows[0].add(score(9.0, 0.2, 1.5));
  table.rows[0].add(score(3.0, 0.1, 0.1));
  table.rows[1].kind = "rain";
  table.rows[1].runs = 1;
  table.rows[1].add(score(2.0, std::nullopt, 0.0));
  return table;
}

const FaultGoal& goal(const std::vector<FaultGoal>& goals, const std::string& words) {
  for (const auto& goal : goals) {
    if (goal.name.find(words) != std::string::npos) return goal;
  }
  throw std::out_of_range(words);
}

TEST(FaultTable, TakesTheWorstOfAllRuns) {
  const auto row = table().rows[0];
  EXPECT_EQ(row.poses, 3000U);
  EXPECT_EQ(row.max_error_over_sigma, 9.0);
  EXPECT_EQ(row.time_to_alarm_s, 0.4);
  EXPECT_EQ(row.time_to_recover_s, 1.5);
  EXPECT_EQ(table().rows[1].unnoticed, 1U);
}

TEST(FaultTable, SaysWhichGoalsHoldAndOfWhichNothingCanBeTold) {
  auto worse = table();
  auto goals = worse.goals();
  EXPECT_EQ(goal(goals, "within 0.5 s").holds, true);
  EXPECT_EQ(goal(goals, "tracking while").holds, true);
  EXPECT_EQ(goal(goals, "twice the level").holds, std::nullopt) << "the runs have no level";
  auto bad = score(50.0, 0.51, 0.0);
  bad.max_misleading_s = 1.2;
  bad.with_level = 1000;
  bad.beyond_level = 4;
  bad.worst_over_level = 2.5;
  bad.levels_while_tracking_m = {0.5, 0.7, 3.0};
  worse.rows[1].add(bad);
  goals = worse.goals();
  EXPECT_EQ(goal(goals, "within 0.5 s").holds, false);
  EXPECT_EQ(goal(goals, "tracking while").holds, false);
  EXPECT_EQ(goal(goals, "0.1 % of all poses").holds, false);
  EXPECT_EQ(goal(goals, "twice the level").holds, false);
  EXPECT_EQ(goal(goals, "median level").holds, true);
}

TEST(FaultTable, IsTheSameAsTextAndAsJsonAndAsLinesOfOneLength) {
  const auto text = to_text(table());
  EXPECT_THAT(text, HasSubstr("both_frozen"));
  EXPECT_THAT(text, HasSubstr("undetermined"));
  const auto json = nlohmann::json::parse(to_json(table()));
  EXPECT_EQ(json.at("rows").at(0).at("max_error_over_sigma"), 9.0);
  EXPECT_TRUE(json.at("rows").at(1).at("time_to_alarm_s").is_null());
  const auto csv = to_csv(table());
  const auto header = csv.substr(0, csv.find('\n'));
  const auto fields = std::count(header.begin(), header.end(), ',');
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 3 * fields);
  EXPECT_THAT(csv, HasSubstr("\nrain,1,0,1000,0,"));
}

}  // namespace
}  // namespace panvo::test
