// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "image_compressor.hpp"
#include "send_queue.hpp"
#include "web_server.hpp"

namespace panvo::web_view {

/// Sends to one client on a thread of its own, so that a slow client delays nobody else. Thread-safe; nothing blocks
/// except the destructor, for the timeout of the connection at most.
class Sender {
 public:
  struct Limits {
    std::size_t max_bytes;
    std::size_t max_items;
  };

  /// `on_stalled` is called at most once, on the sender's thread, when the queue is full or the client has not read for
  /// the timeout of the connection, which is then closed. Not called for a client that has left.
  Sender(WebServer::Connection& connection, Limits limits, ImageCompressor& compressor,
         std::function<void()> on_stalled);
  ~Sender();
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void send_text(std::string json);
  void send_binary(std::vector<std::uint8_t> frame);
  /// A message of a subscription, at a time for the client.
  void send_message(std::uint32_t subscription, std::int64_t time_ns, const runtime::SamplePtr& sample,
                    bool is_to_compress);

  /// Drops what waits of a subscription that has ended.
  void forget(std::uint32_t subscription);

  /// Messages dropped because the client was slow.
  std::uint64_t dropped() const;

 private:
  void push(SendQueue::Item item);
  void loop();
  bool send(const SendQueue::Item& item);
  bool send(const SendQueue::Message& message);

  WebServer::Connection& connection_;
  ImageCompressor& compressor_;
  const std::function<void()> on_stalled_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  SendQueue queue_;
  bool is_full_ = false, is_ending_ = false;
  bool is_broken_ = false;           // nothing can be sent any more
  std::vector<std::uint8_t> frame_;  // of the thread
  std::thread thread_;               // last: uses the members above
};

}  // namespace panvo::web_view
