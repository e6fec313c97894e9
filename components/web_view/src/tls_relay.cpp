// SPDX-License-Identifier: Apache-2.0
#include "tls_relay.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <sys/socket.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace panvo::web_view {
namespace {

constexpr std::size_t kBufferBytes = 16'384;  // one record of TLS
constexpr int kWindowBytes = 65'536;          // of the server's bytes that wait in the relay's socket
constexpr int kRounds = 8;                    // after which other clients have their turn
// The server, which gives up after 5 s without progress, must be first, as it says so.
constexpr std::chrono::seconds kClientPatience{10};
constexpr std::chrono::seconds kDrainPatience{2};

constexpr std::string_view kPlainAnswer =
    "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain; charset=utf-8\r\nConnection: close\r\nContent-Length: 52\r\n"
    "\r\nthis port speaks TLS: use https:// or wss:// for it\n";

void send_at_once(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

TlsRelay::TlsRelay(TlsConnection tls, Descriptor client, std::string peer, Target target, Clock::time_point deadline)
    : tls_(std::move(tls)), client_(std::move(client)), peer_(std::move(peer)), target_(target), deadline_(deadline) {
  send_at_once(client_.get());
}

TlsRelay::~TlsRelay() { disconnect(); }

std::array<pollfd, 2> TlsRelay::events() const {
  // Without an event to wait for, not even an end is reported: it would be again and again.
  return {pollfd{client_events_ ? client_.get() : -1, client_events_, 0},
          pollfd{server_events_ ? server_.get() : -1, server_events_, 0}};
}

void TlsRelay::advance(Clock::time_point now) {
  client_events_ = server_events_ = 0;
  is_ready_ = false;
  ERR_clear_error();  // SSL_get_error() looks at what is left from another connection, too
  if (state_ == State::kHandshake) shake_hands(now);
  if (state_ == State::kRelay) pump(now);
  if (state_ == State::kFarewell) say_farewell(now);
  if (state_ == State::kDrain) drain();
  if (now >= deadline_) state_ = State::kEnded;
}

TlsRelay::Step TlsRelay::outcome(int result) {
  switch (SSL_get_error(tls_.get(), result)) {
    case SSL_ERROR_NONE:
      return Step::kDone;
    case SSL_ERROR_WANT_READ:
      client_events_ = static_cast<short>(client_events_ | POLLIN);
      return Step::kBlocked;
    case SSL_ERROR_WANT_WRITE:
      client_events_ = static_cast<short>(client_events_ | POLLOUT);
      return Step::kBlocked;
    case SSL_ERROR_ZERO_RETURN:
      return Step::kEnd;
    default:
      return Step::kBroken;
  }
}

void TlsRelay::shake_hands(Clock::time_point now) {
  const auto step = outcome(SSL_accept(tls_.get()));
  if (step == Step::kBlocked) return;
  if (step != Step::kDone) return end_handshake(now);
  up_.bytes.resize(kBufferBytes);
  down_.bytes.resize(kBufferBytes);
  connect();
}

/// Answers a client that failed.
void TlsRelay::end_handshake(Clock::time_point now) {
  const auto error = ERR_peek_error();
  const int reason = ERR_GET_LIB(error) == ERR_LIB_SSL ? ERR_GET_REASON(error) : 0;
  if (error == 0 || reason == SSL_R_UNEXPECTED_EOF_WHILE_READING) {
    state_ = State::kEnded;  // it has left
    return;
  }
  if (reason == SSL_R_HTTP_REQUEST || reason == SSL_R_HTTPS_PROXY_REQUEST) {
    problem_ = "it speaks HTTP without TLS; use https:// or wss://";
    ::send(client_.get(), kPlainAnswer.data(), kPlainAnswer.size(), MSG_NOSIGNAL);
  } else {
    const char* const text = ERR_reason_error_string(error);
    problem_ = text ? text : "unknown reason";
  }
  start_drain(now);
}

void TlsRelay::connect() {
  server_ = Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  ::setsockopt(server_.get(), SOL_SOCKET, SO_RCVBUF, &kWindowBytes, sizeof kWindowBytes);
  send_at_once(server_.get());
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof name;
  auto* const generic = reinterpret_cast<sockaddr*>(&name);
  // Bound first, so that the server finds the peer as soon as the connection is there.
  const bool is_bound = ::bind(server_.get(), generic, size) == 0 && ::getsockname(server_.get(), generic, &size) == 0;
  if (is_bound) {
    own_port_ = ntohs(name.sin_port);
    target_.peers.add(own_port_, peer_);
    name.sin_port = htons(static_cast<std::uint16_t>(target_.port));
  }
  const bool is_begun = is_bound && (::connect(server_.get(), generic, size) == 0 || errno == EINPROGRESS);
  state_ = is_begun ? State::kRelay : State::kEnded;
}

void TlsRelay::disconnect() {
  if (own_port_ != 0) target_.peers.remove(std::exchange(own_port_, 0));  // before the port is free for others
  server_ = Descriptor();
}

void TlsRelay::pump(Clock::time_point now) {
  for (int round = 0; state_ == State::kRelay; ++round) {
    client_events_ = server_events_ = 0;
    is_ready_ = round == kRounds;
    if (is_ready_) break;
    const bool has_moved_up = pump_up();
    if (state_ != State::kRelay) break;
    const bool has_moved_down = pump_down(now);
    if (!has_moved_up && !has_moved_down) break;
  }
  if (state_ == State::kRelay) deadline_ = down_.is_empty() ? Clock::time_point::max() : taken_at_ + kClientPatience;
}

/// Whether bytes were moved, in which case it is to be called again.
bool TlsRelay::pump_up() {
  bool has_moved = false;
  if (up_.is_empty() && !has_client_ended_) {
    const int count = SSL_read(tls_.get(), up_.bytes.data(), static_cast<int>(up_.bytes.size()));
    const auto step = outcome(count);
    if (step == Step::kBroken) state_ = State::kEnded;
    has_client_ended_ = step == Step::kEnd;
    up_.begin = 0;
    up_.end = step == Step::kDone ? static_cast<std::size_t>(count) : 0;
    has_moved = step == Step::kDone;
  }
  if (!up_.is_empty()) {
    const ssize_t count = ::send(server_.get(), up_.rest().data(), up_.rest().size(), MSG_NOSIGNAL);
    if (count >= 0) {
      up_.begin += static_cast<std::size_t>(count);
      has_moved = true;
    } else if (would_block()) {
      server_events_ = static_cast<short>(server_events_ | POLLOUT);
    } else {  // the server reads no more; its answer may still come
      up_.begin = up_.end;
      has_client_ended_ = is_server_told_ = true;
    }
  }
  if (has_client_ended_ && up_.is_empty() && !std::exchange(is_server_told_, true)) ::shutdown(server_.get(), SHUT_WR);
  return has_moved;
}

/// The same in the other direction.
bool TlsRelay::pump_down(Clock::time_point now) {
  bool has_moved = false;
  if (down_.is_empty()) {
    const ssize_t count = ::recv(server_.get(), down_.bytes.data(), down_.bytes.size(), 0);
    if (count > 0) {
      down_.begin = 0;
      down_.end = static_cast<std::size_t>(count);
      has_moved = true;
    } else if (count < 0 && would_block()) {
      server_events_ = static_cast<short>(server_events_ | POLLIN);
    } else {
      state_ = State::kFarewell;
      deadline_ = now + kDrainPatience;
    }
    taken_at_ = now;
  }
  if (down_.is_empty()) return has_moved;
  const int count = SSL_write(tls_.get(), down_.rest().data(), static_cast<int>(down_.rest().size()));
  const auto step = outcome(count);
  if (step == Step::kBroken || step == Step::kEnd) state_ = State::kEnded;
  if (step != Step::kDone) return has_moved;
  down_.begin += static_cast<std::size_t>(count);
  taken_at_ = now;
  return true;
}

/// Tells the client that the end is the server's, not an attacker's.
void TlsRelay::say_farewell(Clock::time_point now) {
  const int result = SSL_shutdown(tls_.get());
  if (result < 0 && outcome(result) == Step::kBlocked) return;
  start_drain(now);
}

void TlsRelay::start_drain(Clock::time_point now) {
  client_events_ = server_events_ = 0;
  disconnect();
  ::shutdown(client_.get(), SHUT_WR);
  state_ = State::kDrain;
  deadline_ = now + kDrainPatience;
}

void TlsRelay::drain() {
  std::array<std::uint8_t, 4096> rubbish{};
  const ssize_t count = ::recv(client_.get(), rubbish.data(), rubbish.size(), 0);
  if (count == 0 || (count < 0 && !would_block())) {
    state_ = State::kEnded;
  } else {
    client_events_ = POLLIN;
  }
}

}  // namespace panvo::web_view
