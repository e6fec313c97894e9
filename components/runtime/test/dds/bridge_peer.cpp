// SPDX-License-Identifier: Apache-2.0
// The other process of the bridge's tests. Reads commands from stdin, one per line, and answers each with a line
// starting with `ok` or `error`; prints `received TOPIC SIZE HASH` for each received message. Ends with its input.
#include <sys/prctl.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <map>
#include <mutex>
#include <sstream>

#include "dds/names.hpp"
#include "dds/node_info.hpp"
#include "late_client.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"
#include "raw_reader.hpp"
#include "raw_writer.hpp"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "service_messages.hpp"
#include "test_messages.hpp"

namespace panvo::runtime::test {
namespace {

class Peer {
 public:
  Peer(int domain, std::uint32_t shared_image_bytes)
      : domain_(domain), bridge_(make_dds_bridge(settings(domain, shared_image_bytes))) {}

  void run() {
    for (std::string line; std::getline(std::cin, line);) {
      try {
        say("ok " + obey(line));
      } catch (const std::exception& error) {
        say(std::string("error ") + error.what());
      }
    }
  }

 private:
  static DdsSettings settings(int domain, std::uint32_t shared_image_bytes) {
    DdsSettings settings{.domain = domain, .profiles = "", .name = "peer", .shared_image_bytes = shared_image_bytes};
    const auto environment = dds_settings_from_environment();
    settings.range = environment.range;
    settings.peers = environment.peers;
    return settings;
  }

  std::string obey(const std::string& line) {
    std::istringstream words(line);
    std::string verb, name;
    words >> verb >> name;
    if (verb == "open_writer") {
      writers_[name] = bridge_->open_writer(read_topic(name, words));
    } else if (verb == "open_reader") {
      readers_[name] = bridge_->open_reader(read_topic(name, words), [this, name](const SamplePtr& sample) {
        say("received " + name + " " + std::to_string(sample->bytes().size()) + " " +
            std::to_string(hash(sample->bytes())));
      });
    } else if (verb == "open_nodes_reader") {  // like one of ROS 2: of Humble without user data, of Jazzy with a hash
      std::string user_data;
      words >> user_data;
      const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
      raw_readers_[name] = std::make_unique<RawReader>(
          domain_, kNodesTopic, std::string(type.dds_name), user_data,
          [this, name](const auto& bytes) { say("received " + name + " " + std::to_string(bytes.size())); });
    } else if (verb == "open_nodes_writer") {
      const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
      raw_writers_[name] = std::make_unique<RawWriter>(domain_, kNodesTopic, std::string(type.dds_name),
                                                       RawWriter::Offer{.transient_local = true});
    } else if (verb == "write_nodes") {  // NODE TIMES
      dds::NodeInfo info;
      info.nodes.resize(1);
      int times = 0;
      words >> info.nodes[0].name >> times;
      for (; times > 0; --times) raw_writers_.at(name)->write(dds::encode(info, dds::kGidSize));
    } else if (verb == "close_nodes_reader") {
      raw_readers_.erase(name);
    } else if (verb == "close_reader") {
      readers_.erase(name);
    } else if (verb == "open_raw_writer") {
      std::string type_name, reliability, durability, range;
      words >> type_name >> reliability >> durability >> range;
      raw_writers_[name] = std::make_unique<RawWriter>(
          domain_, dds::wire_topic_name(name), dds::wire_type_name(type_name).value_or(type_name),
          RawWriter::Offer{reliability == "reliable", durability == "transient_local", range == "localhost"});
    } else if (verb == "write_image") {
      std::size_t size = 0;
      std::uint32_t seed = 0;
      words >> size >> seed;
      return writers_.at(name)->write(image_sample(size, seed)) ? "written" : "refused";
    } else if (verb == "write_text") {
      std::string text;
      words >> text;
      return writers_.at(name)->write(text_sample(text)) ? "written" : "refused";
    } else if (verb == "write_bytes") {  // as decimal numbers
      std::vector<std::uint8_t> bytes;
      for (int byte = 0; words >> byte;) bytes.push_back(static_cast<std::uint8_t>(byte));
      if (const auto raw = raw_writers_.find(name); raw != raw_writers_.end())
        return raw->second->write(bytes) ? "written" : "refused";
      return writers_.at(name)->write(Sample::from_bytes(nullptr, "", bytes, 0)) ? "written" : "refused";
    } else if (verb == "matched") {
      if (const auto raw = raw_writers_.find(name); raw != raw_writers_.end())
        return std::to_string(raw->second->matched_readers());
      if (const auto writer = writers_.find(name); writer != writers_.end())
        return std::to_string(writer->second->matched_readers());
      return std::to_string(readers_.at(name)->matched_writers());
    } else if (verb == "matched_writers") {  // if there is also a writer of this name
      return std::to_string(readers_.at(name)->matched_writers());
    } else if (verb == "counters") {
      const auto counters = readers_.at(name)->counters();
      return std::to_string(counters.received) + " " + std::to_string(counters.lost) + " " +
             std::to_string(counters.undecodable);
    } else if (verb == "open_raw_client") {  // of the service type in service_messages.hpp
      raw_writers_[name] = std::make_unique<RawWriter>(
          domain_, dds::wire_request_name(name), dds::wire_type_name(std::string(kServiceType) + "_Request").value(),
          RawWriter::Offer{.reliable = true});
    } else if (verb == "open_late_client") {
      late_clients_[name] = std::make_unique<LateClient>(domain_, name, kServiceType);
    } else if (verb == "ask_late") {  // may be lost until the server is discovered
      std::string text;
      words >> text;
      return late_clients_.at(name)->ask(request(text)) ? "asked" : "not asked";
    } else if (verb == "late_reply") {
      late_clients_.at(name)->show_reader();
      const auto reply = late_clients_.at(name)->reply();
      return reply.empty() ? "nothing" : text_of_response(reply);
    } else if (verb == "serve") {
      services_[name] = bridge_->serve({name, kServiceType}, [](const interfaces::Bytes& request) {
        return response("peer:" + text_of_request(request));
      });
    } else if (verb == "stop_serving") {
      services_.erase(name);
    } else if (verb == "call") {
      std::string text;
      words >> text;
      auto& client = clients_[name];
      if (!client) client = bridge_->open_client({name, kServiceType});
      if (!client->wait_for_service(kLimit)) return "nobody";
      const auto answer = client->call(request(text), kLimit);
      return answer ? text_of_response(*answer) : "nothing";
    } else if (verb == "set_node") {  // publishing TOPIC, serving SERVICE
      NodeDescription node{"/", name, {}, {}, {}};
      std::string published, served;
      words >> published >> served;
      node.publishes = {published};
      node.serves = {served};
      bridge_->set_nodes({node});
    } else if (verb == "nodes") {
      std::string nodes;
      for (const auto& node : bridge_->graph().nodes) {
        nodes += " " + node.name_space + " " + node.name + " " + std::to_string(node.readers.size()) + " " +
                 std::to_string(node.writers.size());
      }
      return "nodes" + nodes;
    } else {
      throw std::invalid_argument("no such command: " + line);
    }
    return verb;
  }

  // TYPE RELIABILITY DURABILITY DEPTH [keep_all]
  static TopicDescription read_topic(const std::string& name, std::istringstream& words) {
    std::string type_name, reliability, durability, history;
    interfaces::Qos qos;
    words >> type_name >> reliability >> durability >> qos.depth >> history;
    qos.requested =
        reliability == "best_effort" ? interfaces::Reliability::kBestEffort : interfaces::Reliability::kReliable;
    qos.durability =
        durability == "transient_local" ? interfaces::Durability::kTransientLocal : interfaces::Durability::kVolatile;
    qos.keep_all = history == "keep_all";
    return topic(name, type_name, qos);
  }

  void say(const std::string& line) {
    const std::lock_guard lock(mutex_);
    std::cout << line << std::endl;
  }

  const int domain_;
  std::mutex mutex_;
  std::unique_ptr<Bridge> bridge_;
  std::map<std::string, std::unique_ptr<BridgeWriter>> writers_;
  std::map<std::string, std::unique_ptr<BridgeReader>> readers_;
  std::map<std::string, std::unique_ptr<RawWriter>> raw_writers_;
  std::map<std::string, std::unique_ptr<RawReader>> raw_readers_;
  std::map<std::string, std::unique_ptr<LateClient>> late_clients_;
  std::map<std::string, std::unique_ptr<BridgeService>> services_;
  std::map<std::string, std::unique_ptr<BridgeClient>> clients_;
};

}  // namespace
}  // namespace panvo::runtime::test

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with a crashed test
  if (argc < 2 || argc > 3) return 2;
  panvo::runtime::test::Peer(std::stoi(argv[1]), argc == 3 ? static_cast<std::uint32_t>(std::stoul(argv[2])) : 0).run();
}
