// SPDX-License-Identifier: Apache-2.0
// What clients ask of nodes: parameters, services, who is connected to whom; assets; and playback.
#include <algorithm>
#include <exception>
#include <utility>

#include "assets.hpp"
#include "client_session.hpp"
#include "panvo/interfaces/node_topics.hpp"
#include "playback.hpp"
#include "protocol_error.hpp"
#include "view.hpp"

namespace panvo::web_view {
namespace {

constexpr std::size_t kMaxWatched = 10'000;       // parameters named by one client
constexpr std::chrono::seconds kServiceLimit{5};  // for the response of a service

runtime::TopicDescription parameter_events() {
  const auto& type = interfaces::message_type<rcl_interfaces::msg::ParameterEvent>();
  return {"/parameter_events", std::string(type.name), {.depth = 1000}, &type};
}

}  // namespace

void ClientSession::answer(const ParameterAccess::Result& result, const std::string& id, bool is_answer_wanted) {
  for (const auto& problem : result.problems) complain(problem);
  if (is_answer_wanted) sender_.send_text(parameter_values(result.parameters, id));
}

void ClientSession::handle(const GetParameters& request) {
  slow_requests_.add([this, request] { answer(view_.parameters().get(request.names), request.id, true); });
}

void ClientSession::handle(const SetParameters& request) {
  refuse_without_control();
  slow_requests_.add([this, request] {
    answer(view_.parameters().set(request.parameters), request.id, !request.id.empty());
    view_.log().info("client {} set {} parameters", address(), request.parameters.size());
  });
}

void ClientSession::handle(const WatchParameters& request) {
  {
    const std::lock_guard lock(mutex_);
    if (request.names.empty()) {
      watches_all_parameters_ = request.is_on;
      if (!request.is_on) watched_parameters_.clear();
    } else if (request.is_on) {
      if (watched_parameters_.size() + request.names.size() > kMaxWatched)
        throw ProtocolError("there are too many names of parameters");
      watched_parameters_.insert(request.names.begin(), request.names.end());
    } else {
      for (const auto& name : request.names) watched_parameters_.erase(name);
    }
  }
  if (request.is_on && !parameter_events_)
    parameter_events_ =
        view_.topics().read(parameter_events(), [this](const runtime::SamplePtr& event) { tell_changed(event); });
}

/// Called on the publisher's thread.
void ClientSession::tell_changed(const runtime::SamplePtr& event) {
  try {
    auto changed = parameters_of(*runtime::Sample::as<rcl_interfaces::msg::ParameterEvent>(event));
    {
      const std::lock_guard lock(mutex_);
      if (!watches_all_parameters_)
        std::erase_if(changed, [this](const auto& one) { return !watched_parameters_.contains(one.name); });
    }
    if (!changed.empty()) sender_.send_text(parameter_values(changed, ""));
  } catch (const std::exception&) {  // not an event; the publisher must not suffer
  }
}

void ClientSession::handle(const CallService& request) {
  const auto fail = [this, service = request.service, call = request.call](const std::string& why) {
    sender_.send_text(service_failure(service, call, why));
  };
  try {
    refuse_without_control();
    if (request.encoding != "cdr") throw ProtocolError("the encoding is not cdr");
    const auto service = view_.find_service(request.service);
    if (!service) throw ProtocolError("unknown service " + std::to_string(request.service));
    const auto* const type = interfaces::find_message_type(service->type_name + "_Request");
    if (!type) throw ProtocolError("the type " + service->type_name + " is unknown");
    type->deserialize(request.payload);  // throws if it is not such a request
    const interfaces::Bytes bytes(request.payload.begin(), request.payload.end());
    slow_requests_.add([this, fail, service = *service, id = request.service, call = request.call, bytes] {
      try {
        const auto response = view_.topics().call(service, bytes, kServiceLimit);
        if (!response) throw ProtocolError("no response from " + service.name);
        auto frame = service_response_head(id, call);
        frame.insert(frame.end(), response->begin(), response->end());
        sender_.send_binary(std::move(frame));
      } catch (const std::exception& error) {
        fail(error.what());
      }
    });
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void ClientSession::tell(const ServiceTable::Change& change) {
  if (!change.removed.empty()) sender_.send_text(unadvertise_services(change.removed));
  if (!change.added.empty()) sender_.send_text(advertise_services(change.added, notation_));
}

void ClientSession::handle(const WatchConnectionGraph& request) {
  {
    const std::lock_guard lock(mutex_);
    wants_graph_ = request.is_on;
    told_graph_ = {};
  }
  if (request.is_on) tell(connection_graph_of(view_.topics().nodes()));
}

void ClientSession::handle(const ControlPlayback& request) {
  refuse_without_control();
  control(view_.playback(), request);
  const bool is_moved = request.seek_ns.has_value();
  {
    const std::lock_guard lock(mutex_);
    const auto state = state_of(view_.playback());
    if (!state) throw ProtocolError("the player has ended");
    told_playback_ = state;
    sender_.send_binary(playback_frame(*state, is_moved, request.id));
  }
  if (is_moved) view_.tell_playback(this);
}

bool ClientSession::wants_graph() const {
  const std::lock_guard lock(mutex_);
  return wants_graph_;
}

void ClientSession::tell(const ConnectionGraph& graph) {
  const std::lock_guard lock(mutex_);
  if (!wants_graph_ || graph == told_graph_) return;
  sender_.send_text(connection_graph_update(told_graph_, graph));
  told_graph_ = graph;
}

void ClientSession::handle(const FetchAsset& request) {
  try {
    sender_.send_binary(asset_frame(request.request, read_asset(view_.settings().assets, request.uri)));
  } catch (const std::exception& error) {
    sender_.send_binary(asset_failure(request.request, error.what()));
  }
}

}  // namespace panvo::web_view
