// SPDX-License-Identifier: Apache-2.0
#include "image_writer.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "endpoint_qos.hpp"
#include "image_sharing.hpp"
#include "participant_qos.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime::dds {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

/// A writer discovers its readers about one round trip before they discover it, and they miss what it writes in
/// between. The previous writer serves them meanwhile.
constexpr milliseconds kReaderIntroduction{250};

/// Waits until all readers of `old` also match `wanted`, at most for the limit of a write.
void wait_for_readers(const Writer& wanted, const Writer& old) {
  const auto give_up = steady_clock::now() + kWriteAttempts * kMaxBlockingTime;
  while (wanted.matched_readers() < old.matched_readers() && steady_clock::now() < give_up)
    std::this_thread::sleep_for(milliseconds(1));
}

/// Fast DDS paces only what is sent asynchronously; lost parts of other images are sent again.
bool can_pace(const TopicDescription& topic) {
  return kHasFlowControl && topic.qos.requested == interfaces::Reliability::kBestEffort;
}

}  // namespace

ImageWriter::ImageWriter(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
                         std::shared_ptr<Notifier> notifier)
    : topic_(topic),
      wire_(wire),
      participant_(std::move(participant)),
      notifier_(std::move(notifier)),
      largest_(participant_->max_shared(wire.type_name)),
      writer_(std::make_shared<Writer>(topic_, wire_, participant_, notifier_,
                                       ImageTransport{.is_paced = can_pace(topic_) && has_small_socket_buffers()})) {}

bool ImageWriter::write(const SamplePtr& sample) {
  const auto writer = current();
  if (writer->matched_readers() == 0) return writer->write(sample);
  return writer_for(sample->serialized_size())->write(sample);
}

std::size_t ImageWriter::matched_readers() const { return current()->matched_readers(); }

bool ImageWriter::wait_for_acknowledgments(milliseconds limit) { return current()->wait_for_acknowledgments(limit); }

std::shared_ptr<Writer> ImageWriter::current() const {
  const std::lock_guard lock(mutex_);
  return writer_;
}

std::shared_ptr<Writer> ImageWriter::writer_for(std::size_t size) {
  const std::lock_guard lock(mutex_);
  if (next_ && is_known_to_readers(*next_)) put_in_place(std::exchange(next_, nullptr));
  if (!writer_->takes(size)) {
    auto larger = make_shared_writer(size);
    if (!larger) larger = make_writer(0);
    wait_for_readers(*larger, *writer_);
    put_in_place(std::move(larger));
  } else if (!next_ && (is_to_share() != writer_->shares() || is_to_pace() != writer_->is_paced())) {
    if (is_to_share()) next_ = make_shared_writer(size);
    if (!next_ && is_to_pace() != writer_->is_paced()) next_ = make_writer(0);
    next_matched_ = {};
  }
  return writer_;
}

// A writer that shares or is paced remains so.
bool ImageWriter::is_to_share() const {
  return writer_->shares() || (largest_ > 0 && participant_->has_sharing_reader(wire_.name));
}

bool ImageWriter::is_to_pace() const {
  return writer_->is_paced() || (can_pace(topic_) && participant_->has_foreign_reader(wire_.name));
}

std::shared_ptr<Writer> ImageWriter::make_writer(std::size_t shared_size) const {
  const ImageTransport transport{static_cast<std::uint32_t>(shared_size), is_to_pace()};
  return std::make_shared<Writer>(topic_, wire_, participant_, notifier_, transport);
}

bool ImageWriter::is_known_to_readers(const Writer& writer) {
  if (writer.matched_readers() < writer_->matched_readers()) return false;
  const auto now = steady_clock::now();
  if (next_matched_ == steady_clock::time_point()) next_matched_ = now;
  return now - next_matched_ >= kReaderIntroduction;
}

std::shared_ptr<Writer> ImageWriter::make_shared_writer(std::size_t size) {
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
  const SharingTurn turn;
  std::shared_ptr<Writer> writer;
  if (turn.has_room(room)) writer = make_writer(size);
  if (writer && writer->has_memory()) return writer;
  give_up(
      fmt::format("/dev/shm has no {:.1f} MB left to share them. Remedy: enlarge /dev/shm (Docker: --shm-size=256m), "
                  "or set shared_images_mb: 0 in the node_container of the system file",
                  static_cast<double>(room) * 1e-6));
  return nullptr;
}

void ImageWriter::give_up(const std::string& reason) {
  has_given_up_ = true;
  notifier_->warn(
      fmt::format("topic {}: images are sent to other processes on this machine by UDP: {}.", topic_.name, reason));
}

void ImageWriter::put_in_place(std::shared_ptr<Writer> writer) {
  writer_->wait_for_acknowledgments(kWriteAttempts * kMaxBlockingTime);  // reliable readers only
  writer_ = std::move(writer);
}

std::unique_ptr<BridgeWriter> open_writer(const TopicDescription& topic, const WireTopic& wire,
                                          const std::shared_ptr<Participant>& participant,
                                          const std::shared_ptr<Notifier>& notifier) {
  const bool keeps_for_late_joiners = topic.qos.durability == interfaces::Durability::kTransientLocal;
  const bool is_of_images = wire.type_name == interfaces::message_type<sensor_msgs::msg::Image>().dds_name;
  if (is_of_images && !keeps_for_late_joiners) return std::make_unique<ImageWriter>(topic, wire, participant, notifier);
  return std::make_unique<Writer>(topic, wire, participant, notifier);
}

}  // namespace panvo::runtime::dds
