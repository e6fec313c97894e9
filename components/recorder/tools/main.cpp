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

namespace {

using namespace panvo::recorder;

enum ExitStatus { kWell = 0, kNotSo = 1, kError = 2 };

void warn(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) {
    std::fprintf(stderr, "panvo bag: warning: %s\n", warning.c_str());
  }
}

int info(const std::string& path, bool as_json) {
  const BagReader bag(path);
  warn(bag.warnings());
  std::fputs((as_json ? describe_as_json(bag) : describe_as_text(bag)).c_str(), stdout);
  return kWell;
}

int check(const std::string& path) {
  const auto found = check_bag(path);
  for (const auto& topic : found.topics) {
    std::printf("%-40s %-36s %8llu readable", topic.name.c_str(), topic.type.c_str(),
                static_cast<unsigned long long>(topic.readable));
    if (!topic.is_decodable) {
      std::printf(", of a type that is not known here\n");
    } else if (topic.undecodable == 0) {
      std::printf(", all decode\n");
    } else {
      std::printf(", %llu do not decode (%s)\n", static_cast<unsigned long long>(topic.undecodable),
                  topic.first_error.c_str());
    }
  }
  for (const auto& problem : found.problems) {
    std::printf("%s\n", problem.c_str());
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

int copy(const std::string& from, const std::string& to, const TopicFilter& topics, const BagWriter::Options& options) {
  const auto result = copy_bag(from, to, topics, options);
  warn(result.warnings);
  std::printf("%s: %llu messages copied, %llu could not be read\n", to.c_str(),
              static_cast<unsigned long long>(result.copied), static_cast<unsigned long long>(result.lost));
  return kWell;
}

int diff(const std::string& first, const std::string& second, const DiffOptions& options) {
  bool equal = true;
  for (const auto& topic : compare_bags(first, second, options)) {
    std::printf("%s: %s\n", topic.name.c_str(),
                topic.difference ? topic.difference->c_str()
                                 : ("equal, " + std::to_string(topic.equal_messages) + " messages").c_str());
    equal = equal && !topic.difference;
  }
  std::printf("%s\n", equal ? "equal" : "different");
  return equal ? kWell : kNotSo;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Looks into rosbag2 bags (SQLite), repairs and compares them.", "panvo bag");
  app.require_subcommand(1);
  app.footer("Exit status: 0 well, 1 the bags differ or the bag is not sound, 2 it could not be done.");
  std::string bag, other;
  std::vector<std::string> topics, exclude;
  bool as_json = false, times = false;
  BagWriter::Options writing;

  auto* info_command = app.add_subcommand("info", "what is in a bag: size, times, topics, dropped messages");
  info_command->add_option("BAG", bag, "bag folder or .db3 file")->required();
  info_command->add_flag("--json", as_json, "for scripts; times in ns");

  auto* check_command = app.add_subcommand("check", "read all of a bag: damage, unreadable and undecodable messages");
  check_command->add_option("BAG", bag, "bag folder or .db3 file")->required();

  auto* reindex_command = app.add_subcommand("reindex", "write metadata.yaml anew from the databases");
  reindex_command->add_option("BAG", bag, "bag folder")->required();

  auto* copy_command = app.add_subcommand(
      "copy", "write what is readable to a new bag: some topics, or of a damaged bag all that is left");
  copy_command->add_option("BAG", bag, "bag folder or .db3 file")->required();
  copy_command->add_option("NEW", other, "folder of the new bag")->required();
  copy_command
      ->add_option("--topic", topics, "only this topic, or those matching this regular expression; may be repeated")
      ->expected(1)
      ->take_all();
  copy_command->add_option("--exclude", exclude, "not these topics")->expected(1)->take_all();
  copy_command->add_flag("--overwrite", writing.overwrite, "replace a bag that is there");

  auto* diff_command = app.add_subcommand("diff", "compare the messages of two bags, bit for bit and topic by topic");
  diff_command->add_option("BAG1", bag, "bag folder or .db3 file")->required();
  diff_command->add_option("BAG2", other, "the other")->required();
  diff_command
      ->add_option("--topic", topics, "only this topic, or those matching this regular expression; may be repeated")
      ->expected(1)
      ->take_all();
  diff_command->add_option("--exclude", exclude, "not these topics")->expected(1)->take_all();
  diff_command->add_flag("--times", times, "recording times must be equal too");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kWell : kError;
  }
  try {
    if (*info_command) {
      return info(bag, as_json);
    }
    if (*check_command) {
      return check(bag);
    }
    if (*reindex_command) {
      return reindex(bag);
    }
    const TopicFilter filter(topics, exclude);
    return *copy_command ? copy(bag, other, filter, writing) : diff(bag, other, {filter, times});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo bag: %s\n", error.what());
    return kError;
  }
}
