// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

#include "writer.hpp"

namespace panvo::runtime::dds {

/// The writer of a topic whose messages are shared with readers of this machine where that can be, and sent to all others. It begins as one that sends.
/// Once somebody reads who shares memory with us, one takes its place that reserves memory for messages of the size that has come; and another
/// one when larger ones come. Where there is no memory for them, or they are larger than the user allows, it goes on sending, with a warning.
/// Safe to use from several threads.
class SharingWriter final : public BridgeWriter {
 public:
  SharingWriter(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
                std::shared_ptr<Notifier> notifier);

  bool write(const SamplePtr& sample) override;
  std::size_t matched_readers() const override;
  bool wait_for_acknowledgments(std::chrono::milliseconds limit) override;

 private:
  std::shared_ptr<Writer> current() const;
  std::shared_ptr<Writer> writer_for(std::size_t size);
  std::shared_ptr<Writer> make_shared_writer(std::size_t size);
  void give_up(const std::string& reason);
  void put_in_place(std::shared_ptr<Writer> writer);
  bool is_known_to_readers(const Writer& writer);

  const TopicDescription topic_;
  const WireTopic wire_;
  const std::shared_ptr<Participant> participant_;
  const std::shared_ptr<Notifier> notifier_;
  const std::uint32_t largest_;  // that is shared
  mutable std::mutex mutex_;     // guards what follows
  std::shared_ptr<Writer> writer_, next_;
  std::chrono::steady_clock::time_point next_matched_;  // since when next_ has all readers; its epoch: it has not
  bool has_given_up_ = false;
};

/// The writer of a topic: one that shares, where the participant does so for messages of that type.
std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier);

}  // namespace panvo::runtime::dds
