// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_diff.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {
namespace {

const BagTopic* find_topic(const BagReader& bag, const std::string& name) {
  const auto& topics = bag.metadata().topics;
  const auto found =
      std::find_if(topics.begin(), topics.end(), [&](const BagTopic& topic) { return topic.name == name; });
  return found == topics.end() ? nullptr : &*found;
}

void add_names(const BagReader& bag, const TopicFilter& filter, std::set<std::string>& names) {
  for (const auto& topic : bag.metadata().topics) {
    if (topic.message_count > 0 && filter.accepts(topic.name)) {
      names.insert(topic.name);
    }
  }
}

std::optional<std::string> difference(const BagMessage& a, const BagMessage& b, bool times) {
  if (a.data != b.data) {
    const auto place = static_cast<std::size_t>(
        std::mismatch(a.data.begin(), a.data.end(), b.data.begin(), b.data.end()).first - a.data.begin());
    if (place >= std::min(a.data.size(), b.data.size())) {
      return "has " + std::to_string(a.data.size()) + " and " + std::to_string(b.data.size()) +
             " bytes; the common part is equal";
    }
    char values[32];
    std::snprintf(values, sizeof values, "0x%02x, 0x%02x", a.data[place], b.data[place]);
    return "differs at byte " + std::to_string(place) + " of " + std::to_string(a.data.size()) +
           (a.data.size() == b.data.size() ? "" : " and " + std::to_string(b.data.size())) + ": " + values;
  }
  if (times && a.timestamp_ns != b.timestamp_ns) {
    return "was recorded at " + std::to_string(a.timestamp_ns) + " and " + std::to_string(b.timestamp_ns) + " ns";
  }
  return std::nullopt;
}

TopicComparison compare_topic(const std::string& name, BagReader& first, BagReader& second, bool times) {
  TopicComparison comparison{.name = name};
  const auto* first_topic = find_topic(first, name);
  const auto* second_topic = find_topic(second, name);
  if (!first_topic || !second_topic) {
    comparison.difference = "is in " + (first_topic ? first : second).path().string() + " only";
    return comparison;
  }
  if (first_topic->type != second_topic->type) {
    comparison.difference = "has types " + first_topic->type + " and " + second_topic->type;
    return comparison;
  }
  const auto is_this = [&](const BagTopic& topic) { return topic.name == name; };
  first.select(is_this);
  second.select(is_this);
  while (true) {
    const BagMessage* a = first.next();
    const BagMessage* b = second.next();
    if (!a && !b) {
      return comparison;
    }
    if (!a || !b) {
      comparison.difference = "ends after " + std::to_string(comparison.equal_messages) + " equal messages in " +
                              (a ? second : first).path().string() + " but continues in the other bag";
      return comparison;
    }
    if (const auto what = difference(*a, *b, times)) {
      comparison.difference = "message " + std::to_string(comparison.equal_messages) + " " + *what;
      return comparison;
    }
    ++comparison.equal_messages;
  }
}

void refuse_losses(const BagReader& bag) {
  if (bag.lost_messages() > 0) {
    throw BagError(bag.path().string() + ": " + std::to_string(bag.lost_messages()) +
                   " messages cannot be read, so the bag cannot be compared; see `panvo bag check`");
  }
}

}  // namespace

std::vector<TopicComparison> compare_bags(const std::filesystem::path& first_path,
                                          const std::filesystem::path& second_path, const DiffOptions& options) {
  BagReader first(first_path);
  BagReader second(second_path);
  std::set<std::string> names;
  add_names(first, options.topics, names);
  add_names(second, options.topics, names);
  std::vector<TopicComparison> comparisons;
  for (const auto& name : names) {
    comparisons.push_back(compare_topic(name, first, second, options.times));
    refuse_losses(first);
    refuse_losses(second);
  }
  return comparisons;
}

}  // namespace panvo::recorder
