// SPDX-License-Identifier: Apache-2.0
#include "sharing_writer.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "endpoint_qos.hpp"
#include "image_sharing.hpp"

namespace panvo::runtime::dds {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

/// A writer discovers its readers about one round trip before they discover it, and they miss what it writes in
/// between. The previous writer serves them meanwhile.
constexpr milliseconds kIntroduction{250};

/// Waits until all readers of `old` also match `wanted`, at most for the limit of a write.
void wait_for_readers(const Writer& wanted, const Writer& old) {
  const auto give_up = steady_clock::now() + kWriteAttempts * kMaxBlockingTime;
  while (wanted.matched_readers() < old.matched_readers() && steady_clock::now() < give_up)
    std::this_thread::sleep_for(milliseconds(1));
}

}  // namespace

SharingWriter::SharingWriter(const TopicDescription& topic, const WireTopic& wire,
                             std::shared_ptr<Participant> participant, std::shared_ptr<Notifier> notifier)
    : topic_(topic),
      wire_(wire),
      participant_(std::move(participant)),
      notifier_(std::move(notifier)),
      largest_(participant_->max_shared(wire.type_name)),
      writer_(std::make_shared<Writer>(topic_, wire_, participant_, notifier_)) {}

bool SharingWriter::write(const SamplePtr& sample) {
  const auto writer = current();
  if (writer->matched_readers() == 0) return writer->write(sample);
  return writer_for(sample->serialized_size())->write(sample);
}

std::size_t SharingWriter::matched_readers() const { return current()->matched_readers(); }

bool SharingWriter::wait_for_acknowledgments(milliseconds limit) { return current()->wait_for_acknowledgments(limit); }

std::shared_ptr<Writer> SharingWriter::current() const {
  const std::lock_guard lock(mutex_);
  return writer_;
}

std::shared_ptr<Writer> SharingWriter::writer_for(std::size_t size) {
  const std::lock_guard lock(mutex_);
  if (next_ && is_known_to_readers(*next_)) put_in_place(std::exchange(next_, nullptr));
  if (!writer_->takes(size)) {
    auto larger = make_shared_writer(size);
    if (!larger) larger = std::make_shared<Writer>(topic_, wire_, participant_, notifier_);
    wait_for_readers(*larger, *writer_);
    put_in_place(std::move(larger));
  } else if (!writer_->shares() && !next_ && participant_->has_sharing_reader(wire_.name)) {
    next_ = make_shared_writer(size);
    next_matched_ = {};
  }
  return writer_;
}

bool SharingWriter::is_known_to_readers(const Writer& writer) {
  if (writer.matched_readers() < writer_->matched_readers()) return false;
  const auto now = steady_clock::now();
  if (next_matched_ == steady_clock::time_point()) next_matched_ = now;
  return now - next_matched_ >= kIntroduction;
}

std::shared_ptr<Writer> SharingWriter::make_shared_writer(std::size_t size) {
  if (has_given_up_) return nullptr;
  if (size > largest_) {
    give_up(fmt::format(
        "an image of {:.1f} MB exceeds shared_images_mb. Remedy: increase it in the node_container of the system "
        "file",
        static_cast<double>(size) * 1e-6));
    return nullptr;
  }
  const auto max_size = static_cast<std::uint32_t>(size);
  const auto room = room_for_writer(topic_.qos.depth, max_size);
  std::shared_ptr<Writer> writer;
  if (has_room_to_share(room)) writer = std::make_shared<Writer>(topic_, wire_, participant_, notifier_, max_size);
  if (writer && writer->has_memory()) return writer;
  give_up(
      fmt::format("/dev/shm has no {:.1f} MB left to share them. Remedy: enlarge /dev/shm (Docker: --shm-size=256m), "
                  "or set shared_images_mb: 0 in the node_container of the system file",
                  static_cast<double>(room) * 1e-6));
  return nullptr;
}

void SharingWriter::give_up(const std::string& reason) {
  has_given_up_ = true;
  notifier_->warn(
      fmt::format("topic {}: images are sent to other processes on this machine by UDP: {}.", topic_.name, reason));
}

void SharingWriter::put_in_place(std::shared_ptr<Writer> writer) {
  writer_->wait_for_acknowledgments(kWriteAttempts * kMaxBlockingTime);  // reliable readers only
  writer_ = std::move(writer);
}

std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier) {
  const bool keeps_for_late_joiners = topic.qos.durability == interfaces::Durability::kTransientLocal;
  if (participant->max_shared(wire.type_name) > 0 && !keeps_for_late_joiners)
    return std::make_unique<SharingWriter>(topic, wire, participant, notifier);
  return std::make_unique<Writer>(topic, wire, participant, notifier);
}

}  // namespace panvo::runtime::dds
