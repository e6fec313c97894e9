// SPDX-License-Identifier: Apache-2.0
/// witness_bags FOLDER: writes the same messages to bags of every storage and compression, and the expected content to
/// FOLDER/expected.json.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../test_bag.hpp"
#include "panvo/interfaces/topics.hpp"

namespace {

using namespace panvo;
using namespace panvo::recorder;

struct Written {
  std::string topic;
  std::int64_t time_ns;
  interfaces::Bytes data;
  nlohmann::json expected;
};

template <class Message>
interfaces::Bytes bytes_of(const Message& message) {
  const auto& type = interfaces::message_type<Message>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return bytes;
}

std::string hexadecimal(const interfaces::Bytes& bytes) {
  std::string text;
  for (const auto byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

std::vector<Written> make_messages() {
  std::vector<Written> messages;
  for (int i = 0; i < 40; ++i) {
    const auto time_ns = test::kStart + i * test::kStep;
    nav_msgs::msg::Odometry odometry;
    odometry.header().frame_id("odom");
    odometry.header().stamp().sec(i);
    odometry.pose().pose().position().x(1.25 * i);
    odometry.pose().covariance()[35] = 17.5;
    messages.push_back({"/odometry/binocular",
                        time_ns,
                        bytes_of(odometry),
                        {{"x", 1.25 * i}, {"frame", "odom"}, {"covariance", 17.5}}});
    if (i % 10 == 0) {
      tf2_msgs::msg::TFMessage transforms;
      transforms.transforms().resize(static_cast<std::size_t>(i / 10));
      messages.push_back({"/tf", time_ns + 1, bytes_of(transforms), nlohmann::json::object()});
    }
  }
  return messages;
}

void write_bag(const std::filesystem::path& bag, BagWriter::Options options, const std::vector<Written>& messages) {
  options.overwrite = true;
  options.chunk_bytes = 4000;
  BagWriter writer(bag, options);
  const auto add = [&](const char* name, const interfaces::MessageType& type) {
    return writer.add_topic(BagTopic::of(name, type, interfaces::qos::kResult), type.definition);
  };
  const int odometry = add("/odometry/binocular", interfaces::message_type<nav_msgs::msg::Odometry>());
  const int tf = add("/tf", interfaces::message_type<tf2_msgs::msg::TFMessage>());
  for (const auto& message : messages) {
    writer.write(message.topic == "/tf" ? tf : odometry, message.time_ns, message.data);
  }
  writer.close();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: witness_bags FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const auto messages = make_messages();
  nlohmann::json expected;
  const auto add_topic = [&](const char* name, const interfaces::MessageType& type) {
    expected["topics"].push_back({{"name", name}, {"type", type.name}, {"hash", type.hash}});
  };
  add_topic("/odometry/binocular", interfaces::message_type<nav_msgs::msg::Odometry>());
  add_topic("/tf", interfaces::message_type<tf2_msgs::msg::TFMessage>());
  for (const auto& message : messages) {
    auto entry = message.expected;
    entry["topic"] = message.topic;
    entry["time"] = std::to_string(message.time_ns);
    entry["bytes"] = hexadecimal(message.data);
    expected["messages"].push_back(std::move(entry));
  }
  const auto write = [&](const std::string& name, const BagWriter::Options& options) {
    write_bag(folder / name, options, messages);
    expected["bags"].push_back(name);
  };
  write("sqlite3", {});
  for (const auto compression : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    write("mcap_" + to_text(compression), {.storage = Storage::kMcap, .compression = compression});
  }
  std::ofstream(folder / "expected.json") << expected.dump(1);
  return 0;
}
