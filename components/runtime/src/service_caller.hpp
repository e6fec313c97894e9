// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/client.hpp"
#include "service_directory.hpp"
#include "worker.hpp"

namespace panvo::runtime {

/// Calls a service of another process, one call at a time, on its own thread, as the bridge's client blocks.
class RemoteCaller {
 public:
  /// Throws ConfigError if the bridge refuses the client.
  RemoteCaller(Bridge& bridge, const ServiceDescription& service);
  ~RemoteCaller();

  /// The call stays unanswered if too many are waiting.
  void call(interfaces::Bytes request, std::chrono::milliseconds limit, std::shared_ptr<Reply> reply);

 private:
  struct Call {
    interfaces::Bytes request;
    std::chrono::steady_clock::time_point end;
    std::shared_ptr<Reply> reply;
  };

  void loop();
  void carry_out(Call& call);

  const std::unique_ptr<BridgeClient> client_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Call> waiting_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

/// A component's client of one service. Answers pass through the component's queue; after close() they are dropped.
class ComponentCaller final : public ServiceCaller {
 public:
  /// `bridge` may be nullptr.
  ComponentCaller(ServiceDescription service, const ServiceDirectory& directory, Bridge* bridge, Worker& worker);

  void call(interfaces::Bytes request, std::chrono::milliseconds limit, Answer answer) override;
  void close();

 private:
  /// Receives answers while the component's worker exists. It alone holds the component's functions: a call may still
  /// wait in another component when this one's plugin is unloaded.
  struct Inbox {
    std::mutex mutex;
    Worker* worker = nullptr;
    Port* port = nullptr;
    std::uint64_t last_call = 0;
    std::map<std::uint64_t, Answer> waiting{};  // by number of the call

    std::uint64_t add(Answer answer);
    void put(std::uint64_t call, std::optional<interfaces::Bytes> bytes, std::int64_t stamp_ns);
  };

  const ServiceDescription service_;
  const ServiceDirectory& directory_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  std::unique_ptr<RemoteCaller> remote_;
};

}  // namespace panvo::runtime
