// SPDX-License-Identifier: Apache-2.0
#include "writer.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>

#include "endpoint_qos.hpp"
#include "fast_dds.hpp"
#include "image_sharing.hpp"
#include "own_participants.hpp"
#include "panvo/runtime/errors.hpp"
#include "participant_qos.hpp"
#include "remote_only_filter.hpp"
#include "sample_data_type.hpp"
#include "shared_memory.hpp"

namespace panvo::runtime::dds {

Writer::Writer(const TopicDescription& topic, const WireTopic& wire, std::shared_ptr<Participant> participant,
               std::shared_ptr<Notifier> notifier, ImageTransport transport)
    : name_(topic.name),
      keeps_for_late_joiners_(topic.qos.durability == interfaces::Durability::kTransientLocal),
      transport_(transport),
      participant_(std::move(participant)),
      notifier_(std::move(notifier)),
      topic_(participant_->topic(wire)) {
  fdds::DataWriterQos qos = participant_->publisher().get_default_datawriter_qos();
  apply(topic, qos);
  if (is_paced()) qos.publish_mode().flow_controller_name = kPace;
  if (shares()) share(qos);
  writer_ = participant_->make_writer(*topic_, qos, *this, transport_.max_shared);
  if (!writer_) throw ConfigError(fmt::format("topic {}: Fast DDS created no writer, see its message above", name_));
  has_memory_ = shares() && reserve_memory_of(writer_->guid());
  participant_->endpoints().add(wire.name, writer_->guid(), true);
}

Writer::~Writer() {
  participant_->endpoints().remove(writer_->guid());
  participant_->publisher().delete_datawriter(writer_);
}

bool Writer::write(const SamplePtr& sample) {
  if (matched_readers_ == 0 && !keeps_for_late_joiners_) return true;
  // Fast DDS never frees a shared message that is acknowledged while another reader joins. When the shared history is
  // full, version 3 aborts if it was built with assertions, as in Debian 13.
  if (kIsFastDds3 && shares() && has_new_reader_.exchange(false)) forget_messages();
  Outgoing outgoing(*sample);
  for (int attempt = 0; attempt < kWriteAttempts; ++attempt) {
    const auto begin = std::chrono::steady_clock::now();
    auto params = written_by(writer_->guid());
    if (dds::write(*writer_, &outgoing, params)) return true;
    // Shared memory is freed in order only: without this, writing would fail from then on with Fast DDS 2. Without memory
    // it fails at once, otherwise after the blocking time.
    if (shares() && std::chrono::steady_clock::now() - begin < kMaxBlockingTime) forget_messages();
  }
  return false;
}

void Writer::forget_messages() {
  std::size_t forgotten = 0;
  writer_->clear_history(&forgotten);
}

bool Writer::wait_for_acknowledgments(std::chrono::milliseconds limit) {
  return writer_->wait_for_acknowledgments(to_dds(limit)) == kOk;
}

void Writer::on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& status) {
  if (is_of_this_process(rtps::iHandle2GUID(status.last_subscription_handle))) return;
  matched_readers_ += static_cast<std::size_t>(status.current_count_change);  // unsigned wrap-around intended
  if (status.current_count_change > 0) has_new_reader_ = true;
}

void Writer::on_offered_incompatible_qos(fdds::DataWriter*, const fdds::OfferedIncompatibleQosStatus& status) {
  notifier_->warn(describe_offer_refused(name_, status.last_policy_id));
}

}  // namespace panvo::runtime::dds
