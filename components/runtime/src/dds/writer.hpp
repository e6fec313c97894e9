// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant.hpp"
#include "shared_segment.hpp"

namespace panvo::runtime::dds {

/// Publishes a topic of this process to other processes.
class Writer final : public BridgeWriter, private eprosima::fastdds::dds::DataWriterListener {
 public:
  /// Throws ConfigError if Fast DDS refuses the topic. `wire` holds its wire names. `max_shared`: messages up to
  /// this size are shared with readers on this machine, larger ones cannot be written; 0: all messages are sent.
  Writer(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
         std::shared_ptr<Notifier> notifier, std::uint32_t max_shared = 0);
  ~Writer() override;

  bool write(const SamplePtr& sample) override;
  std::size_t matched_readers() const override { return matched_readers_; }
  bool wait_for_acknowledgments(std::chrono::milliseconds limit) override;
  bool takes(std::size_t size) const { return max_shared_ == 0 || size <= max_shared_; }
  bool shares() const { return max_shared_ > 0; }
  /// Whether all shared memory is reserved. If not, it must not be written to.
  bool has_memory() const { return segment_ && segment_->is_there(); }
  /// Messages kept for late joiners or not yet acknowledged are not sent any more.
  void forget_messages();

 private:
  void on_publication_matched(eprosima::fastdds::dds::DataWriter* writer,
                              const eprosima::fastdds::dds::PublicationMatchedStatus& status) override;
  void on_offered_incompatible_qos(eprosima::fastdds::dds::DataWriter* writer,
                                   const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& status) override;

  const std::string name_;
  const bool keeps_for_late_joiners_;
  const std::uint32_t max_shared_;
  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<eprosima::fastdds::dds::Topic> topic_;
  std::atomic<std::size_t> matched_readers_ = 0;
  std::optional<SharedSegment> segment_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;  // uses the members above
};

}  // namespace panvo::runtime::dds
