// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "panvo/runtime/context.hpp"

namespace panvo::recorder {

/// What the services of a recorder do. All are called on the component's message thread.
struct RecorderControl {
  std::function<void(bool)> set_paused;
  std::function<bool()> is_paused;
  std::function<void()> split;
};

/// Offers the services of rosbag2's recorder: `~/pause`, `~/resume`, `~/is_paused` and `~/split_bagfile`.
void offer_recorder_services(runtime::Context& context, RecorderControl control);

}  // namespace panvo::recorder
