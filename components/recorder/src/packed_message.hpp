// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/message_type.hpp"

namespace panvo::recorder {

/// rosbag2 can compress messages one by one (zstd). Unpacks `data` if it is such a message: the first bytes tell, for
/// no CDR begins like that. False: it is one, but damaged.
bool unpack_message(interfaces::Bytes& data);

}  // namespace panvo::recorder
