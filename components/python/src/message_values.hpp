// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <memory>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::python {

namespace py = pybind11;

/// A serialised message as a dict of its members: bool, int, float, str, dict for nested messages, NumPy arrays for
/// arrays and sequences of numbers, lists for those of texts and messages. Arrays of bytes (images) are read-only views
/// of `bytes`; others are copies. Throws DecodeError.
py::dict message_values(const interfaces::MessageType& type, const std::shared_ptr<const interfaces::Bytes>& bytes);

}  // namespace panvo::python
