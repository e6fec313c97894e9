// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "fast_dds.hpp"
#include "matched_readers.hpp"
#include "panvo/runtime/service.hpp"
#include "participant.hpp"

namespace panvo::runtime::dds {

/// Client of a service of another process, compatible with rmw_fastrtps and rmw_cyclonedds; see ServiceServer.
class ServiceClient final : public BridgeClient, private fdds::DataReaderListener {
 public:
  /// Throws ConfigError if Fast DDS refuses its topics.
  ServiceClient(const ServiceDescription& service, std::shared_ptr<Participant> readers,
                std::shared_ptr<Participant> writers);
  ~ServiceClient() override;

  bool wait_for_service(std::chrono::milliseconds limit) override;
  std::optional<interfaces::Bytes> call(const interfaces::Bytes& request, std::chrono::milliseconds limit) override;

 private:
  /// Whether the service is of Cyclone DDS.
  bool is_of_cyclone() const;
  /// Sends a request. Returns the key of its reply in replies_; nullopt on failure.
  std::optional<std::int64_t> send(const interfaces::Bytes& request);
  std::optional<std::int64_t> key_of(const fdds::DataReader& reader, const fdds::SampleInfo& info,
                                     interfaces::Bytes& reply);
  void on_data_available(fdds::DataReader* reader) override;
  void on_subscription_matched(fdds::DataReader* reader, const fdds::SubscriptionMatchedStatus& status) override;

  const std::shared_ptr<Participant> readers_, writers_;
  const std::shared_ptr<fdds::Topic> request_topic_, reply_topic_;

  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  int matched_servers_ = 0;
  rtps::GUID_t own_writer_;
  std::map<std::int64_t, interfaces::Bytes> replies_;  // by number of the request; the newest only
  std::atomic<std::int64_t> last_of_cyclone_ = 0;      // number of the last request with a header

  MatchedReaders servers_;
  fdds::DataReader* reader_ = nullptr;
  fdds::DataWriter* writer_ = nullptr;
};

}  // namespace panvo::runtime::dds
