// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/SampleIdentity.h>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>

#include "matched_readers.hpp"
#include "notifier.hpp"
#include "panvo/runtime/service.hpp"
#include "participant.hpp"
#include "rate_limit.hpp"
#include "request_limits.hpp"
#include "sample_data_type.hpp"
#include "service_queue.hpp"

namespace panvo::runtime::dds {

/// A service compatible with rmw_fastrtps: requests and replies are topics; a reply carries the identity of its request
/// in `related_sample_identity`, where the client has put the GUID of its reply reader. A reply is kept until that
/// reader has been discovered, as it would be lost before. Other requests are answered meanwhile.
class ServiceServer final : public BridgeService, private eprosima::fastdds::dds::DataReaderListener {
 public:
  /// Throws ConfigError if Fast DDS refuses its topics.
  ServiceServer(const ServiceDescription& service, ServiceHandler handler, ServiceGuard guard,
                const RequestLimits& limits, std::shared_ptr<Participant> readers, std::shared_ptr<Participant> writers,
                std::shared_ptr<ServiceQueue> queue, std::shared_ptr<Notifier> notifier);
  ~ServiceServer() override;

  ServiceCounters counters() const override;

 private:
  using Identity = eprosima::fastrtps::rtps::SampleIdentity;

  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override;
  /// Whether a request exceeds the rate or size limit; this is counted and logged.
  bool is_over_limits(const Incoming& incoming);
  void answer(const interfaces::Bytes& request, const Identity& identity, const Caller& caller);
  interfaces::Bytes response_to(const interfaces::Bytes& request, const Caller& caller);
  bool is_reachable(const Identity& client) const;
  void send(const interfaces::Bytes& response, const Identity& identity);
  void keep(interfaces::Bytes response, const Identity& identity);
  /// Sends kept replies whose clients are now reachable and discards expired ones.
  void send_kept();
  void set_alarm();  ///< when the oldest kept reply expires
  void give_up();

  struct Kept {
    interfaces::Bytes response;
    Identity identity;
    ServiceQueue::Clock::time_point end;
  };

  const std::string name_;
  const ServiceHandler handler_;
  const ServiceGuard guard_;
  const RequestLimits limits_;
  const std::shared_ptr<Participant> readers_, writers_;
  const std::shared_ptr<ServiceQueue> queue_;
  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<eprosima::fastdds::dds::Topic> request_topic_, reply_topic_;

  std::mutex taking_mutex_;  // guards the two below
  RateLimit rate_;
  bool closed_ = false;
  std::atomic<std::uint64_t> received_ = 0, answered_ = 0, malformed_ = 0, dropped_ = 0, refused_ = 0, unanswered_ = 0;
  std::deque<Kept> kept_;  // oldest first; this and the next are used on the service thread only
  bool alarm_set_ = false;
  MatchedReaders clients_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;  // last: requests may arrive from now on
};

/// Topics of a service's requests and replies.
WireTopic request_topic(const ServiceDescription& service);
WireTopic reply_topic(const ServiceDescription& service);

/// QoS of service topics in ROS 2.
inline constexpr interfaces::Qos kServiceQos{.depth = 10};

}  // namespace panvo::runtime::dds
