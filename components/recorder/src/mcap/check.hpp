// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "layout.hpp"

namespace panvo::recorder::mcap {

/// Compares a file's summary with its content: every chunk, its checksum and index, and the counts. Returns the
/// differences, without the file's name. Returns nothing for a file without a summary, since scan() has reported its
/// faults.
std::vector<std::string> check(const InputFile& file, const Layout& layout);

}  // namespace panvo::recorder::mcap
