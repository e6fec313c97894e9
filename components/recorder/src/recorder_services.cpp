// SPDX-License-Identifier: Apache-2.0
#include "recorder_services.hpp"

#include <memory>
#include <utility>

#include "rosbag2_services.hpp"

namespace panvo::recorder {

using namespace rosbag2_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses

void offer_recorder_services(runtime::Context& context, RecorderControl control) {
  const auto shared = std::make_shared<const RecorderControl>(std::move(control));
  context.serve(services::kPause, [shared](const Pause_Request&) {
    shared->set_paused(true);
    return Pause_Response();
  });
  context.serve(services::kResume, [shared](const Resume_Request&) {
    shared->set_paused(false);
    return Resume_Response();
  });
  context.serve(services::kIsPaused, [shared](const IsPaused_Request&) {
    IsPaused_Response response;
    response.paused(shared->is_paused());
    return response;
  });
  context.serve(services::kSplitBagfile, [shared](const SplitBagfile_Request&) {
    shared->split();
    return SplitBagfile_Response();
  });
}

}  // namespace panvo::recorder
