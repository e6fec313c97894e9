// SPDX-License-Identifier: Apache-2.0
#include "service_caller.hpp"

#include <algorithm>

namespace panvo::runtime {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr std::size_t kMaxCalls = 32;      // calls to other processes, made one at a time
constexpr std::size_t kMaxAnswers = 1024;  // not yet handled by the component
constexpr milliseconds kSlice{100};        // longest delay until the end of the component is noticed

}  // namespace

RemoteCaller::RemoteCaller(Bridge& bridge, const ServiceDescription& service)
    : client_(bridge.open_client(service)), thread_([this] { loop(); }) {}

RemoteCaller::~RemoteCaller() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RemoteCaller::call(interfaces::Bytes request, milliseconds limit, std::shared_ptr<Reply> reply) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || waiting_.size() >= kMaxCalls) return;
  waiting_.push_back({std::move(request), steady_clock::now() + limit, std::move(reply)});
  changed_.notify_all();
}

void RemoteCaller::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (stopping_) return;
    Call call = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    carry_out(call);
    call = {};  // releases the reply without holding the lock
    lock.lock();
  }
}

void RemoteCaller::carry_out(Call& call) {
  const auto left = [&call] { return std::chrono::ceil<milliseconds>(call.end - steady_clock::now()); };
  while (!stopping_ && left() > milliseconds(0)) {
    if (!client_->wait_for_service(std::min(left(), kSlice))) continue;
    if (auto bytes = client_->call(call.request, std::max(left(), milliseconds(1))))
      call.reply->send(std::move(*bytes));
    return;
  }
}

ComponentCaller::ComponentCaller(ServiceDescription service, const ServiceDirectory& directory, Bridge* bridge,
                                 Worker& worker)
    : service_(std::move(service)), directory_(directory) {
  inbox_->worker = &worker;
  inbox_->port = &worker.add_port("answers of " + service_.name, kMaxAnswers, false,
                                  [](Task& task) { std::any_cast<std::function<void()>&>(task.item)(); });
  if (bridge) remote_ = std::make_unique<RemoteCaller>(*bridge, service_);
}

void ComponentCaller::call(interfaces::Bytes request, milliseconds limit, Answer answer) {
  const auto reply = std::make_shared<Reply>([inbox = inbox_, call = inbox_->add(std::move(answer)),
                                              stamp_ns = current_stamp_ns()](std::optional<interfaces::Bytes> bytes) {
    inbox->put(call, std::move(bytes), stamp_ns);
  });
  if (!directory_.call(service_, request, reply) && remote_) remote_->call(std::move(request), limit, reply);
}

void ComponentCaller::close() {
  std::map<std::uint64_t, Answer> unanswered;  // destroyed without the lock
  {
    const std::lock_guard lock(inbox_->mutex);
    inbox_->worker = nullptr;
    unanswered.swap(inbox_->waiting);
  }
  remote_.reset();
}

std::uint64_t ComponentCaller::Inbox::add(Answer answer) {
  const std::lock_guard lock(mutex);
  if (worker) waiting.emplace(++last_call, std::move(answer));
  return last_call;
}

void ComponentCaller::Inbox::put(std::uint64_t call, std::optional<interfaces::Bytes> bytes, std::int64_t stamp_ns) {
  const std::lock_guard lock(mutex);
  auto found = waiting.extract(call);
  if (!found) return;  // closed
  std::function<void()> task = [answer = std::move(found.mapped()), bytes = std::move(bytes)] { answer(bytes); };
  worker->push(*port, {.item = std::move(task), .stamp_ns = stamp_ns});
}

}  // namespace panvo::runtime
