// SPDX-License-Identifier: Apache-2.0
#include "service_client.hpp"

#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <algorithm>
#include <string_view>
#include <thread>

#include "cyclone_header.hpp"
#include "endpoint_qos.hpp"
#include "fast_dds.hpp"
#include "fnv1a.hpp"
#include "own_participants.hpp"
#include "panvo/runtime/errors.hpp"
#include "sample_data_type.hpp"
#include "service_server.hpp"

namespace panvo::runtime::dds {

using std::chrono::steady_clock;

namespace {

constexpr std::size_t kMaxReplies = 64;

// Cyclone DDS drops what a writer sends before it has discovered the writer, which takes milliseconds.
constexpr std::chrono::milliseconds kIntroduction{250};

// Keys of replies with a header, apart from those by sequence number.
constexpr std::int64_t kOfCyclone = std::int64_t{1} << 62;

/// Identifies a client by the hash of its writer's GUID.
std::uint64_t client_number(const rtps::GUID_t& writer) {
  const auto bytes = [](const auto& value) {
    return std::string_view(reinterpret_cast<const char*>(value), sizeof(value));
  };
  return fnv1a(bytes(writer.entityId.value), fnv1a(bytes(writer.guidPrefix.value)));
}

std::int64_t number(const rtps::SampleIdentity& identity) {
  return static_cast<std::int64_t>(identity.sequence_number().to64long());
}

}  // namespace

ServiceClient::ServiceClient(const ServiceDescription& service, std::shared_ptr<Participant> readers,
                             std::shared_ptr<Participant> writers)
    : readers_(std::move(readers)),
      writers_(std::move(writers)),
      request_topic_(writers_->topic(request_topic(service))),
      reply_topic_(readers_->topic(reply_topic(service))) {
  fdds::DataReaderQos reader_qos = readers_->subscriber().get_default_datareader_qos();
  apply(service, reader_qos);
  fdds::DataWriterQos writer_qos = writers_->publisher().get_default_datawriter_qos();
  apply(service, writer_qos);
  // The reader first, so a server discovers it before it gets a request.
  // Unfiltered: a filter sees the identity of the request in a reply, which is ours.
  reader_ = readers_->subscriber().create_datareader(reply_topic_.get(), reader_qos, this);
  if (reader_) writer_ = writers_->make_writer(*request_topic_, writer_qos, servers_);
  if (!writer_) {
    if (reader_) readers_->subscriber().delete_datareader(reader_);
    throw ConfigError(fmt::format("service {}: Fast DDS created no client, see its message above", service.name));
  }
  const std::lock_guard lock(mutex_);
  own_writer_ = writer_->guid();
}

ServiceClient::~ServiceClient() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  writers_->publisher().delete_datawriter(writer_);
  readers_->subscriber().delete_datareader(reader_);
}

bool ServiceClient::wait_for_service(std::chrono::milliseconds limit) {
  const auto end = steady_clock::now() + limit;
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_until(lock, end, [this] { return matched_servers_ > 0; })) return false;
  }
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_clock::now());
  if (!servers_.wait_for_any(std::max(left, std::chrono::milliseconds(0)))) return false;
  if (is_of_cyclone()) std::this_thread::sleep_until(std::min(end, made_ + kIntroduction));
  return true;
}

bool ServiceClient::is_of_cyclone() const {
  return servers_.contains_any([this](const auto& reader) { return readers_->is_of_cyclone(reader); });
}

std::optional<std::int64_t> ServiceClient::send(const interfaces::Bytes& request) {
  rtps::WriteParams params;
  params.related_sample_identity().writer_guid(reader_->guid());
  if (!is_of_cyclone()) {
    Outgoing outgoing(request);
    return write(*writer_, &outgoing, params) ? std::optional(number(params.sample_identity())) : std::nullopt;
  }
  const CycloneHeader header{client_number(writer_->guid()), ++last_of_cyclone_};
  const auto bytes = with_header(header, request);
  Outgoing outgoing(bytes);
  return write(*writer_, &outgoing, params) ? std::optional(kOfCyclone + header.number) : std::nullopt;
}

std::optional<interfaces::Bytes> ServiceClient::call(const interfaces::Bytes& request,
                                                     std::chrono::milliseconds limit) {
  const auto end = steady_clock::now() + limit;
  const auto mine = send(request);
  if (!mine) return std::nullopt;
  std::unique_lock lock(mutex_);
  if (!changed_.wait_until(lock, end, [&] { return replies_.contains(*mine); })) return std::nullopt;
  return std::move(replies_.extract(*mine).mapped());
}

/// All clients of a service get all replies: nullopt for one to another client.
std::optional<std::int64_t> ServiceClient::key_of(const fdds::DataReader& reader, const fdds::SampleInfo& info,
                                                  interfaces::Bytes& reply) {
  if (readers_->is_of_cyclone(info.sample_identity.writer_guid())) {
    const auto header = take_header(reply);
    if (!header || header->client != client_number(own_writer_)) return std::nullopt;
    return kOfCyclone + header->number;
  }
  // Other implementations address the reply to the writer.
  const auto& asked_by = info.related_sample_identity.writer_guid();
  if (asked_by != reader.guid() && asked_by != own_writer_) return std::nullopt;
  return number(info.related_sample_identity);
}

void ServiceClient::on_data_available(fdds::DataReader* reader) {
  const std::lock_guard lock(mutex_);
  fdds::SampleInfo info;
  for (Incoming incoming; !closed_ && reader->take_next_sample(&incoming, &info) == kOk; incoming = {}) {
    if (!info.valid_data || !incoming.readable) continue;
    const auto key = key_of(*reader, info, incoming.bytes);
    if (!key) continue;
    replies_.insert_or_assign(*key, std::move(incoming.bytes));
    if (replies_.size() > kMaxReplies) replies_.erase(replies_.begin());  // its caller has given up
  }
  changed_.notify_all();
}

void ServiceClient::on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& status) {
  if (is_of_this_process(rtps::iHandle2GUID(status.last_publication_handle))) return;
  const std::lock_guard lock(mutex_);
  matched_servers_ += status.current_count_change;
  changed_.notify_all();
}

}  // namespace panvo::runtime::dds
