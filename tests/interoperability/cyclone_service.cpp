// SPDX-License-Identifier: Apache-2.0
#include "cyclone_service.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "cyclone_services.h"

namespace panvo::test::cyclone {
namespace {

using Request = cyclone_services_SetBool_Request;
using Response = cyclone_services_SetBool_Response;

constexpr dds_duration_t kLimit = DDS_SECS(60);

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error(what + ": " + dds_strretcode(-entity));
  return entity;
}

/// Writer of one topic of a service and reader of the other.
class Ends {
 public:
  Ends(dds_domainid_t domain, const std::string& name, bool is_client)
      : participant_(checked(dds_create_participant(domain, nullptr, nullptr), "participant")),
        requests_(topic(cyclone_services_SetBool_Request_desc, "std_srvs::srv::dds_::SetBool_Request_",
                        "rq" + name + "Request")),
        replies_(topic(cyclone_services_SetBool_Response_desc, "std_srvs::srv::dds_::SetBool_Response_",
                       "rr" + name + "Reply")) {
    writer = open_writer(is_client ? requests_ : replies_, "clientid=1;");
    reader = open_reader(is_client ? replies_ : requests_, "clientid=1;");
  }
  ~Ends() { dds_delete(participant_); }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;

  /// Replaces the ends of a client by those of another, one by one.
  void open_writer_of(const std::string& client) { writer = open_writer(requests_, client); }
  void open_reader_of(const std::string& client) { reader = open_reader(replies_, client); }

  /// Whether the status changes within the time.
  bool comes(dds_entity_t entity, std::uint32_t status, dds_duration_t limit) const {
    checked(dds_set_status_mask(entity, status), "status mask");
    const dds_entity_t waitset = checked(dds_create_waitset(participant_), "waitset");
    checked(dds_waitset_attach(waitset, entity, 0), "waitset");
    const auto triggered = checked(dds_waitset_wait(waitset, nullptr, 0, limit), "wait");
    dds_delete(waitset);
    std::uint32_t taken = 0;
    dds_take_status(entity, &taken, status);
    return triggered > 0;
  }

  void wait_for(dds_entity_t entity, std::uint32_t status) const {
    if (!comes(entity, status, kLimit)) throw std::runtime_error("nothing came");
  }

  /// Takes the next message; it must be returned with dds_return_loan.
  void* take() const {
    void* messages[1] = {nullptr};
    dds_sample_info_t info[1];
    while (true) {
      const int taken = checked(dds_take(reader, messages, info, 1, 1), "take");
      if (taken > 0 && info[0].valid_data) return messages[0];
      if (taken > 0) dds_return_loan(reader, messages, taken);
      if (taken == 0) wait_for(reader, DDS_DATA_AVAILABLE_STATUS);
      messages[0] = nullptr;
    }
  }

  dds_entity_t writer = 0, reader = 0;

 private:
  dds_entity_t topic(dds_topic_descriptor_t descriptor, const char* wire_type, const std::string& name) const {
    descriptor.m_typename = wire_type;
    return checked(dds_create_topic(participant_, &descriptor, name.c_str(), nullptr, nullptr), "topic");
  }

  static dds_qos_t* qos(const std::string& user_data) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
    dds_qset_userdata(qos, user_data.data(), user_data.size());
    return qos;
  }
  dds_entity_t open_writer(dds_entity_t topic, const std::string& user_data) const {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> wanted(qos(user_data), dds_delete_qos);
    return checked(dds_create_writer(participant_, topic, wanted.get(), nullptr), "writer");
  }
  dds_entity_t open_reader(dds_entity_t topic, const std::string& user_data) const {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> wanted(qos(user_data), dds_delete_qos);
    return checked(dds_create_reader(participant_, topic, wanted.get(), nullptr), "reader");
  }

  const dds_entity_t participant_, requests_, replies_;
};

}  // namespace

void call_service(dds_domainid_t domain, const std::string& name, int count) {
  const Ends ends(domain, name, true);
  ends.wait_for(ends.writer, DDS_PUBLICATION_MATCHED_STATUS);
  ends.wait_for(ends.reader, DDS_SUBSCRIPTION_MATCHED_STATUS);
  Request request{};
  request.client = 0x1122334455667788;
  for (int n = 1; n <= count; ++n) {
    request.number = n;
    request.data = n % 2 == 1;
    checked(dds_write(ends.writer, &request), "write");
    void* message = ends.take();
    const auto& response = *static_cast<const Response*>(message);
    if (response.client != request.client) throw std::runtime_error("the reply has another client");
    std::printf("answer %lld %d %s\n", static_cast<long long>(response.number), response.success, response.message);
    std::fflush(stdout);
    dds_return_loan(ends.reader, &message, 1);
  }
}

void call_before_reading(dds_domainid_t domain, const std::string& name) {
  Ends ends(domain, name, true);
  ends.wait_for(ends.reader, DDS_SUBSCRIPTION_MATCHED_STATUS);
  ends.open_writer_of("clientid=2;");
  ends.wait_for(ends.writer, DDS_PUBLICATION_MATCHED_STATUS);
  Request request{.client = 2, .number = 7, .data = true};
  checked(dds_write(ends.writer, &request), "write");
  // A reply that does not wait for the second client's reader comes to the first one's within milliseconds.
  if (ends.comes(ends.reader, DDS_DATA_AVAILABLE_STATUS, DDS_MSECS(500)))
    throw std::runtime_error("answered too early");
  ends.open_reader_of("clientid=2;");
  void* message = ends.take();
  std::printf("answer %lld\n", static_cast<long long>(static_cast<const Response*>(message)->number));
  dds_return_loan(ends.reader, &message, 1);
}

void serve(dds_domainid_t domain, const std::string& name) {
  const Ends ends(domain, name, false);
  std::puts("serving");
  std::fflush(stdout);
  ends.wait_for(ends.writer, DDS_PUBLICATION_MATCHED_STATUS);  // a reply to an undiscovered reader is lost
  std::string text = "cyclone";
  while (true) {
    void* message = nullptr;
    try {
      message = ends.take();
    } catch (const std::runtime_error&) {
      return;
    }
    const auto& request = *static_cast<const Request*>(message);
    Response response{request.client, request.number, request.data, text.data()};
    checked(dds_write(ends.writer, &response), "write");
    dds_return_loan(ends.reader, &message, 1);
  }
}

}  // namespace panvo::test::cyclone
