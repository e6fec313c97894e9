// SPDX-License-Identifier: Apache-2.0
#include "client_session.hpp"

#include <exception>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "playback.hpp"
#include "protocol_error.hpp"
#include "view.hpp"

namespace panvo::web_view {
namespace {

constexpr std::size_t kMaxRequestBytes = 4'000'000;  // of one message of a client
constexpr std::size_t kMaxWaiting = 20'000;          // messages, too small to fill the queue's bytes
constexpr std::size_t kMaxSubscriptions = 5000;
constexpr std::size_t kMaxPublications = 100;
constexpr std::chrono::seconds kDropsPeriod{10};

}  // namespace

ClientSession::ClientSession(View& view, WebServer::Connection& connection)
    : view_(view),
      connection_(connection),
      notation_(connection.option("schemas") == "omgidl" ? SchemaNotation::kOmgIdl : SchemaNotation::kRos2msg),
      assembly_(kMaxRequestBytes),
      sender_(connection, {view.settings().queue_bytes, kMaxWaiting}, view.compressor(), [this] {
        view_.log().warn_throttled(
            "stalled", "client {} does not read what it subscribed to: closed, {} messages were dropped before",
            connection_.address(), sender_.dropped());
      }) {
  view_.join(*this);
  view_.log().debug("client {} connected", connection_.address());
}

ClientSession::~ClientSession() {
  view_.leave(*this);
  std::map<std::uint32_t, Subscription> ended;
  {
    const std::lock_guard lock(mutex_);
    ended.swap(subscriptions_);
  }
  ended.clear();
  if (const auto dropped = sender_.dropped(); dropped > 0)
    view_.log().info("client {}: {} large messages were dropped because it read too slowly", connection_.address(),
                     dropped);
}

void ClientSession::welcome(bool has_time) {
  has_time_ = has_time;
  const auto& settings = view_.settings();
  std::vector<std::string> capabilities{"parameters", "parametersSubscribe", "connectionGraph"};
  if (settings.allow_control) capabilities.insert(capabilities.end(), {"clientPublish", "services"});
  if (!settings.assets.empty()) capabilities.emplace_back("assets");
  if (has_time) capabilities.emplace_back("time");
  const auto range = view_.playback().range();
  if (range && settings.allow_control) capabilities.emplace_back("playbackControl");
  sender_.send_text(server_info("panvo", capabilities, view_.session() + (has_time ? "-timed" : ""), range));
}

void ClientSession::tell(const ChannelTable::Change& change, std::vector<std::shared_ptr<void>>& ended) {
  if (!change.removed.empty()) sender_.send_text(unadvertise(change.removed));
  if (!change.added.empty()) sender_.send_text(web_view::advertise(change.added, notation_));
  const std::set<std::uint32_t> removed(change.removed.begin(), change.removed.end());
  const std::lock_guard lock(mutex_);
  std::erase_if(subscriptions_, [&](auto& entry) {
    if (!removed.contains(entry.second.channel)) return false;
    if (ended_.size() < kMaxSubscriptions) ended_.insert(entry.first);
    ended.push_back(std::move(entry.second.reading));
    return true;
  });
}

void ClientSession::tell_time() {
  const std::lock_guard lock(time_mutex_);
  const auto now_ns = view_.time_ns();  // under the lock: an older time must not be told after a newer one
  if (!now_ns || now_ns == told_time_ns_) return;
  if (!has_time_) {
    welcome(true);
    // On this, Lichtblick takes the types of all channels into the session.
    sender_.send_text(web_view::advertise({}, notation_));
  }
  sender_.send_binary(time_frame(*now_ns));
  told_time_ns_ = *now_ns;
}

void ClientSession::tell_playback(bool is_moved) {
  const std::lock_guard lock(mutex_);
  if (!told_playback_) return;
  const auto state = state_of(view_.playback());  // under the lock: an older state must not be told after a newer one
  if (!state) return;
  if (!is_moved && state->status == told_playback_->status && state->speed == told_playback_->speed) return;
  told_playback_ = state;
  sender_.send_binary(playback_frame(*state, is_moved, ""));
}

void ClientSession::tell_drops() {
  const auto dropped = sender_.dropped();
  const auto now = std::chrono::steady_clock::now();
  if (dropped == told_drops_ || now - drops_told_at_ < kDropsPeriod) return;
  drops_told_at_ = now;
  sender_.send_text(status(StatusLevel::kWarning, "the connection is slow: " + std::to_string(dropped - told_drops_) +
                                                      " large messages were left out"));
  told_drops_ = dropped;
}

std::size_t ClientSession::subscriptions() const {
  const std::lock_guard lock(mutex_);
  return subscriptions_.size();
}

void ClientSession::receive(std::uint8_t head, std::span<const std::uint8_t> data) {
  try {
    const auto message = assembly_.add(head, data);
    if (!message) return;
    const std::span<const std::uint8_t> bytes = message->data;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::visit([this](const auto& request) { handle(request); },
               message->is_text ? parse_text(text) : parse_binary(bytes));
  } catch (const std::exception& error) {  // of the protocol, of a topic, or of a message's bytes
    complain(error.what());
  }
}

void ClientSession::complain(const std::string& why) { sender_.send_text(status(StatusLevel::kError, why)); }

void ClientSession::handle(const Subscribe& request) {
  for (const auto& wanted : request.subscriptions) {
    try {
      subscribe(wanted);
    } catch (const std::exception& error) {
      complain("subscription " + std::to_string(wanted.id) + ": " + error.what());
    }
  }
}

void ClientSession::subscribe(const Subscribe::One& wanted) {
  const auto topic = view_.find(wanted.channel);
  if (!topic) throw ProtocolError("unknown channel " + std::to_string(wanted.channel));
  {
    const std::lock_guard lock(mutex_);
    if (subscriptions_.contains(wanted.id)) throw ProtocolError("the id is in use");
    if (subscriptions_.size() >= kMaxSubscriptions) throw ProtocolError("there are too many subscriptions");
  }
  const auto source = view_.compressor().source_of(topic->name);
  const auto send = [this, id = wanted.id, is_to_compress = source.has_value()](const runtime::SamplePtr& sample) {
    // By the clock of tell_time(), if the client is told the time.
    const auto time_ns = has_time_ ? view_.time_ns() : std::nullopt;
    // Viewers drop what came before a time that goes back, also transforms that are sent only once.
    if (time_ns && *time_ns < told_time_ns_) tell_time();
    sender_.send_message(id, time_ns.value_or(sample->time_ns()), sample, is_to_compress);
  };
  auto reading = view_.topics().read(source.value_or(*topic), send);
  {
    const std::lock_guard lock(mutex_);
    ended_.erase(wanted.id);
    subscriptions_.emplace(wanted.id, Subscription{wanted.channel, std::move(reading)});
  }
  // The channel may have been removed meanwhile, before the subscription was there to be ended with it.
  if (!view_.find(wanted.channel)) take_subscription(wanted.id);
}

std::shared_ptr<void> ClientSession::take_subscription(std::uint32_t id) {
  const std::lock_guard lock(mutex_);
  const auto node = subscriptions_.extract(id);
  return node ? std::move(node.mapped().reading) : nullptr;
}

void ClientSession::handle(const Unsubscribe& request) {
  for (const std::uint32_t id : request.subscriptions) {
    auto reading = take_subscription(id);
    if (!reading) {
      const std::lock_guard lock(mutex_);
      if (ended_.erase(id) > 0) continue;  // viewers unsubscribe from channels that were removed
      complain("unknown subscription " + std::to_string(id));
      continue;
    }
    reading.reset();
    sender_.forget(id);
  }
}

void ClientSession::refuse_without_control() const {
  if (!view_.settings().allow_control)
    throw ProtocolError("clients may only read here: the parameter allow_control of the web view is false");
}

void ClientSession::handle(const Advertise& request) {
  refuse_without_control();
  for (const auto& wanted : request.channels) {
    try {
      advertise(wanted);
    } catch (const std::exception& error) {
      complain("topic " + wanted.topic + ": " + error.what());
    }
  }
}

void ClientSession::advertise(const Advertise::One& wanted) {
  if (wanted.encoding != "cdr") throw ProtocolError("the encoding is not cdr");
  if (!wanted.topic.starts_with('/')) throw ProtocolError("the name does not begin with a slash");
  if (publications_.contains(wanted.id)) throw ProtocolError("the id is in use");
  if (publications_.size() >= kMaxPublications) throw ProtocolError("the client publishes too many topics");
  const auto* type = interfaces::find_message_type(wanted.schema_name);
  if (!type) throw ProtocolError("the type " + wanted.schema_name + " " + interfaces::why_unknown(wanted.schema_name));
  auto output = view_.topics().write({wanted.topic, wanted.schema_name, interfaces::qos::kDefault, type});
  publications_.emplace(wanted.id, Publication{type, std::move(output)});
  view_.log().info("client {} publishes {}", connection_.address(), wanted.topic);
}

void ClientSession::handle(const Unadvertise& request) {
  refuse_without_control();
  for (const std::uint32_t id : request.channels) {
    if (publications_.erase(id) == 0) complain("channel " + std::to_string(id) + " is not advertised by this client");
  }
}

void ClientSession::handle(const Publish& request) {
  refuse_without_control();
  const auto found = publications_.find(request.channel);
  if (found == publications_.end())
    throw ProtocolError("channel " + std::to_string(request.channel) + " is not advertised by this client");
  // As an object, so that the rules of its type are checked before anybody gets it.
  found->second.output->publish(std::shared_ptr<const void>(found->second.type->deserialize(request.payload)));
}

}  // namespace panvo::web_view
