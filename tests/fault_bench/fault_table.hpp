// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/trust.hpp"

namespace panvo::test {

/// A line of the table: all runs of one kind of fault.
struct FaultRow {
  std::string kind;
  std::size_t runs = 0, failed = 0;
  std::size_t unscored_poses =
      0;  ///< skipped poses: outside the time span of the ground truth, or with an invalid covariance
  std::size_t poses = 0, outside_95 = 0, outside_999 = 0, with_level = 0, beyond_level = 0;
  double max_error_m = 0.0, max_error_over_sigma = 0.0, max_misleading_s = 0.0;
  std::optional<double> worst_over_level;
  std::optional<double> time_to_alarm_s;    ///< the longest; nullopt: no alarm was due
  std::optional<double> noticed_s;          ///< the longest among runs with an alarm
  std::size_t unnoticed = 0;                ///< runs without an alarm
  std::optional<double> time_to_recover_s;  ///< the longest
  std::size_t never_recovered = 0;
  std::vector<double> levels_while_tracking_m;

  void add(const evaluation::TrustScore& score);
  void merge(const FaultRow& other);
  std::optional<double> median_level_m() const;
};

/// A goal and its result.
struct FaultGoal {
  std::string name, outcome;
  std::optional<bool> holds;  ///< nullopt: undetermined
};

struct FaultTable {
  std::vector<FaultRow> rows;

  FaultRow all() const;
  std::vector<FaultGoal> goals() const;
};

std::string to_text(const FaultTable& table);
std::string to_csv(const FaultTable& table);
std::string to_json(const FaultTable& table);

/// gnuplot script, including the data, that writes `stem`.png into its working folder.
std::string plot_script(const FaultTable& table, const std::string& stem);

}  // namespace panvo::test
