// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "cyclone_header.hpp"
#include "fast_dds.hpp"
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
/// reader has been discovered, as it would be lost before. Other requests are answered meanwhile. Clients of Cyclone
/// DDS are answered as by rmw_cyclonedds, with a header in the reply; their reply reader is any of their process.
class ServiceServer final : public BridgeService, private fdds::DataReaderListener {
 public:
  /// Throws ConfigError if Fast DDS refuses its topics.
  ServiceServer(const ServiceDescription& service, ServiceHandler handler, ServiceGuard guard,
                const RequestLimits& limits, std::shared_ptr<Participant> readers, std::shared_ptr<Participant> writers,
                std::shared_ptr<ServiceQueue> queue, std::shared_ptr<Notifier> notifier);
  ~ServiceServer() override;

  ServiceCounters counters() const override;

 private:
  using Identity = rtps::SampleIdentity;

  void on_data_available(fdds::DataReader* reader) override;
  /// Whether a request exceeds the rate or size limit; this is counted and logged.
  bool is_over_limits(const Incoming& incoming);
  struct Asker {
    Identity identity;  // of the request; its writer is the reply reader, if known
    Caller caller;
    std::optional<CycloneHeader> header{};  // of a client of Cyclone DDS
  };

  /// nullopt if the request of a Cyclone client lacks its header, which is removed from `request`.
  std::optional<Asker> asker_of(const fdds::SampleInfo& info, interfaces::Bytes& request) const;
  void answer(const interfaces::Bytes& request, const Asker& asker);
  interfaces::Bytes response_to(const interfaces::Bytes& request, const Caller& caller);
  bool is_reachable(const Asker& asker) const;
  void send(const interfaces::Bytes& response, const Asker& asker);
  void keep(interfaces::Bytes response, const Asker& asker);
  /// Sends kept replies whose clients are now reachable and discards expired ones.
  void send_kept();
  void set_alarm();  ///< when the oldest kept reply expires
  void give_up();

  struct Kept {
    interfaces::Bytes response;
    Asker asker;
    ServiceQueue::Clock::time_point end;
  };

  const std::string name_;
  const ServiceHandler handler_;
  const ServiceGuard guard_;
  const RequestLimits limits_;
  const std::shared_ptr<Participant> readers_, writers_;
  const std::shared_ptr<ServiceQueue> queue_;
  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<fdds::Topic> request_topic_, reply_topic_;

  std::mutex taking_mutex_;  // guards the two below
  RateLimit rate_;
  bool closed_ = false;
  std::atomic<std::uint64_t> received_ = 0, answered_ = 0, malformed_ = 0, dropped_ = 0, refused_ = 0, unanswered_ = 0;
  std::deque<Kept> kept_;  // oldest first; this and the next are used on the service thread only
  bool alarm_set_ = false;
  MatchedReaders clients_;
  fdds::DataWriter* writer_ = nullptr;
  fdds::DataReader* reader_ = nullptr;  // last: requests may arrive from now on
};

/// Topics of a service's requests and replies.
WireTopic request_topic(const ServiceDescription& service);
WireTopic reply_topic(const ServiceDescription& service);

}  // namespace panvo::runtime::dds
