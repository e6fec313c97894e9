// SPDX-License-Identifier: Apache-2.0
#include "sharing_writer.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <thread>
#include <utility>

#include "endpoint_qos.hpp"

namespace panvo::runtime::dds {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

/// Until all who read from `shared` read from `sent`, too, but no longer than a write may take.
void wait_for_readers(const Writer& sent, const Writer& shared) {
  const auto give_up = steady_clock::now() + kWriteAttempts * kMaxBlockingTime;
  while (sent.matched_readers() < shared.matched_readers() && steady_clock::now() < give_up)
    std::this_thread::sleep_for(milliseconds(1));
}

}  // namespace

SharingWriter::SharingWriter(const TopicDescription& topic, const WireTopic& wire,
                             std::shared_ptr<Participant> participant, std::shared_ptr<Notifier> notifier,
                             std::unique_ptr<Writer> shared)
    : topic_(topic),
      wire_(wire),
      participant_(std::move(participant)),
      notifier_(std::move(notifier)),
      max_size_(participant_->shared_size(wire.type_name)),
      shared_(std::move(shared)) {}

bool SharingWriter::write(const SamplePtr& sample) {
  if (sample->serialized_size() <= max_size_) return shared_->write(sample);
  return shared_->matched_readers() == 0 || writer_of_large(*sample).write(sample);
}

Writer& SharingWriter::writer_of_large(const Sample& sample) {
  const std::lock_guard lock(mutex_);
  if (sent_) return *sent_;
  notifier_->warn(fmt::format(
      "topic {}: an image of {:.1f} MB is too large to be shared with other processes of this machine, and is "
      "sent to them. Remedy: a larger shared_images_mb in the node_container of the system file.",
      topic_.name, static_cast<double>(sample.serialized_size()) * 1e-6));
  sent_ = std::make_unique<Writer>(topic_, wire_, participant_, notifier_);
  wait_for_readers(*sent_, *shared_);
  return *sent_;
}

bool SharingWriter::wait_for_acknowledgments(milliseconds limit) {
  const auto give_up = steady_clock::now() + limit;
  const bool has_all_shared = shared_->wait_for_acknowledgments(limit);
  const std::lock_guard lock(mutex_);
  if (!sent_) return has_all_shared;
  const auto left = std::chrono::duration_cast<milliseconds>(give_up - steady_clock::now());
  return sent_->wait_for_acknowledgments(left) && has_all_shared;
}

std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier) {
  const bool keeps_for_late_joiners = topic.qos.durability == interfaces::Durability::kTransientLocal;
  if (participant->shared_size(wire.type_name) > 0 && !keeps_for_late_joiners) {
    auto shared = std::make_unique<Writer>(topic, wire, participant, notifier, Way::kShared);
    if (shared->shares()) return std::make_unique<SharingWriter>(topic, wire, participant, notifier, std::move(shared));
    notifier->warn(
        fmt::format("topic {}: its images are sent to other processes of this machine, not shared with them: there is "
                    "no memory for it. "
                    "Remedy: a larger /dev/shm (for Docker: --shm-size=512m), a smaller shared_images_mb, or none "
                    "where messages are "
                    "encrypted.",
                    topic.name));
  }
  return std::make_unique<Writer>(topic, wire, participant, notifier);
}

}  // namespace panvo::runtime::dds
