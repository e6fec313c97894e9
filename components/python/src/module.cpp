// SPDX-License-Identifier: Apache-2.0
#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace panvo::python;
  module.doc() = "The compiled part of panvo.";
  module.attr("__version__") = PANVO_VERSION;
  bind_errors(module);
  bind_calibration(module);
  bind_odometry(module);
  bind_recording(module);
  bind_compass(module);
  bind_places(module);
  bind_bag(module);
  bind_evaluation(module);
}
