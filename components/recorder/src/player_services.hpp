// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "panvo/runtime/context.hpp"

namespace panvo::recorder {

/// Offers the services of rosbag2's player that control playing: `~/pause`, `~/resume`, `~/toggle_paused`,
/// `~/is_paused`, `~/get_rate`, `~/set_rate` and `~/seek`. `seek` is called with a time of the bag, ns, on the component's
/// message thread; it returns false if it cannot move.
void offer_player_services(runtime::Context& context, std::function<bool(std::int64_t)> seek);

}  // namespace panvo::recorder
