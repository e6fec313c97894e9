// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>

#include <atomic>
#include <cstdint>
#include <memory>

#include "fast_dds.hpp"
#include "notifier.hpp"
#include "panvo/runtime/bridge.hpp"
#include "participant.hpp"

namespace panvo::runtime::dds {

/// How a writer of images sends them.
struct ImageTransport {
  std::uint32_t max_shared = 0;  ///< messages up to this size are shared with readers on this machine, larger ones
                                 ///< cannot be written; 0: all messages are sent
  bool is_paced = false;         ///< for readers with small socket buffers
};

/// Publishes a topic of this process to other processes.
class Writer final : public BridgeWriter, private fdds::DataWriterListener {
 public:
  /// Throws ConfigError if Fast DDS refuses the topic. `wire` holds its wire names.
  Writer(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
         std::shared_ptr<Notifier> notifier, ImageTransport transport = {});
  ~Writer() override;

  bool write(const SamplePtr& sample) override;
  std::size_t matched_readers() const override { return matched_readers_; }
  bool wait_for_acknowledgments(std::chrono::milliseconds limit) override;
  bool takes(std::size_t size) const { return !shares() || size <= transport_.max_shared; }
  bool shares() const { return transport_.max_shared > 0; }
  bool is_paced() const { return transport_.is_paced; }
  /// Whether all shared memory is reserved. If not, it must not be written to.
  bool has_memory() const { return has_memory_; }
  /// Messages kept for late joiners or not yet acknowledged are not sent any more.
  void forget_messages();

 private:
  void on_publication_matched(fdds::DataWriter* writer, const fdds::PublicationMatchedStatus& status) override;
  void on_offered_incompatible_qos(fdds::DataWriter* writer, const fdds::OfferedIncompatibleQosStatus& status) override;

  const std::string name_;
  const bool keeps_for_late_joiners_;
  const ImageTransport transport_;
  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Notifier> notifier_;
  const std::shared_ptr<fdds::Topic> topic_;
  std::atomic<std::size_t> matched_readers_ = 0;
  std::atomic<bool> has_new_reader_ = false;
  bool has_memory_ = false;
  fdds::DataWriter* writer_ = nullptr;  // uses the members above
};

}  // namespace panvo::runtime::dds
