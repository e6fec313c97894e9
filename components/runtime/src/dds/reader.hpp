// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "fast_dds.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant.hpp"
#include "rate_limit.hpp"
#include "sample_data_type.hpp"

namespace panvo::runtime::dds {

/// Receives a topic from other processes. Samples are delivered on Fast DDS's receiving thread, one at a time. The
/// callback should be fast and must not destroy this reader.
class Reader final : public BridgeReader, private fdds::DataReaderListener {
 public:
  using OnSample = std::function<void(SamplePtr)>;

  enum class Rate : std::uint8_t {
    kLimited,  ///< by Limits::max_topic_rate_hz
    kAny       ///< for topics on which a lost message would never be made up for
  };

  /// Throws ConfigError if Fast DDS refuses the topic. `wire` holds its wire names.
  Reader(const TopicDescription& topic, const WireTopic& wire, OnSample on_sample,
         std::shared_ptr<Participant> participant, std::shared_ptr<Notifier> notifier, Rate rate = Rate::kLimited);
  ~Reader() override;

  std::size_t matched_writers() const override { return matched_writers_; }
  BridgeReaderCounters counters() const override;

 private:
  void on_data_available(fdds::DataReader* reader) override;
  void on_subscription_matched(fdds::DataReader* reader, const fdds::SubscriptionMatchedStatus& status) override;
  void on_requested_incompatible_qos(fdds::DataReader* reader,
                                     const fdds::RequestedIncompatibleQosStatus& status) override;
  void on_sample_lost(fdds::DataReader* reader, const fdds::SampleLostStatus& status) override;
  void on_sample_rejected(fdds::DataReader* reader, const fdds::SampleRejectedStatus& status) override;
  void deliver(Incoming incoming, const fdds::SampleInfo& info);
  /// GID of the writer as text, shared by consecutive messages of the same writer.
  Sample::Sender sender(const rtps::GUID_t& writer);

  const TopicDescription description_;
  const OnSample on_sample_;
  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<fdds::Topic> topic_;

  std::mutex delivery_mutex_;  // held during delivery of a sample
  bool closed_ = false;
  std::optional<RateLimit> rate_limit_;
  rtps::GUID_t last_writer_;
  Sample::Sender last_sender_;

  std::atomic<std::size_t> matched_writers_ = 0;
  std::atomic<std::uint64_t> received_ = 0, lost_ = 0, rejected_ = 0, undecodable_ = 0, overwritten_ = 0;
  std::atomic<std::uint64_t> too_large_ = 0, too_fast_ = 0;
  bool shares_ = false;                 // messages may be in memory that the writer reuses
  fdds::DataReader* reader_ = nullptr;  // uses the members above
};

}  // namespace panvo::runtime::dds
