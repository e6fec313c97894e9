// SPDX-License-Identifier: Apache-2.0
// Used in builds without panvo_runtime.
#include "live_images.hpp"
#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {

void gather_images(const LiveImages&, const Board&) {
  throw CalibrationError(
      "--topics: this program was built without panvo_runtime; rebuild with it, or calibrate from IMAGES");
}

}  // namespace panvo::calibration
