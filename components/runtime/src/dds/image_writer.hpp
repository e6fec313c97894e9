// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

#include "writer.hpp"

namespace panvo::runtime::dds {

/// Writer of an image topic: shares images with readers on this machine where possible, and sends them to all others. It
/// starts as a sending writer and is replaced
/// - when a reader shares memory with us: by a writer with memory for messages of the current size, and again when larger
///   messages come. Without memory, or above the user's size limit, it keeps sending and warns.
/// - when another program reads the topic: by a paced writer, as other programs have the system's small socket buffers.
/// Thread-safe.
class ImageWriter final : public BridgeWriter {
 public:
  ImageWriter(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
              std::shared_ptr<Notifier> notifier);

  bool write(const SamplePtr& sample) override;
  std::size_t matched_readers() const override;
  bool wait_for_acknowledgments(std::chrono::milliseconds limit) override;

 private:
  std::shared_ptr<Writer> current() const;
  std::shared_ptr<Writer> writer_for(std::size_t size);
  std::shared_ptr<Writer> make_writer(std::size_t shared_size) const;
  /// Returns nullptr if memory is lacking or sharing has been given up.
  std::shared_ptr<Writer> make_shared_writer(std::size_t size);
  bool is_to_share() const;
  bool is_to_pace() const;
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

/// Opens the writer of a topic.
std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier);

}  // namespace panvo::runtime::dds
