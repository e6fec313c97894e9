// SPDX-License-Identifier: Apache-2.0
// panvo_compare_runs: compares the results of two runs.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "panvo/evaluation/run_comparison.hpp"

namespace {

enum ExitStatus { kSame = 0, kDifferent = 1, kUsage = 2 };

int print(const std::vector<panvo::evaluation::FileComparison>& comparisons) {
  std::size_t different = 0;
  for (const auto& file : comparisons) {
    std::string verdict = file.difference ? "DIFFERS  " + *file.difference : "same";
    if (file.worst_m) {
      char apart[80];
      std::snprintf(apart, sizeof apart, "  (at most %.4f m and %.3f deg apart)", *file.worst_m, *file.worst_deg);
      verdict += apart;
    }
    std::printf("  %-38s %7zu lines  %s\n", file.name.c_str(), file.lines, verdict.c_str());
    different += file.difference ? 1 : 0;
  }
  std::printf("%zu of %zu files as expected\n", comparisons.size() - different, comparisons.size());
  return different == 0 ? kSame : kDifferent;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Compares the results of a run with those of an earlier one. Exit status 0: equal, 1: different, 2: cannot be "
      "compared."};
  std::string run, expected;
  panvo::evaluation::RunTolerance tolerance;
  app.add_option("run", run, "folder of the run")->required();
  app.add_option("expected", expected, "folder of the earlier run")->required();
  app.add_option("--within-m", tolerance.position_m, "position tolerance, m (default: bit-identical)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--within-deg", tolerance.rotation_deg, "orientation tolerance, degrees")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
    return print(panvo::evaluation::compare_runs(run, expected, tolerance));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSame : kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo: error: %s\n", error.what());
    return kUsage;
  }
}
