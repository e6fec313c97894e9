// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/odometry_listener.hpp"

#include <chrono>
#include <utility>

#include "panvo/interfaces/topics.hpp"

namespace panvo::conversions {

OdometryListener::OdometryListener(runtime::Context& context, Handler handle)
    : context_(context), handle_(std::move(handle)) {
  context.input(topics::kOdometryQuality, [this](const auto& message) {
    join_.add(*message);
    handle_joined();
  });
  context.input(topics::kOdometryBinocular, [this](const auto& message) {
    join_.add(message, context_.passing_ns());
    handle_joined();
  });
  context.every(std::chrono::milliseconds(100), [this] { handle_joined(); });  // those whose quality never comes
}

void OdometryListener::handle_joined() {
  const bool is_quality_published = join_.has_quality() || context_.has_publisher(topics::kOdometryQuality);
  while (const auto next = join_.next(context_.passing_ns(), is_quality_published)) {
    if (next->lacks_quality) {
      context_.log().warn_throttled("no quality", "{} has no {} with the same stamp: only its covariance is used",
                                    context_.resolved_name(topics::kOdometryBinocular),
                                    context_.resolved_name(topics::kOdometryQuality));
    }
    handle_(*next);
  }
}

}  // namespace panvo::conversions
