// SPDX-License-Identifier: Apache-2.0
#include "player_services.hpp"

#include <utility>

#include "rosbag2_interfaces/srv/GetRate.h"
#include "rosbag2_interfaces/srv/IsPaused.h"
#include "rosbag2_interfaces/srv/Pause.h"
#include "rosbag2_interfaces/srv/Resume.h"
#include "rosbag2_interfaces/srv/Seek.h"
#include "rosbag2_interfaces/srv/SetRate.h"
#include "rosbag2_interfaces/srv/TogglePaused.h"

namespace panvo::recorder {
namespace {

using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses
using interfaces::Service;

constexpr Service<Pause_Request, Pause_Response> kPause{"~/pause"};
constexpr Service<Resume_Request, Resume_Response> kResume{"~/resume"};
constexpr Service<TogglePaused_Request, TogglePaused_Response> kTogglePaused{"~/toggle_paused"};
constexpr Service<IsPaused_Request, IsPaused_Response> kIsPaused{"~/is_paused"};
constexpr Service<GetRate_Request, GetRate_Response> kGetRate{"~/get_rate"};
constexpr Service<SetRate_Request, SetRate_Response> kSetRate{"~/set_rate"};
constexpr Service<Seek_Request, Seek_Response> kSeek{"~/seek"};

}  // namespace

void offer_player_services(runtime::Context& context, std::function<bool(std::int64_t)> seek) {
  runtime::Playback& playback = context.playback();
  context.serve(kPause, [&playback](const Pause_Request&) {
    playback.pause();
    return Pause_Response();
  });
  context.serve(kResume, [&playback](const Resume_Request&) {
    playback.resume();
    return Resume_Response();
  });
  context.serve(kTogglePaused, [&playback](const TogglePaused_Request&) {
    playback.is_paused() ? playback.resume() : playback.pause();
    return TogglePaused_Response();
  });
  context.serve(kIsPaused, [&playback](const IsPaused_Request&) {
    IsPaused_Response response;
    response.paused(playback.is_paused());
    return response;
  });
  context.serve(kGetRate, [&playback](const GetRate_Request&) {
    GetRate_Response response;
    response.rate(playback.rate());
    return response;
  });
  context.serve(kSetRate, [&playback](const SetRate_Request& request) {
    SetRate_Response response;
    response.success(playback.set_rate(request.rate()));
    return response;
  });
  context.serve(kSeek, [seek = std::move(seek)](const Seek_Request& request) {
    Seek_Response response;
    response.success(seek(std::int64_t{request.time().sec()} * 1'000'000'000 + request.time().nanosec()));
    return response;
  });
}

}  // namespace panvo::recorder
