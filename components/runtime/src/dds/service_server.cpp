// SPDX-License-Identifier: Apache-2.0
#include "service_server.hpp"

#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "clocks.hpp"
#include "endpoint_qos.hpp"
#include "fast_dds.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime::dds {

namespace {

// Discovery of a client takes milliseconds, or seconds with packet loss: each packet is resent periodically.
constexpr std::chrono::seconds kClientLimit{10};
constexpr std::size_t kMaxKept = 32;
// Limit for a closing service to wait for acknowledgement of its last answer; normally milliseconds, unless the client
// is gone or stalled.
constexpr std::chrono::seconds kLastAnswerLimit{2};

bool is_reader(const rtps::GUID_t& guid) {
  constexpr std::uint8_t kReaderBit = 0x04;
  return (guid.entityId.value[3] & kReaderBit) != 0;
}

WireTopic service_topic(const ServiceDescription& service, std::string wire_name, const char* part) {
  auto type_name = wire_type_name(service.type_name + part);
  if (!type_name) {
    throw ConfigError(fmt::format("service {}: '{}' is not a type name; write it as package/srv/Type", service.name,
                                  service.type_name));
  }
  return {std::move(wire_name), std::move(*type_name), service.name};
}

}  // namespace

WireTopic request_topic(const ServiceDescription& service) {
  return service_topic(service, wire_request_name(service.name), "_Request");
}
WireTopic reply_topic(const ServiceDescription& service) {
  return service_topic(service, wire_reply_name(service.name), "_Response");
}

ServiceServer::ServiceServer(const ServiceDescription& service, ServiceHandler handler, ServiceGuard guard,
                             const RequestLimits& limits, std::shared_ptr<Participant> readers,
                             std::shared_ptr<Participant> writers, std::shared_ptr<ServiceQueue> queue,
                             std::shared_ptr<Notifier> notifier)
    : name_(service.name),
      handler_(std::move(handler)),
      guard_(std::move(guard)),
      limits_(limits),
      readers_(std::move(readers)),
      writers_(std::move(writers)),
      queue_(std::move(queue)),
      notifier_(std::move(notifier)),
      request_topic_(readers_->topic(request_topic(service))),
      reply_topic_(writers_->topic(reply_topic(service))),
      rate_(limits.per_s, 1.0) {
  fdds::DataWriterQos writer_qos = writers_->publisher().get_default_datawriter_qos();
  apply(service, writer_qos);
  fdds::DataReaderQos reader_qos = readers_->subscriber().get_default_datareader_qos();
  apply(service, reader_qos);
  writer_ = writers_->make_writer(*reply_topic_, writer_qos, clients_);
  if (writer_) reader_ = readers_->make_reader(*request_topic_, reader_qos, *this);
  if (!reader_) {
    if (writer_) writers_->publisher().delete_datawriter(writer_);
    throw ConfigError(fmt::format("service {}: Fast DDS did not create it, see its message above", name_));
  }
  writers_->endpoints().add(reply_topic_->get_name(), writer_->guid(), true);
  readers_->endpoints().add(request_topic_->get_name(), reader_->guid(), false);
  clients_.on_match([this] { queue_->post_at(this, ServiceQueue::Clock::now(), [this] { send_kept(); }); });
}

ServiceServer::~ServiceServer() {
  {
    const std::lock_guard lock(taking_mutex_);  // waits for requests being taken
    closed_ = true;
  }
  clients_.on_match(nullptr);
  queue_->forget(this);
  readers_->endpoints().remove(reader_->guid());
  writers_->endpoints().remove(writer_->guid());
  readers_->subscriber().delete_datareader(reader_);
  // A client drops an answer if it learns first that the writer is gone, which happens when a request ends the service
  // itself. Does not wait if nothing is unacknowledged.
  writer_->wait_for_acknowledgments(to_dds(kLastAnswerLimit));
  writers_->publisher().delete_datawriter(writer_);
}

ServiceCounters ServiceServer::counters() const {
  return {received_, answered_, malformed_, dropped_, refused_, unanswered_};
}

void ServiceServer::on_data_available(fdds::DataReader* reader) {
  const std::lock_guard lock(taking_mutex_);
  fdds::SampleInfo info;
  for (Incoming incoming; !closed_ && reader->take_next_sample(&incoming, &info) == kOk; incoming = {}) {
    if (!info.valid_data) continue;
    ++received_;
    if (is_over_limits(incoming)) continue;
    const auto asker = asker_of(info, incoming.bytes);
    if (!asker) {
      ++malformed_;
      notifier_->warn(fmt::format("service {}: ignored a request of Cyclone DDS without a header", name_));
      continue;
    }
    const bool posted =
        queue_->post(this, [this, bytes = std::move(incoming.bytes), asker = *asker] { answer(bytes, asker); });
    if (posted) continue;
    ++dropped_;
    notifier_->warn(fmt::format("service {}: requests arrive faster than they are answered, some were dropped", name_));
  }
}

std::optional<ServiceServer::Asker> ServiceServer::asker_of(const fdds::SampleInfo& info,
                                                            interfaces::Bytes& request) const {
  Asker asker{info.sample_identity, {readers_->is_on_this_host(info.sample_identity.writer_guid())}};
  if (readers_->is_of_cyclone(info.sample_identity.writer_guid())) {
    asker.header = take_header(request);
    return asker.header ? std::optional(asker) : std::nullopt;
  }
  const rtps::GUID_t& reply_reader = info.related_sample_identity.writer_guid();
  if (reply_reader != rtps::GUID_t::unknown()) asker.identity.writer_guid(reply_reader);
  return asker;
}

bool ServiceServer::is_over_limits(const Incoming& incoming) {
  if (incoming.bytes.size() > limits_.size) {
    notifier_->warn(fmt::format("service {}: a request of more than {} bytes was dropped", name_, limits_.size));
  } else if (!rate_.take(clocks::monotonic_ns())) {
    notifier_->warn(
        fmt::format("service {}: more than {} requests per second, some were dropped; see requests_per_s in the "
                    "system file",
                    name_, limits_.per_s));
  } else {
    return false;
  }
  ++dropped_;
  return true;
}

interfaces::Bytes ServiceServer::response_to(const interfaces::Bytes& request, const Caller& caller) {
  auto refusal = guard_ ? guard_(request, caller) : std::nullopt;
  if (!refusal) return handler_(request);
  ++refused_;
  notifier_->warn(fmt::format("service {}: a request from {} was refused: see \"services\" in the system file", name_,
                              caller.is_on_this_host ? "this host" : "another host"));
  return std::move(*refusal);
}

void ServiceServer::answer(const interfaces::Bytes& request, const Asker& asker) {
  try {
    auto response = response_to(request, asker.caller);
    if (is_reachable(asker)) {
      send(response, asker);
    } else {
      keep(std::move(response), asker);
    }
  } catch (const interfaces::DecodeError& error) {
    ++malformed_;
    notifier_->warn(fmt::format("service {}: ignored a malformed request: {}", name_, error.what()));
  } catch (const std::exception& error) {
    ++unanswered_;
    notifier_->warn(fmt::format("service {}: a request could not be answered: {}", name_, error.what()));
  }
}

bool ServiceServer::is_reachable(const Asker& asker) const {
  const rtps::GUID_t& client = asker.identity.writer_guid();
  if (asker.header) {  // names no reader; a process may have several clients
    const std::string id = readers_->client_of(client);
    return clients_.contains_any([&](const rtps::GUID_t& reader) {
      return reader.guidPrefix == client.guidPrefix && writers_->client_of(reader) == id;
    });
  }
  return !is_reader(client) || clients_.contains(client);
}

void ServiceServer::send(const interfaces::Bytes& response, const Asker& asker) {
  rtps::WriteParams params;
  params.related_sample_identity(asker.identity);
  const auto for_cyclone = asker.header ? with_header(*asker.header, response) : interfaces::Bytes();
  Outgoing outgoing(asker.header ? for_cyclone : response);
  ++(write(*writer_, &outgoing, params) ? answered_ : unanswered_);
}

void ServiceServer::keep(interfaces::Bytes response, const Asker& asker) {
  if (kept_.size() >= kMaxKept) {
    give_up();
    kept_.pop_front();
  }
  kept_.push_back({std::move(response), asker, ServiceQueue::Clock::now() + kClientLimit});
  set_alarm();
}

void ServiceServer::send_kept() {
  const auto now = ServiceQueue::Clock::now();
  std::erase_if(kept_, [&](const Kept& kept) {
    const bool is_reached = is_reachable(kept.asker);
    if (is_reached) send(kept.response, kept.asker);
    if (!is_reached && kept.end <= now) give_up();
    return is_reached || kept.end <= now;
  });
}

void ServiceServer::set_alarm() {
  if (alarm_set_ || kept_.empty()) return;
  alarm_set_ = true;
  queue_->post_at(this, kept_.front().end, [this] {
    alarm_set_ = false;
    send_kept();
    set_alarm();
  });
}

void ServiceServer::give_up() {
  ++unanswered_;
  notifier_->warn(fmt::format("service {}: a client was gone or unreachable before it got its answer", name_));
}

}  // namespace panvo::runtime::dds
