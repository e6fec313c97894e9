// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "layout.hpp"

namespace panvo::recorder::mcap {

/// Holds a file's summary against what is in the file: every chunk and its checksum, the index behind it, and the
/// counts. What disagrees, without the file's name. Of a file without a summary nothing: its scan has told all.
std::vector<std::string> check(const InputFile& file, const Layout& layout);

}  // namespace panvo::recorder::mcap
