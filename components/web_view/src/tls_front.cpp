// SPDX-License-Identifier: Apache-2.0
#include "tls_front.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <list>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "tls_relay.hpp"
#include "web_server.hpp"

namespace panvo::web_view {
namespace {

using Clock = TlsRelay::Clock;

constexpr std::chrono::milliseconds kPauseWhenFull{100};  // of accepting, when the process has no descriptors left

/// Throws ServerError.
Descriptor listen_on(const std::string& host, int port) {
  const auto fail = [&](const char* why) -> Descriptor {
    throw ServerError("cannot listen on " + host + ":" + std::to_string(port) + ": " + why);
  };
  const bool is_in_brackets = host.starts_with('[') && host.ends_with(']');
  const std::string name = is_in_brackets ? host.substr(1, host.size() - 2) : host;
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int result = ::getaddrinfo(name.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (result != 0) return fail(::gai_strerror(result));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> address(found, ::freeaddrinfo);
  Descriptor listener(::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, address->ai_protocol));
  const int on = 1;
  ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (listener.get() < 0 || ::bind(listener.get(), address->ai_addr, address->ai_addrlen) != 0 ||
      ::listen(listener.get(), SOMAXCONN) != 0)
    return fail(std::strerror(errno));
  return listener;
}

/// "192.168.1.7" and "43210".
std::pair<std::string, std::string> text_of(const sockaddr_storage& address, socklen_t size) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host.data(), host.size(), port.data(), port.size(),
                NI_NUMERICHOST | NI_NUMERICSERV);
  return {host.data(), port.data()};
}

}  // namespace

class TlsFront::Loop {
 public:
  Loop(Settings settings, RelayedPeers& peers, Warn warn)
      : settings_(std::move(settings)),
        peers_(peers),
        warn_(std::move(warn)),
        context_(settings_.files),
        listener_(listen_on(settings_.host, settings_.port)),
        wake_(::eventfd(0, EFD_CLOEXEC)),
        thread_([this] { run(); }) {}

  ~Loop() {
    ::eventfd_write(wake_.get(), 1);
    thread_.join();
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  int port() const {
    sockaddr_storage name{};
    socklen_t size = sizeof name;
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&name), &size);
    return std::stoi(text_of(name, size).second);
  }

 private:
  void run() {
    sigset_t broken_pipe;  // OpenSSL writes to sockets whose clients may have left
    sigemptyset(&broken_pipe);
    sigaddset(&broken_pipe, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);
    while (true) {
      try {
        if (!serve()) return;
      } catch (const std::exception& error) {  // no memory, perhaps only now
        warn_("tls", std::string("TLS: ") + error.what());
      }
    }
  }

  /// One round. False: it is time to end.
  bool serve() {
    const auto before = Clock::now();
    const bool is_paused = before < paused_until_;
    events_.assign({pollfd{wake_.get(), POLLIN, 0}, pollfd{is_paused ? -1 : listener_.get(), POLLIN, 0}});
    for (const auto& relay : relays_) {
      for (const auto& event : relay.events()) events_.push_back(event);
    }
    ::poll(events_.data(), events_.size(), wait_ms(before));
    if (events_[0].revents != 0) return false;
    const bool has_new_client = events_[1].revents != 0;
    const auto now = Clock::now();
    auto event = events_.cbegin() + 2;
    for (auto& relay : relays_) {
      const bool is_due = event[0].revents != 0 || event[1].revents != 0 || relay.is_ready() || now >= relay.deadline();
      event += 2;
      if (is_due) advance(relay, now);
    }
    relays_.remove_if([](const TlsRelay& relay) { return relay.has_ended(); });
    if (has_new_client) admit(now);
    return true;
  }

  int wait_ms(Clock::time_point now) const {
    auto until = now < paused_until_ ? paused_until_ : Clock::time_point::max();
    for (const auto& relay : relays_) {
      if (relay.is_ready()) return 0;
      until = std::min(until, relay.deadline());
    }
    if (until == Clock::time_point::max()) return -1;
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(until - now).count();
    return static_cast<int>(std::clamp<std::int64_t>(rest, 0, 60'000));
  }

  void advance(TlsRelay& relay, Clock::time_point now) {
    const bool was_in_handshake = relay.is_in_handshake();
    relay.advance(now);
    if (!was_in_handshake || relay.is_in_handshake()) return;
    if (!relay.problem().empty()) warn_("tls client", "client " + relay.peer() + ": no TLS: " + relay.problem());
    if (relay.is_relaying() && relays_.size() - without_server() > settings_.max_relays) {
      relay.end();
      warn_("tls clients", "a client was closed: there are more than " + std::to_string(settings_.max_relays));
    }
  }

  /// In the handshake, or waiting for their end.
  std::size_t without_server() const {
    return relays_.size() - static_cast<std::size_t>(std::ranges::count_if(relays_, &TlsRelay::is_relaying));
  }

  /// Takes the clients that wait to connect.
  void admit(Clock::time_point now) {
    if (const auto problem = context_.refresh()) warn_("tls files", *problem);
    constexpr int kMostAtOnce = 64;
    for (int i = 0; i < kMostAtOnce; ++i) {
      sockaddr_storage address{};
      socklen_t size = sizeof address;
      Descriptor client(
          ::accept4(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (client.get() < 0) {
        if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
          paused_until_ = now + kPauseWhenFull;
        return;
      }
      if (without_server() >= settings_.max_handshakes)
        relays_.erase(std::ranges::find_if_not(relays_, &TlsRelay::is_relaying));
      const auto [host, port] = text_of(address, size);
      auto tls = context_.connection(client.get());
      relays_.emplace_back(std::move(tls), std::move(client), host + ":" + port,
                           TlsRelay::Target{settings_.inner_port, peers_}, now + settings_.handshake_timeout);
    }
  }

  const Settings settings_;
  RelayedPeers& peers_;
  const Warn warn_;
  TlsContext context_;  // this and the next four: used by the thread only
  const Descriptor listener_, wake_;
  std::list<TlsRelay> relays_;  // the oldest first
  std::vector<pollfd> events_;
  Clock::time_point paused_until_{};
  std::thread thread_;  // last: it uses the members above
};

TlsFront::TlsFront(Settings settings, RelayedPeers& peers, Warn warn)
    : loop_(std::make_unique<Loop>(std::move(settings), peers, std::move(warn))) {}

TlsFront::~TlsFront() = default;

int TlsFront::port() const { return loop_->port(); }

}  // namespace panvo::web_view
