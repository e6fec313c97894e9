// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/service.hpp"
#include "rosbag2_interfaces/srv/GetRate.h"
#include "rosbag2_interfaces/srv/IsPaused.h"
#include "rosbag2_interfaces/srv/Pause.h"
#include "rosbag2_interfaces/srv/Resume.h"
#include "rosbag2_interfaces/srv/Seek.h"
#include "rosbag2_interfaces/srv/SetRate.h"
#include "rosbag2_interfaces/srv/SplitBagfile.h"
#include "rosbag2_interfaces/srv/TogglePaused.h"

/// The services of rosbag2's player and recorder that are offered here.
namespace panvo::recorder::services {

using interfaces::Service;
using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses

inline constexpr Service<Pause_Request, Pause_Response> kPause{"~/pause"};
inline constexpr Service<Resume_Request, Resume_Response> kResume{"~/resume"};
inline constexpr Service<TogglePaused_Request, TogglePaused_Response> kTogglePaused{"~/toggle_paused"};
inline constexpr Service<IsPaused_Request, IsPaused_Response> kIsPaused{"~/is_paused"};
inline constexpr Service<GetRate_Request, GetRate_Response> kGetRate{"~/get_rate"};
inline constexpr Service<SetRate_Request, SetRate_Response> kSetRate{"~/set_rate"};
inline constexpr Service<Seek_Request, Seek_Response> kSeek{"~/seek"};
inline constexpr Service<SplitBagfile_Request, SplitBagfile_Response> kSplitBagfile{"~/split_bagfile"};

}  // namespace panvo::recorder::services
