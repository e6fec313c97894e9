// SPDX-License-Identifier: Apache-2.0
#include "fault_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "panvo/evaluation/statistics.hpp"

namespace panvo::test {
namespace {

using Json = nlohmann::ordered_json;

void take_larger(std::optional<double>& largest, const std::optional<double>& value) {
  if (value && (!largest || *value > *largest)) largest = value;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::optional<double> beyond_share(const FaultRow& row) {
  return row.with_level == 0 ? std::nullopt : std::optional(share(row.beyond_level, row.with_level));
}

std::string number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string percent(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f} %", 100.0 * *value) : "-";
}

/// The longest time, and the number of runs in which it never ended.
std::string time_or_never(const std::optional<double>& max_s, std::size_t never) {
  if (never == 0) return number(max_s, 2);
  return max_s ? fmt::format("{:.2f}, {}x never", *max_s, never) : "never";
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

struct Column {
  std::string name;
  std::string (*text)(const FaultRow&);
};

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"fault", [](const FaultRow& row) { return row.kind; }},
      {"runs",
       [](const FaultRow& row) {
         return row.failed == 0 ? std::to_string(row.runs) : fmt::format("{}, {} failed", row.runs, row.failed);
       }},
      {"error m", [](const FaultRow& row) { return number(row.max_error_m, 2); }},
      {"error/sigma", [](const FaultRow& row) { return number(row.max_error_over_sigma, 1); }},
      {"outside 95 %", [](const FaultRow& row) { return percent(share(row.outside_95, row.poses)); }},
      {"99.9 %", [](const FaultRow& row) { return percent(share(row.outside_999, row.poses)); }},
      {"misleading s", [](const FaultRow& row) { return number(row.max_misleading_s, 2); }},
      {"to alarm s", [](const FaultRow& row) { return number(row.time_to_alarm_s, 2); }},
      {"noticed s", [](const FaultRow& row) { return time_or_never(row.noticed_s, row.unnoticed); }},
      {"recovered s", [](const FaultRow& row) { return time_or_never(row.time_to_recover_s, row.never_recovered); }},
      {"beyond level", [](const FaultRow& row) { return percent(beyond_share(row)); }},
      {"worst/level", [](const FaultRow& row) { return number(row.worst_over_level, 2); }},
      {"median level m", [](const FaultRow& row) { return number(row.median_level_m(), 2); }},
  };
  return all;
}

Json row_json(const FaultRow& row) {
  return {{"fault", row.kind},
          {"runs", row.runs},
          {"failed", row.failed},
          {"poses", row.poses},
          {"unscored_poses", row.unscored_poses},
          {"max_error_m", row.max_error_m},
          {"max_error_over_sigma", row.max_error_over_sigma},
          {"outside_95_share", share(row.outside_95, row.poses)},
          {"outside_999_share", share(row.outside_999, row.poses)},
          {"max_misleading_s", row.max_misleading_s},
          {"time_to_alarm_s", or_null(row.time_to_alarm_s)},
          {"noticed_s", or_null(row.noticed_s)},
          {"unnoticed_runs", row.unnoticed},
          {"time_to_recover_s", or_null(row.time_to_recover_s)},
          {"never_recovered_runs", row.never_recovered},
          {"beyond_level_share", or_null(beyond_share(row))},
          {"worst_over_level", or_null(row.worst_over_level)},
          {"median_level_while_tracking_m", or_null(row.median_level_m())}};
}

}  // namespace

void FaultRow::add(const evaluation::TrustScore& score) {
  FaultRow row;
  row.poses = score.poses;
  row.outside_95 = score.outside_95;
  row.outside_999 = score.outside_999;
  row.with_level = score.with_level;
  row.beyond_level = score.beyond_level;
  row.max_error_m = score.max_error_m;
  row.max_error_over_sigma = score.max_error_over_sigma;
  row.max_misleading_s = score.max_misleading_s;
  row.worst_over_level = score.worst_over_level;
  row.time_to_alarm_s = score.time_to_alarm_s;
  row.noticed_s = score.noticed_s;
  row.unnoticed = score.is_never_noticed;
  row.time_to_recover_s = score.time_to_recover_s;
  row.never_recovered = score.is_never_recovered;
  row.levels_while_tracking_m = score.levels_while_tracking_m;
  merge(row);
}

void FaultRow::merge(const FaultRow& other) {
  runs += other.runs;
  failed += other.failed;
  unscored_poses += other.unscored_poses;
  poses += other.poses;
  outside_95 += other.outside_95;
  outside_999 += other.outside_999;
  with_level += other.with_level;
  beyond_level += other.beyond_level;
  max_error_m = std::max(max_error_m, other.max_error_m);
  max_error_over_sigma = std::max(max_error_over_sigma, other.max_error_over_sigma);
  max_misleading_s = std::max(max_misleading_s, other.max_misleading_s);
  take_larger(worst_over_level, other.worst_over_level);
  take_larger(time_to_alarm_s, other.time_to_alarm_s);
  take_larger(noticed_s, other.noticed_s);
  unnoticed += other.unnoticed;
  take_larger(time_to_recover_s, other.time_to_recover_s);
  never_recovered += other.never_recovered;
  levels_while_tracking_m.insert(levels_while_tracking_m.end(), other.levels_while_tracking_m.begin(),
                                 other.levels_while_tracking_m.end());
}

std::optional<double> FaultRow::median_level_m() const {
  const auto summary = evaluation::summarize(levels_while_tracking_m);
  return summary ? std::optional(summary->median) : std::nullopt;
}

FaultRow FaultTable::all() const {
  FaultRow all;
  all.kind = "all";
  for (const auto& row : rows) all.merge(row);
  return all;
}

std::vector<FaultGoal> FaultTable::goals() const {
  constexpr double kMaxBeyond = 1e-3, kMaxOverLevel = 2.0, kMaxMisleading_s = 1.0, kMaxMedian_m = 1.0;
  const FaultRow all_rows = all();
  const auto beyond = beyond_share(all_rows);
  const auto median_m = all_rows.median_level_m();
  const auto at_most = [](const std::optional<double>& value, double most) {
    return value ? std::optional(*value <= most) : std::nullopt;
  };
  return {
      {"error beyond the protection level in at most 0.1 % of all poses", percent(beyond), at_most(beyond, kMaxBeyond)},
      {"error at most twice the level", number(all_rows.worst_over_level, 2) + " times at most",
       at_most(all_rows.worst_over_level, kMaxOverLevel)},
      {"every alarm within 0.5 s", number(all_rows.time_to_alarm_s.value_or(0.0), 2) + " s at most",
       all_rows.time_to_alarm_s.value_or(0.0) <= evaluation::kAlarmTime_s},
      {"tracking while the error is over 3 sigma for at most 1 s", number(all_rows.max_misleading_s, 2) + " s at most",
       all_rows.max_misleading_s <= kMaxMisleading_s},
      {"median level below 1 m while tracking", number(median_m, 2) + " m", at_most(median_m, kMaxMedian_m)},
  };
}

std::string to_text(const FaultTable& table) {
  std::vector<std::vector<std::string>> lines(1);
  for (const auto& column : columns()) lines.front().push_back(column.name);
  const auto add = [&](const FaultRow& row) {
    lines.emplace_back();
    for (const auto& column : columns()) lines.back().push_back(column.text(row));
  };
  for (const auto& row : table.rows) add(row);
  add(table.all());
  std::vector<std::size_t> widths(columns().size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("{:<{}}", line.front(), widths.front());
    for (std::size_t i = 1; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
    text += '\n';
  }
  text += fmt::format("\n{} poses; {} more were skipped: no ground truth at their stamp, or invalid covariance\n\n",
                      table.all().poses, table.all().unscored_poses);
  for (const auto& goal : table.goals()) {
    text += fmt::format("{:<15}{}: {}\n",
                        !goal.holds   ? "undetermined"
                        : *goal.holds ? "holds"
                                      : "does not hold",
                        goal.name, goal.outcome);
  }
  return text;
}

std::string to_csv(const FaultTable& table) {
  std::string text;
  const auto line = [&](const Json& row, auto field) {
    std::string fields;
    for (const auto& [name, value] : row.items()) fields += (fields.empty() ? "" : ",") + field(name, value);
    text += fields + '\n';
  };
  line(row_json(FaultRow{}), [](const std::string& name, const Json&) { return name; });
  for (const auto& row : table.rows) {
    line(row_json(row), [](const std::string&, const Json& value) {
      return value.is_null() ? std::string() : value.is_string() ? value.get<std::string>() : value.dump();
    });
  }
  return text;
}

std::string to_json(const FaultTable& table) {
  Json json;
  json["rows"] = Json::array();
  for (const auto& row : table.rows) json["rows"].push_back(row_json(row));
  json["all"] = row_json(table.all());
  for (const auto& goal : table.goals()) {
    json["goals"].push_back(
        {{"goal", goal.name}, {"outcome", goal.outcome}, {"holds", goal.holds ? Json(*goal.holds) : Json(nullptr)}});
  }
  return json.dump(1) + '\n';
}

}  // namespace panvo::test
