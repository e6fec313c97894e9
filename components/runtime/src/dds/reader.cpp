// SPDX-License-Identifier: Apache-2.0
#include "reader.hpp"

#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <exception>

#include "../clocks.hpp"
#include "endpoint_qos.hpp"
#include "fast_dds.hpp"
#include "image_sharing.hpp"
#include "node_info.hpp"
#include "own_participants.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime::dds {

namespace {

// A sharing reader needs a size bound; its value does not limit what it reads.
constexpr std::uint32_t kMinShared = 1024;

}  // namespace

Reader::Reader(const TopicDescription& topic, const WireTopic& wire, OnSample on_sample,
               std::shared_ptr<Participant> participant, std::shared_ptr<Notifier> notifier, Rate rate)
    : description_(topic),
      on_sample_(std::move(on_sample)),
      participant_(std::move(participant)),
      notifier_(std::move(notifier)),
      topic_(participant_->topic(wire)) {
  if (rate == Rate::kLimited) {
    // Latched messages arrive all at once.
    rate_limit_.emplace(participant_->limits().max_topic_rate_hz, static_cast<double>(topic.qos.depth));
  }
  fdds::DataReaderQos qos = participant_->subscriber().get_default_datareader_qos();
  apply(topic, qos);
  const bool is_to_share = topic.type && participant_->max_shared(wire.type_name) > 0;
  std::optional<SharingTurn> turn;
  if (is_to_share) turn.emplace();
  shares_ = turn && turn->has_room(kRoomForReader);
  if (is_to_share && !shares_) {
    notifier_->warn(fmt::format(
        "topic {}: images from other processes on this machine are received by UDP: there is no room in /dev/shm to "
        "share them. Remedy: enlarge /dev/shm (Docker: --shm-size=256m), or set shared_images_mb: 0 in the "
        "node_container of the system file.",
        topic.name));
  }
  if (shares_) share(qos);
  reader_ = participant_->make_reader(*topic_, qos, *this, shares_ ? kMinShared : 0);
  if (!reader_)
    throw ConfigError(fmt::format("topic {}: Fast DDS created no reader, see its message above", topic.name));
  if (shares_) reserve_memory_of(reader_->guid());
  participant_->endpoints().add(wire.name, reader_->guid(), false);
}

Reader::~Reader() {
  {
    const std::lock_guard lock(delivery_mutex_);  // waits for a running callback
    closed_ = true;
  }
  participant_->endpoints().remove(reader_->guid());
  participant_->subscriber().delete_datareader(reader_);
}

BridgeReaderCounters Reader::counters() const {
  return {received_, lost_ + rejected_, undecodable_, overwritten_, too_large_, too_fast_};
}

void Reader::on_data_available(fdds::DataReader* reader) {
  const std::lock_guard lock(delivery_mutex_);
  while (!closed_) {
    fdds::SampleInfo info;
    Incoming incoming{.wanted = shares_ ? description_.type : nullptr};
    const bool is_taken = reader->take_next_sample(&incoming, &info) == kOk;
    // Fast DDS drops a sample overwritten while being read and continues with the next.
    overwritten_ += incoming.reads - (is_taken && info.valid_data ? 1 : 0);
    if (!is_taken) return;
    // The filter is for messages of the same participant; a process may have several.
    if (info.valid_data && !is_of_this_process(info.sample_identity.writer_guid())) deliver(std::move(incoming), info);
  }
}

void Reader::deliver(Incoming incoming, const fdds::SampleInfo& info) {
  if (incoming.too_large) {
    ++too_large_;
    return notifier_->warn(fmt::format("topic {}: messages larger than {:.6g} MB are dropped: see max_message_mb",
                                       description_.name,
                                       1e-6 * static_cast<double>(participant_->limits().max_message_bytes)));
  }
  if (rate_limit_ && !rate_limit_->take(clocks::monotonic_ns())) {
    ++too_fast_;
    return notifier_->warn(
        fmt::format("topic {}: more than {:.6g} messages per second, some are dropped: see max_topic_rate_hz",
                    description_.name, participant_->limits().max_topic_rate_hz));
  }
  if (!incoming.readable) {
    ++undecodable_;
    return;
  }
  ++received_;
  const std::int64_t time_ns = info.reception_timestamp.to_ns();
  auto from = sender(info.sample_identity.writer_guid());
  try {
    on_sample_(incoming.message
                   ? Sample::of(*description_.type, std::move(incoming.message), time_ns, nullptr, std::move(from))
                   : Sample::from_bytes(description_.type, description_.type_name, std::move(incoming.bytes), time_ns,
                                        std::move(from)));
  } catch (const std::exception& error) {
    // An exception in Fast DDS would end the process.
    notifier_->warn(
        fmt::format("topic {}: a received message could not be delivered: {}", description_.name, error.what()));
  }
}

Sample::Sender Reader::sender(const rtps::GUID_t& writer) {
  if (!last_sender_ || last_writer_ != writer) {
    last_writer_ = writer;
    last_sender_ = std::make_shared<const std::string>(hexadecimal(writer));
  }
  return last_sender_;
}

void Reader::on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& status) {
  if (is_of_this_process(rtps::iHandle2GUID(status.last_publication_handle))) return;
  matched_writers_ += static_cast<std::size_t>(status.current_count_change);  // unsigned wrap-around intended
}

void Reader::on_requested_incompatible_qos(fdds::DataReader*, const fdds::RequestedIncompatibleQosStatus& status) {
  notifier_->warn(describe_request_refused(description_.name, status.last_policy_id));
}

void Reader::on_sample_lost(fdds::DataReader*, const fdds::SampleLostStatus& status) {
  lost_ = static_cast<std::uint64_t>(status.total_count);
}

void Reader::on_sample_rejected(fdds::DataReader*, const fdds::SampleRejectedStatus& status) {
  // A reliable writer resends a rejected sample.
  if (description_.qos.requested == interfaces::Reliability::kBestEffort) rejected_ = status.total_count;
}

}  // namespace panvo::runtime::dds
