// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/calibration_files/file_error.hpp"

namespace panvo::calibration_files::test {

/// The message of the FileError that `read` throws; "accepted" without one.
template <class Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

/// `text` with its first `part` replaced.
inline std::string with(std::string text, const std::string& part, const std::string& instead) {
  return text.replace(text.find(part), part.size(), instead);
}

}  // namespace panvo::calibration_files::test
