// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/message_type.hpp"

namespace panvo::recorder {

/// Decompresses `data` if it is a message that rosbag2 compressed (zstd). The zstd magic identifies it, since no CDR
/// starts with it. Returns false if the compressed message is damaged.
bool unpack_message(interfaces::Bytes& data);

}  // namespace panvo::recorder
