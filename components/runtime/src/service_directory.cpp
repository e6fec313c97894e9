// SPDX-License-Identifier: Apache-2.0
#include "service_directory.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

namespace panvo::runtime {
namespace {

// After this time the request stays unanswered; the client may call again.
constexpr std::chrono::seconds kServiceLimit{5};

/// Passes an answer from one thread to a waiting one.
class Waiting {
 public:
  void bring(std::optional<interfaces::Bytes> bytes) {
    {
      const std::lock_guard lock(mutex_);
      bytes_ = std::move(bytes);
      is_there_ = true;
    }
    changed_.notify_all();
  }

  std::optional<interfaces::Bytes> wait(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, limit, [this] { return is_there_; });
    return std::move(bytes_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<interfaces::Bytes> bytes_;
  bool is_there_ = false;
};

}  // namespace

bool ServiceDirectory::add(const ServiceDescription& service, const void* owner, Serve serve) {
  const std::unique_lock lock(mutex_);
  return entries_.try_emplace(service.name, Entry{service.type_name, owner, std::move(serve)}).second;
}

void ServiceDirectory::remove_of(const void* owner) {
  const std::unique_lock lock(mutex_);
  std::erase_if(entries_, [owner](const auto& entry) { return entry.second.owner == owner; });
}

bool ServiceDirectory::call(const ServiceDescription& service, interfaces::Bytes& request,
                            const std::shared_ptr<Reply>& reply) const {
  const std::shared_lock lock(mutex_);
  const auto found = entries_.find(service.name);
  if (found == entries_.end() || found->second.type_name != service.type_name) return false;
  found->second.serve(std::move(request), reply);
  return true;
}

std::vector<ServiceDescription> ServiceDirectory::services() const {
  const std::shared_lock lock(mutex_);
  std::vector<ServiceDescription> services;
  for (const auto& [name, entry] : entries_) services.push_back({name, entry.type_name});
  return services;
}

std::optional<interfaces::Bytes> answer_to(const std::function<void(std::shared_ptr<Reply>)>& ask,
                                           std::chrono::milliseconds limit) {
  const auto waiting = std::make_shared<Waiting>();
  ask(std::make_shared<Reply>([waiting](auto bytes) { waiting->bring(std::move(bytes)); }));
  return waiting->wait(limit);
}

ServiceHandler handler_of(ServiceDirectory::Serve serve) {
  return [serve = std::move(serve)](const interfaces::Bytes& request) {
    auto bytes = answer_to([&](std::shared_ptr<Reply> reply) { serve(request, std::move(reply)); }, kServiceLimit);
    if (!bytes)
      throw std::runtime_error(
          "the component did not answer: it is busy, was stopped by an error, or could not read the request");
    return std::move(*bytes);
  };
}

}  // namespace panvo::runtime
