// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "fault_table.hpp"

namespace panvo::test {
namespace {

/// Data block with position, name and value; rows in the order of the table, from the top.
template <class Value>
std::string block(const std::string& name, const FaultTable& table, Value value) {
  std::string text = "$" + name + " << EOD\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::optional<double> number = value(table.rows[i]);
    text += fmt::format("{} {} {}\n", table.rows.size() - i, table.rows[i].kind,
                        number ? fmt::format("{}", *number) : "NaN");
  }
  return text + "EOD\n";
}

struct Panel {
  const char* block;
  const char* title;
  double goal;
  const char* range;
  bool is_logarithmic = false;
};

/// Horizontal bars with a line at the goal; the first panel has the names.
std::string commands(const Panel& panel, bool is_first) {
  std::string text = fmt::format("set title '{}'\nset xrange {}\n", panel.title, panel.range);
  text += panel.is_logarithmic ? "set logscale x\n" : "unset logscale x\n";
  text +=
      fmt::format("set arrow 1 from first {0},graph 0 to first {0},graph 1 nohead lc rgb '#cc4444' dt 2\n", panel.goal);
  if (!is_first) text += "unset ytics\n";
  // From the left edge (of a logarithmic axis: 0.1) to the value.
  return text +
         fmt::format(
             "plot ${} using 3:1:({}):3:($1-0.4):($1+0.4){} with boxxyerror fs solid 0.6 noborder lc rgb '#4477aa'\n",
             panel.block, panel.is_logarithmic ? 0.1 : 0.0, is_first ? ":yticlabels(2)" : "");
}

}  // namespace

std::string plot_script(const FaultTable& table, const std::string& stem) {
  const std::size_t rows = table.rows.size();
  std::string text = block("sigmas", table,
                           [](const FaultRow& row) { return std::optional(std::max(0.1, row.max_error_over_sigma)); });
  text += block("misleading", table, [](const FaultRow& row) { return std::optional(row.max_misleading_s); });
  text += block("alarms", table, [](const FaultRow& row) { return row.time_to_alarm_s; });
  text += block("levels", table, [](const FaultRow& row) { return row.worst_over_level; });
  const std::size_t height_px = 110 + 22 * rows;
  const double top = 1.0 - 70.0 / static_cast<double>(height_px), bottom = 35.0 / static_cast<double>(height_px);
  text += fmt::format("set terminal pngcairo size 1600,{} noenhanced font 'sans,10'\n", height_px);
  text += fmt::format("set output '{}.png'\n", stem);
  text += fmt::format("set yrange [0.4:{}.6]\nunset key\nset grid x\nset ytics scale 0\n", rows);
  text += fmt::format(
      "set multiplot layout 1,4 title 'Faults: worst of all runs; dashed: goal; no bar: not applicable' "
      "margins 0.12,0.99,{},{} "
      "spacing 0.02,0\n",
      bottom, top);
  text += commands({"sigmas", "largest error over sigma", 3.0, "[0.1:*]", true}, true);
  text += commands({"misleading", "tracking while over 3 sigma, s", 1.0, "[0:2<*]"}, false);
  text += commands({"alarms", "time to alarm, s", 0.5, "[0:1<*]"}, false);
  text += commands({"levels", "worst error over protection level", 2.0, "[0:3<*]"}, false);
  return text + "unset multiplot\n";
}

}  // namespace panvo::test
