// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {

/// The result of `read()`, a call of a reader of data sets, whose errors (file, line, remedy) are thrown as InputError.
template <class Read>
auto of_data_set(const Read& read) {
  try {
    return read();
  } catch (const dataset_player::DatasetError& error) {
    throw InputError(error.what());
  }
}

}  // namespace panvo::evaluation
