// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

#include "writer.hpp"

namespace panvo::runtime::dds {

/// Writer of a topic that shares messages with readers on this machine where possible and sends them to all others. It
/// starts as a sending writer. When a reader shares memory with us, it is replaced by a writer with memory for messages
/// of the current size, and again when larger messages come. Without memory, or above the user's size limit, it keeps
/// sending and warns. Thread-safe.
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
  const std::uint32_t largest_;  // largest shared size
  mutable std::mutex mutex_;     // guards the members below
  std::shared_ptr<Writer> writer_, next_;
  std::chrono::steady_clock::time_point next_matched_;  // when next_ had matched all readers; epoch: not yet
  bool has_given_up_ = false;
};

/// Opens the writer of a topic: a sharing one if the participant shares messages of that type.
std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier);

}  // namespace panvo::runtime::dds
