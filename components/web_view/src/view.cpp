// SPDX-License-Identifier: Apache-2.0
#include "view.hpp"

#include <chrono>
#include <utility>
#include <vector>

#include "access.hpp"
#include "client_session.hpp"

namespace panvo::web_view {
namespace {

constexpr int kSpareThreads = 2;  // answer clients beyond the allowed number

std::string unique_text() { return std::to_string(std::chrono::system_clock::now().time_since_epoch().count()); }

}  // namespace

View::View(runtime::Context& context, Settings settings)
    : context_(context), settings_(std::move(settings)), session_(unique_text()), topics_(context.topic_access()) {
  WebSocketServer::Settings listening;
  listening.host = settings_.host;
  listening.port = settings_.port;
  listening.threads = static_cast<int>(settings_.max_clients) + kSpareThreads;
  listening.subprotocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
  server_ = std::make_unique<WebSocketServer>(
      std::move(listening),
      WebSocketServer::Callbacks{
          .admit = [this](const std::string& token) { return admit(token); },
          .open = [this](WebSocketServer::Connection& connection) -> std::unique_ptr<WebSocketServer::Session> {
            return std::make_unique<ClientSession>(*this, connection);
          }});
}

View::~View() = default;

std::optional<WebSocketServer::Refusal> View::admit(const std::string& token) {
  if (!settings_.token.empty() && !is_equal_secret(settings_.token, token)) {
    log().warn_throttled("token", "a client without the right token was refused");
    return WebSocketServer::Refusal{401, "the token is missing or wrong"};
  }
  const std::lock_guard lock(mutex_);
  if (sessions_.size() < settings_.max_clients) return std::nullopt;
  log().warn_throttled("max_clients", "a client was refused: max_clients is {}", settings_.max_clients);
  return WebSocketServer::Refusal{503, "there are too many clients"};
}

void View::refresh() {
  {
    const std::lock_guard lock(mutex_);
    if (sessions_.empty()) return;
  }
  update();
}

void View::update() {
  const std::lock_guard updating(update_mutex_);
  const auto published = topics_->published();
  std::vector<std::shared_ptr<void>> ended;  // closed after the lock is released: closing waits for publishers
  const std::lock_guard lock(mutex_);
  const auto change = table_.update(published);
  if (table_.left_out() > 0)
    log().warn_throttled("channels", "{} topics are not offered: there are more than {}", table_.left_out(),
                         ChannelTable::kMaxChannels);
  for (ClientSession* session : sessions_) session->tell(change, ended);
}

std::optional<runtime::TopicDescription> View::find(std::uint32_t channel) const {
  const std::lock_guard lock(mutex_);
  const auto* topic = table_.find(channel);
  return topic ? std::optional(*topic) : std::nullopt;
}

void View::join(ClientSession& session) {
  update();
  const std::lock_guard lock(mutex_);
  session.welcome(table_.channels());
  sessions_.insert(&session);
}

void View::leave(ClientSession& session) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(&session);
}

}  // namespace panvo::web_view
