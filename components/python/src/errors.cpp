// SPDX-License-Identifier: Apache-2.0
#include "bindings.hpp"
#include "panvo/calibration_files/file_error.hpp"
#include "panvo/dataset_player/dataset.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_error.hpp"

namespace panvo::python {

void bind_errors(py::module_& module) {
  py::exception<void> base(module, "Error", PyExc_RuntimeError);
  base.doc() = "Unusable data; the base of panvo's exceptions. The text names file, problem and remedy.";
  // Later registrations are asked first; none of these types derives from another.
  py::register_exception<calibration_files::FileError>(module, "CalibrationError", base).doc() =
      "A calibration file that cannot be used.";
  py::register_exception<dataset_player::DatasetError>(module, "RecordingError", base).doc() =
      "A data set or bag that does not hold usable images.";
  py::register_exception<recorder::BagError>(module, "BagError", base).doc() = "A bag that cannot be read.";
  py::register_exception<interfaces::DecodeError>(module, "DecodeError", base).doc() =
      "A message that is not of its type, or whose type is unknown.";
  py::register_exception<evaluation::InputError>(module, "EvaluationError", base).doc() =
      "Trajectories that cannot be read or compared.";
}

}  // namespace panvo::python
