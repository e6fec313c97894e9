// SPDX-License-Identifier: Apache-2.0
#include "player_services.hpp"

#include "rosbag2_services.hpp"

namespace panvo::recorder {

using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses

void offer_player_services(runtime::Context& context) {
  runtime::Playback& playback = context.playback();
  context.serve(services::kPause, [&playback](const Pause_Request&) {
    playback.pause();
    return Pause_Response();
  });
  context.serve(services::kResume, [&playback](const Resume_Request&) {
    playback.resume();
    return Resume_Response();
  });
  context.serve(services::kTogglePaused, [&playback](const TogglePaused_Request&) {
    playback.is_paused() ? playback.resume() : playback.pause();
    return TogglePaused_Response();
  });
  context.serve(services::kIsPaused, [&playback](const IsPaused_Request&) {
    IsPaused_Response response;
    response.paused(playback.is_paused());
    return response;
  });
  context.serve(services::kGetRate, [&playback](const GetRate_Request&) {
    GetRate_Response response;
    response.rate(playback.rate());
    return response;
  });
  context.serve(services::kSetRate, [&playback](const SetRate_Request& request) {
    SetRate_Response response;
    response.success(playback.set_rate(request.rate()));
    return response;
  });
  context.serve(services::kSeek, [&playback](const Seek_Request& request) {
    Seek_Response response;
    response.success(playback.seek(std::int64_t{request.time().sec()} * 1'000'000'000 + request.time().nanosec()));
    return response;
  });
}

}  // namespace panvo::recorder
