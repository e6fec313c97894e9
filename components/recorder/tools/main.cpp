// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "bag_info.hpp"
#include "panvo/recorder/bag_check.hpp"
#include "panvo/recorder/bag_copy.hpp"
#include "panvo/recorder/bag_diff.hpp"
#include "panvo/recorder/bag_reader.hpp"
#include "panvo/runtime/printable.hpp"

namespace {

using namespace panvo::recorder;
using panvo::runtime::printable;  // strings in a bag are untrusted

enum ExitStatus { kWell = 0, kNotSo = 1, kError = 2 };

void warn(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) {
    std::fprintf(stderr, "panvo bag: warning: %s\n", printable(warning).c_str());
  }
}

int info(const std::string& path, bool as_json) {
  const BagReader bag(path);
  warn(bag.warnings());
  std::fputs((as_json ? describe_as_json(bag) : printable(describe_as_text(bag))).c_str(), stdout);
  return kWell;
}

int print_check(const std::string& path) {
  const auto found = check_bag(path);
  for (const auto& topic : found.topics) {
    std::printf("%-40s %-36s %8llu readable", printable(topic.name).c_str(), printable(topic.type).c_str(),
                static_cast<unsigned long long>(topic.readable));
    if (!topic.is_decodable) {
      std::printf(", not decoded: no library for its type");
    } else if (topic.undecodable == 0) {
      std::printf(", all decodable");
    } else {
      std::printf(", %llu not decodable (%s)", static_cast<unsigned long long>(topic.undecodable),
                  printable(topic.first_error).c_str());
    }
    if (topic.invalid > 0) {
      std::printf(", %llu invalid (%s)", static_cast<unsigned long long>(topic.invalid), topic.first_problem.c_str());
    }
    std::printf("\n");
  }
  for (const auto& problem : found.problems) {
    std::printf("%s\n", printable(problem).c_str());
  }
  std::printf("%s: %llu messages readable, %llu lost: %s\n", path.c_str(),
              static_cast<unsigned long long>(found.readable), static_cast<unsigned long long>(found.lost),
              found.is_sound() ? "sound" : "not sound");
  return found.is_sound() ? kWell : kNotSo;
}

int reindex(const std::string& path) {
  std::vector<std::string> warnings;
  const auto metadata = reindex_bag(path, warnings);
  warn(warnings);
  std::printf("%s: metadata.yaml written, %llu messages on %zu topics\n", path.c_str(),
              static_cast<unsigned long long>(metadata.message_count), metadata.topics.size());
  return kWell;
}

int copy(const std::string& from, const std::string& to, const CopySelection& selection,
         const BagWriter::Options& options) {
  const auto result = copy_bag(from, to, selection, options);
  warn(result.warnings);
  std::printf("%s: %llu messages copied, %llu could not be read\n", to.c_str(),
              static_cast<unsigned long long>(result.copied), static_cast<unsigned long long>(result.lost));
  return kWell;
}

int diff(const std::string& first, const std::string& second, const DiffOptions& options) {
  bool equal = true;
  for (const auto& topic : compare_bags(first, second, options)) {
    const auto found = topic.difference.value_or("equal, " + std::to_string(topic.equal_messages) + " messages");
    std::printf("%s: %s\n", printable(topic.name).c_str(), printable(found).c_str());
    equal = equal && !topic.difference;
  }
  std::printf("%s\n", equal ? "equal" : "different");
  return equal ? kWell : kNotSo;
}

/// Options shared by several commands.
struct Arguments {
  std::string bag, other;
  std::vector<std::string> topics, exclude;
  std::string storage, compression, from, to;
  bool as_json = false, times = false, overwrite = false;
};

void add_bag(CLI::App& command, Arguments& arguments, const char* what = "bag folder, or one .db3 or .mcap file") {
  command.add_option("BAG", arguments.bag, what)->required();
}

void add_topics(CLI::App& command, Arguments& arguments) {
  command
      .add_option("--topic", arguments.topics,
                  "only this topic, or those matching this regular expression; may be repeated")
      ->expected(1)
      ->take_all();
  command.add_option("--exclude", arguments.exclude, "topics to exclude; may be repeated")->expected(1)->take_all();
}

void add_new_bag(CLI::App& command, Arguments& arguments) {
  command.add_option("NEW", arguments.other, "folder of the new bag")->required();
  add_topics(command, arguments);
  command.add_option("--storage", arguments.storage, "storage of the new bag: sqlite3 or mcap");
  command.add_option("--compression", arguments.compression, "compression of mcap: none, lz4 or zstd");
  command.add_flag("--overwrite", arguments.overwrite, "replace an existing bag");
}

/// Options of the new bag. Default storage: that of the old bag if `as_it_is`, otherwise the other one.
BagWriter::Options writing(const Arguments& arguments, bool as_it_is) {
  BagWriter::Options options;
  options.overwrite = arguments.overwrite;
  if (!arguments.compression.empty()) {
    options.compression = compression_from_text(arguments.compression);
  }
  if (!arguments.storage.empty()) {
    options.storage = storage_from_text(arguments.storage);
  } else {
    const bool is_mcap = BagReader(arguments.bag).metadata().storage_identifier == to_text(Storage::kMcap);
    const bool compressed = options.compression != Compression::kNone;
    options.storage = is_mcap == as_it_is || compressed ? Storage::kMcap : Storage::kSqlite3;
  }
  return options;
}

CopySelection stretch(const Arguments& arguments) {
  CopySelection selection{.topics = TopicFilter(arguments.topics, arguments.exclude)};
  const auto start_ns = BagReader(arguments.bag).metadata().start_ns;
  if (!arguments.from.empty()) {
    selection.from_ns = parse_bag_time(arguments.from, start_ns);
  }
  if (!arguments.to.empty()) {
    selection.to_ns = parse_bag_time(arguments.to, start_ns);
  }
  if (selection.from_ns >= selection.to_ns) {
    throw BagError("--from " + arguments.from + " is not before --to " + arguments.to);
  }
  return selection;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Inspects, repairs, converts, slices and compares rosbag2 bags (SQLite and MCAP).", "panvo bag");
  app.require_subcommand(1);
  app.footer("Exit status: 0 success, 1 the bags differ or the bag is not sound, 2 error.");
  Arguments arguments;

  auto* info_command = app.add_subcommand("info", "show size, times, topics and dropped messages of a bag");
  add_bag(*info_command, arguments);
  info_command->add_flag("--json", arguments.as_json, "print JSON; times in ns");

  auto* check_command =
      app.add_subcommand("check", "read a whole bag; report damage, unreadable and undecodable messages");
  add_bag(*check_command, arguments);

  auto* reindex_command = app.add_subcommand("reindex", "rewrite metadata.yaml from the files");
  add_bag(*reindex_command, arguments, "bag folder");

  auto* copy_command = app.add_subcommand(
      "copy", "copy the readable messages to a new bag: selected topics, or the rest of a damaged bag");
  add_bag(*copy_command, arguments);
  add_new_bag(*copy_command, arguments);

  auto* convert_command = app.add_subcommand("convert", "convert a SQLite bag to MCAP, or an MCAP bag to SQLite");
  add_bag(*convert_command, arguments);
  add_new_bag(*convert_command, arguments);

  auto* slice_command =
      app.add_subcommand("slice", "copy a time range to a new bag, with earlier latched messages at its start");
  add_bag(*slice_command, arguments);
  add_new_bag(*slice_command, arguments);
  const std::string time = ": seconds from the bag's start, or a stamp in seconds or nanoseconds";
  slice_command->add_option("--from", arguments.from, "start" + time);
  slice_command->add_option("--to", arguments.to, "end" + time + "; exclusive");

  auto* diff_command = app.add_subcommand("diff", "compare the messages of two bags bit by bit, topic by topic");
  diff_command->add_option("BAG1", arguments.bag, "bag folder, or one .db3 or .mcap file")->required();
  diff_command->add_option("BAG2", arguments.other, "the bag to compare with")->required();
  add_topics(*diff_command, arguments);
  diff_command->add_flag("--times", arguments.times, "also compare recording times");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kWell : kError;
  }
  try {
    if (*info_command) {
      return info(arguments.bag, arguments.as_json);
    }
    if (*check_command) {
      return print_check(arguments.bag);
    }
    if (*reindex_command) {
      return reindex(arguments.bag);
    }
    if (*diff_command) {
      return diff(arguments.bag, arguments.other, {TopicFilter(arguments.topics, arguments.exclude), arguments.times});
    }
    return copy(arguments.bag, arguments.other, stretch(arguments), writing(arguments, !*convert_command));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo bag: %s\n", error.what());
    return kError;
  }
}
