// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "panvo/conversions/odometry_join.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::conversions {

/// Subscribes a component to odometry/binocular and odometry/quality and calls `handle` with each odometry message and
/// its quality. Create it in the component's constructor; it calls on the component's message thread.
class OdometryListener {
 public:
  using Handler = std::function<void(const OdometryJoin::Joined&)>;

  OdometryListener(runtime::Context& context, Handler handle);
  OdometryListener(const OdometryListener&) = delete;
  OdometryListener& operator=(const OdometryListener&) = delete;

 private:
  void handle_joined();

  runtime::Context& context_;
  const Handler handle_;
  OdometryJoin join_;
};

}  // namespace panvo::conversions
