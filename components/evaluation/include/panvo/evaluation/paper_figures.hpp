// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

/// Results of [Lu2015] for comparison.
namespace panvo::evaluation::paper {

/// A line of Table 2 (Dataset-I) or Table 4 (Dataset-II). Errors: 2D root mean square.
struct Revisit {
  int number;
  int landmark;
  std::string_view correction;
  std::string_view route;  ///< empty in Table 4
  std::optional<double> entrance_deg, binocular_m, enhanced_m, travelled_m;
};

std::span<const Revisit> table_2();
std::span<const Revisit> table_4();

/// A line of Table 3: its name, its time, and the stages of panvo that do the same work.
struct Stage {
  std::string_view group, item;
  double time_ms;
  std::string_view component;                ///< prefix of the component's name
  std::span<const std::string_view> stages;  ///< names of stages, one line each
};

std::span<const Stage> table_3();

}  // namespace panvo::evaluation::paper
