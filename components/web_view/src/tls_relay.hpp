// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "descriptor.hpp"
#include "relayed_peers.hpp"
#include "tls_context.hpp"

namespace panvo::web_view {

/// One client of a TLS server, and the connection to a plain port of this machine to which its bytes are handed on. It
/// holds few of them, so the plain server notices a slow client. Nothing here waits; used by one thread.
class TlsRelay {
 public:
  using Clock = std::chrono::steady_clock;
  struct Target {
    int port;             ///< of 127.0.0.1
    RelayedPeers& peers;  ///< told of the connection to it
  };

  /// `client`: a socket that does not wait, of which `tls` is the server's end. The handshake must end by `deadline`.
  TlsRelay(TlsConnection tls, Descriptor client, std::string peer, Target target, Clock::time_point deadline);
  ~TlsRelay();
  TlsRelay(const TlsRelay&) = delete;
  TlsRelay& operator=(const TlsRelay&) = delete;

  /// Moves what can be moved.
  void advance(Clock::time_point now);

  bool is_in_handshake() const { return state_ == State::kHandshake; }
  /// Whether it has a connection to the server.
  bool is_relaying() const { return state_ == State::kRelay || state_ == State::kFarewell; }
  bool has_ended() const { return state_ == State::kEnded; }
  void end() { state_ = State::kEnded; }
  /// Whether there is more to move at once.
  bool is_ready() const { return is_ready_; }
  /// What to wait for, of client and server; a descriptor of -1: nothing.
  std::array<pollfd, 2> events() const;
  /// When advance() is due without an event.
  Clock::time_point deadline() const { return deadline_; }
  /// "192.168.1.7:43210".
  const std::string& peer() const { return peer_; }
  /// Why the handshake failed, if the client said anything.
  const std::string& problem() const { return problem_; }

 private:
  enum class State {
    kHandshake,
    kRelay,
    kFarewell,  // the server has ended the connection
    kDrain,  // all is sent: waits for the client's end, as what it still sends would otherwise make it lose the answer
    kEnded
  };
  enum class Step { kDone, kBlocked, kEnd, kBroken };
  struct Buffer {
    std::vector<std::uint8_t> bytes;
    std::size_t begin = 0, end = 0;

    bool is_empty() const { return begin == end; }
    std::span<const std::uint8_t> rest() const { return {bytes.data() + begin, end - begin}; }
  };

  Step outcome(int result);
  void shake_hands(Clock::time_point now);
  void end_handshake(Clock::time_point now);
  void connect();
  void disconnect();
  void pump(Clock::time_point now);
  bool pump_up();
  bool pump_down(Clock::time_point now);
  void say_farewell(Clock::time_point now);
  void start_drain(Clock::time_point now);
  void drain();

  TlsConnection tls_;
  const Descriptor client_;
  Descriptor server_;
  const std::string peer_;
  const Target target_;
  int own_port_ = 0;  // of the connection to the server
  State state_ = State::kHandshake;
  bool is_ready_ = false;
  bool has_client_ended_ = false, is_server_told_ = false;
  short client_events_ = POLLIN, server_events_ = 0;
  Clock::time_point deadline_;
  Clock::time_point taken_at_{};  // when the client last took bytes, or there were none for it
  Buffer up_, down_;              // to the server, to the client
  std::string problem_;
};

}  // namespace panvo::web_view
