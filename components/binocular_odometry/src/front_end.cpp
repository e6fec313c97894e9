// SPDX-License-Identifier: Apache-2.0
#include "front_end.hpp"

#include <stdexcept>

#include "klt_front_end.hpp"
#include "sift_front_end.hpp"

namespace panvo::binocular_odometry {

std::unique_ptr<FrontEnd> make_front_end(const TrackingParameters& parameters) {
  if (parameters.front_end == "klt") return std::make_unique<KltFrontEnd>(parameters);
  if (parameters.front_end == "sift") return std::make_unique<SiftFrontEnd>(parameters);
  throw std::invalid_argument("front_end is \"" + parameters.front_end + "\"; choose klt or sift");
}

}  // namespace panvo::binocular_odometry
