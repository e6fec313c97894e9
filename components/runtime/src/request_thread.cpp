// SPDX-License-Identifier: Apache-2.0
#include "request_thread.hpp"

#include <exception>
#include <utility>

namespace panvo::runtime {
namespace {

constexpr std::size_t kMaxWaiting = 256;  // further requests stay unanswered

}  // namespace

RequestThread::~RequestThread() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

ServiceDirectory::Serve RequestThread::serve(const void* owner, ServiceHandler handler) {
  auto shared = std::make_shared<const ServiceHandler>(std::move(handler));
  return [this, owner, shared = std::move(shared)](interfaces::Bytes bytes, std::shared_ptr<Reply> reply) {
    put({owner, shared, std::move(bytes), std::move(reply)});
  };
}

void RequestThread::put(Request request) {
  const std::lock_guard lock(mutex_);
  if (is_ending_ || waiting_.size() >= kMaxWaiting) return;
  if (!thread_.joinable()) thread_ = std::thread([this] { loop(); });
  waiting_.push_back(std::move(request));
  changed_.notify_all();
}

void RequestThread::remove_of(const void* owner) {
  std::deque<Request> removed;  // their replies are released without the lock
  std::unique_lock lock(mutex_);
  std::erase_if(waiting_, [&](Request& request) {
    if (request.owner != owner) return false;
    removed.push_back(std::move(request));
    return true;
  });
  changed_.wait(lock, [&] { return answering_ != owner; });
}

void RequestThread::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (is_ending_) return;
    Request request = std::move(waiting_.front());
    waiting_.pop_front();
    answering_ = request.owner;
    lock.unlock();
    try {
      request.reply->send((*request.handler)(request.bytes));
    } catch (const std::exception&) {  // a malformed request, which stays unanswered
    }
    request = {};
    lock.lock();
    answering_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace panvo::runtime
