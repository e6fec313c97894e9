// SPDX-License-Identifier: Apache-2.0
// A Cyclone DDS process started by the tests: writes the known messages, or reads messages and compares them with the
// known ones.
//   panvo_cyclone_peer DOMAIN write|read TYPE TOPIC COUNT reliable|best_effort volatile|transient_local
//   panvo_cyclone_peer DOMAIN call SERVICE COUNT | call_before_reading SERVICE | serve SERVICE, see cyclone_service.hpp
// COUNT messages, numbered from 0; one numbered COUNT may precede them. Prints `matched` when its reader has a writer,
// `right N` or `wrong N: FIELD` for each message it reads, `written` when all are written.
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "cyclone_messages.hpp"
#include "cyclone_service.hpp"

namespace panvo::test::cyclone {
namespace {

constexpr dds_duration_t kLimit = DDS_SECS(60);
constexpr std::int32_t kDepth = 10;  // ROS 2's default

struct Order {
  dds_domainid_t domain;
  std::string verb, type, topic;
  int count;
  bool reliable, transient_local;
};

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error(what + ": " + dds_strretcode(-entity));
  return entity;
}

void say(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

class Peer {
 public:
  explicit Peer(const Order& order) : order_(order), kind_(find_message_kind(order.type)) {
    if (!kind_) throw std::runtime_error("unknown type: " + order.type);
    participant_ = checked(dds_create_participant(order.domain, nullptr, nullptr), "participant");
    topic_ = checked(dds_create_topic(participant_, &kind_->descriptor, ("rt" + order.topic).c_str(), nullptr, nullptr),
                     "topic");
    dds_qset_reliability(qos_, order.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
    dds_qset_history(qos_, DDS_HISTORY_KEEP_LAST, kDepth);
    if (order.transient_local) {
      dds_qset_durability(qos_, DDS_DURABILITY_TRANSIENT_LOCAL);
      dds_qset_durability_service(qos_, 0, DDS_HISTORY_KEEP_LAST, kDepth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                  DDS_LENGTH_UNLIMITED);
    }
  }

  ~Peer() {
    dds_delete_qos(qos_);
    dds_delete(participant_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void write() {
    const dds_entity_t writer = checked(dds_create_writer(participant_, topic_, qos_, nullptr), "writer");
    if (!order_.transient_local) wait_for(writer, DDS_PUBLICATION_MATCHED_STATUS);
    for (int n = 0; n < order_.count; ++n) {
      void* message = kind_->make(n);
      checked(dds_write(writer, message), "write");
      dds_sample_free(message, &kind_->descriptor, DDS_FREE_ALL);
    }
    say("written");
    if (order_.transient_local) pause();  // for late-joining readers, until the test ends this process
    checked(dds_wait_for_acks(writer, kLimit), "acknowledgments");
  }

  void read() {
    const dds_entity_t reader = checked(dds_create_reader(participant_, topic_, qos_, nullptr), "reader");
    wait_for(reader, DDS_SUBSCRIPTION_MATCHED_STATUS);
    say("matched");
    for (int n = 0; n < order_.count;) {
      void* messages[1] = {nullptr};
      dds_sample_info_t info[1];
      const int taken = checked(dds_take(reader, messages, info, 1, 1), "take");
      if (taken == 0) {
        wait_for(reader, DDS_DATA_AVAILABLE_STATUS);
        continue;
      }
      const bool is_overture = n == 0 && info[0].valid_data && kind_->wrong(messages[0], order_.count).empty();
      if (info[0].valid_data && !is_overture) {
        const std::string wrong = kind_->wrong(messages[0], n);
        say((wrong.empty() ? "right " : "wrong ") + std::to_string(n) + (wrong.empty() ? "" : ": " + wrong));
        ++n;
      }
      checked(dds_return_loan(reader, messages, taken), "return loan");
    }
  }

 private:
  void wait_for(dds_entity_t entity, std::uint32_t status) const {
    checked(dds_set_status_mask(entity, status), "status mask");
    const dds_entity_t waitset = checked(dds_create_waitset(participant_), "waitset");
    checked(dds_waitset_attach(waitset, entity, 0), "waitset");
    if (checked(dds_waitset_wait(waitset, nullptr, 0, kLimit), "wait") == 0) {
      throw std::runtime_error(order_.topic + ": no peer found");
    }
    std::uint32_t taken = 0;
    dds_take_status(entity, &taken, status);
    dds_delete(waitset);
  }

  const Order order_;
  const MessageKind* const kind_;
  dds_qos_t* const qos_ = dds_create_qos();
  dds_entity_t participant_ = 0, topic_ = 0;
};

}  // namespace
}  // namespace panvo::test::cyclone

static int use_service(int argc, char** argv) {
  const auto domain = static_cast<dds_domainid_t>(std::stoul(argv[1]));
  const std::string verb = argv[2];
  try {
    if (argc == 5) {
      panvo::test::cyclone::call_service(domain, argv[3], std::stoi(argv[4]));
    } else if (verb == "call_before_reading") {
      panvo::test::cyclone::call_before_reading(domain, argv[3]);
    } else {
      panvo::test::cyclone::serve(domain, argv[3]);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo_cyclone_peer: %s\n", error.what());
    return 1;
  }
}

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphans after a crash of the test
  if (argc == 4 || argc == 5) return use_service(argc, argv);
  if (argc != 8) return 2;
  const std::string reliability = argv[6], durability = argv[7];
  const panvo::test::cyclone::Order order{static_cast<dds_domainid_t>(std::stoul(argv[1])),
                                          argv[2],
                                          argv[3],
                                          argv[4],
                                          std::stoi(argv[5]),
                                          reliability == "reliable",
                                          durability == "transient_local"};
  try {
    panvo::test::cyclone::Peer peer(order);
    order.verb == "write" ? peer.write() : peer.read();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "panvo_cyclone_peer: %s\n", error.what());
    return 1;
  }
}
