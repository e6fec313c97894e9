// SPDX-License-Identifier: Apache-2.0
// Program of `panvo bench faults`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <map>

#include "fault_runs.hpp"
#include "fault_table.hpp"
#include "gnuplot.hpp"
#include "panvo/evaluation/plot.hpp"

namespace panvo::test {
namespace {

struct Options {
  std::vector<std::string> inputs, only;
  int seeds = 1;
  bool lists = false;
  FaultRunOptions run{PANVO_RUN, FAULT_SYSTEM, "faults", "", 1};
};

/// Returns an exit status if there is nothing to run.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app("Plays recordings with injected faults through the whole system and evaluates errors and integrity.",
               "panvo bench faults");
  app.add_option("--inputs", options.inputs, "recordings with stereo pairs, panoramas and ground truth")
      ->delimiter(',');
  app.add_option("--only", options.only, "kinds of fault, separated by commas (default: all)")->delimiter(',');
  app.add_option("--seeds", options.seeds, "number of random variants of each fault per recording")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--out", options.run.out, "folder for the results")->capture_default_str();
  app.add_option("--jobs", options.run.jobs, "number of parallel runs")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--key", options.run.key, "identifies programs and settings; runs with another key are repeated");
  app.add_option("--run", options.run.program, "program that runs the system");
  app.add_flag("--list", options.lists, "list the kinds of fault");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

std::vector<FaultRun> plan(const Options& options, const std::vector<FaultInput>& inputs) {
  std::vector<FaultRun> runs;
  const auto add = [&](const FaultKind& kind) {
    const bool is_disturbed = &kind != &fault_kinds().front();
    for (const auto& input : inputs) {
      // Runs without a fault do not depend on the seed, so one suffices.
      for (int seed = 1; seed <= (is_disturbed ? options.seeds : 1); ++seed) {
        runs.push_back({&kind, &input, static_cast<std::uint64_t>(seed)});
      }
    }
  };
  if (options.only.empty()) {
    for (const auto& kind : fault_kinds()) add(kind);
  }
  for (const auto& name : options.only) add(fault_kind(name));
  return runs;
}

FaultTable table_of(const std::vector<FaultResult>& results) {
  FaultTable table;
  for (const auto& result : results) {
    const std::string kind(result.run.kind->name);
    if (table.rows.empty() || table.rows.back().kind != kind) {
      table.rows.emplace_back();
      table.rows.back().kind = kind;
    }
    FaultRow& row = table.rows.back();
    ++row.runs;
    row.unscored_poses += result.unscored_poses;
    if (result.score) {
      row.add(*result.score);
    } else {
      ++row.failed;
    }
  }
  return table;
}

/// Not atomic: the runs are kept, and the table can be recreated quickly.
void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + " cannot be written; check disk space and permissions");
}

void write_results(const FaultTable& table, const std::filesystem::path& folder) {
  write(folder / "faults.txt", to_text(table));
  write(folder / "faults.csv", to_csv(table));
  write(folder / "faults.json", to_json(table));
  try {
    evaluation::write_and_run_gnuplot(folder, "faults.gp", plot_script(table, "faults"));
  } catch (const evaluation::PlotError& error) {
    std::cerr << "no plot: " << error.what() << '\n';
  }
}

int run_bench(const Options& options) {
  if (options.lists) {
    for (const auto& kind : fault_kinds()) std::cout << fmt::format("{:<22}{}\n", kind.name, kind.description);
    return 0;
  }
  if (options.inputs.empty()) throw std::runtime_error("no recordings given; name them with --inputs");
  std::vector<FaultInput> inputs;
  for (const auto& folder : options.inputs) inputs.push_back(open_input(folder));
  const auto runs = plan(options, inputs);
  std::filesystem::create_directories(options.run.out);
  const auto results = play_faults(runs, options.run, [](const std::string& line) { std::cerr << line << std::endl; });
  const FaultTable table = table_of(results);
  std::cout << to_text(table) << std::flush;
  write_results(table, options.run.out);
  return table.all().failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace panvo::test

int main(int argc, char** argv) {
  panvo::test::Options options;
  if (const auto status = panvo::test::parse(argc, argv, options)) return *status;
  try {
    return panvo::test::run_bench(options);
  } catch (const std::exception& error) {
    std::cerr << "panvo bench faults: " << error.what() << '\n';
    return 2;
  }
}
