// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "writer.hpp"

namespace panvo::runtime::dds {

/// A topic whose messages are shared with readers of this machine, and sent to all others. One that is too large to be shared is sent to all: by
/// a second writer, which is there from the first such message on, and of which users are told.
class SharingWriter final : public BridgeWriter {
 public:
  /// `shared` is the writer that shares, of the same topic.
  SharingWriter(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
                std::shared_ptr<Notifier> notifier, std::unique_ptr<Writer> shared);

  bool write(const SamplePtr& sample) override;
  std::size_t matched_readers() const override { return shared_->matched_readers(); }
  bool wait_for_acknowledgments(std::chrono::milliseconds limit) override;

 private:
  Writer& writer_of_large(const Sample& sample);

  const TopicDescription topic_;
  const WireTopic wire_;
  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Notifier> notifier_;
  const std::uint32_t max_size_;
  const std::unique_ptr<Writer> shared_;
  std::mutex mutex_;              // guards the making of sent_
  std::unique_ptr<Writer> sent_;  // nullptr: nothing has been too large
};

/// The writer of a topic: one that shares, where the participant does so for messages of that type and there is memory for it.
std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier);

}  // namespace panvo::runtime::dds
