// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/runtime/context.hpp"

namespace panvo::recorder {

/// Offers the services of rosbag2's player that control playing: `~/pause`, `~/resume`, `~/toggle_paused`,
/// `~/is_paused`, `~/get_rate`, `~/set_rate` and `~/seek`.
void offer_player_services(runtime::Context& context);

}  // namespace panvo::recorder
