// SPDX-License-Identifier: Apache-2.0
// Services of a component: offered and called.
#include "context_state.hpp"

namespace panvo::runtime {
namespace {

constexpr int kMaxWaitingRequests = 32;  // waiting per component

struct WaitingRequest {
  interfaces::Bytes bytes;
  std::shared_ptr<Reply> reply;
  std::shared_ptr<void> place;  // occupies a waiting slot
};

}  // namespace

void Context::open_service(ServiceDescription service, ServiceHandler handler) {
  service.name = resolved_name(service.name);
  Worker& worker = state_->main_worker();
  Port& port = worker.add_port("service " + service.name, kMaxWaitingRequests, false,
                               [handler = std::move(handler)](Task& task) {
                                 auto& request = *std::any_cast<std::shared_ptr<WaitingRequest>&>(task.item);
                                 request.reply->send(handler(request.bytes));
                               });
  const auto waiting = std::make_shared<std::atomic<int>>(0);
  ServiceDirectory::Serve serve = [&worker, &port, waiting](interfaces::Bytes bytes, std::shared_ptr<Reply> reply) {
    const std::shared_ptr<void> place(nullptr, [waiting](void*) { --*waiting; });
    if (++*waiting > kMaxWaitingRequests) return worker.count_dropped(port);
    worker.push(port,
                {.item = std::make_shared<WaitingRequest>(WaitingRequest{std::move(bytes), std::move(reply), place}),
                 .stamp_ns = current_stamp_ns()});
  };
  if (!state_->host.services.add(service, state_.get(), serve)) {  // as in ROS 2, two nodes may offer it
    log().warn(
        "service {} already exists in this container, and its component answers calls of this process; remap one "
        "of them",
        service.name);
  }
  state_->services.emplace_back(std::move(service), std::move(serve));
}

std::shared_ptr<ServiceCaller> Context::open_client(ServiceDescription service) {
  service.name = resolved_name(service.name);
  Bridge* const bridge = state_->host.bus.bridge();
  return state_->callers.emplace_back(
      std::make_shared<ComponentCaller>(std::move(service), state_->host.services, bridge, state_->main_worker()));
}

}  // namespace panvo::runtime
