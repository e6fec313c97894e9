// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/bag_check.hpp"

#include <algorithm>

#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_reader.hpp"

namespace panvo::recorder {

bool BagCheck::is_sound() const {
  return lost == 0 && problems.empty() &&
         std::all_of(topics.begin(), topics.end(), [](const TopicCheck& topic) { return topic.undecodable == 0; });
}

BagCheck check_bag(const std::filesystem::path& bag) {
  BagReader reader(bag);
  BagCheck check;
  std::vector<const interfaces::MessageType*> types;
  for (const auto& topic : reader.metadata().topics) {
    const bool is_cdr = topic.serialization_format == "cdr";
    types.push_back(is_cdr ? interfaces::find_message_type(full_type_name(topic.type)) : nullptr);
    check.topics.push_back({.name = topic.name, .type = topic.type, .is_decodable = types.back() != nullptr});
  }
  while (const BagMessage* message = reader.next()) {
    auto& topic = check.topics[message->topic];
    ++topic.readable;
    ++check.readable;
    if (!topic.is_decodable) {
      continue;
    }
    try {
      const auto& type = *types[message->topic];
      const auto decoded = type.deserialize(message->data);
      const auto problem = type.problem ? type.problem(decoded.get()) : std::nullopt;
      if (problem && topic.invalid++ == 0) topic.first_problem = *problem;
    } catch (const interfaces::DecodeError& error) {
      if (topic.undecodable++ == 0) {
        topic.first_error = error.what();
      }
    }
  }
  check.lost = reader.lost_messages();
  check.problems = reader.warnings();
  const auto complaints = reader.check_integrity();
  check.problems.insert(check.problems.end(), complaints.begin(), complaints.end());
  return check;
}

}  // namespace panvo::recorder
