// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/recorder/bag_writer.hpp"

namespace panvo::recorder::fuzz {

/// A bag's file as our writer makes it: `messages` on a topic, a quarter as many on another of another kind. Without
/// `details` the topics have no definition and no quality of service, whose YAML would take most of the time to read.
std::string written(const BagWriter::Options& options, std::uint64_t messages, bool details = true);

/// Of every kind of a storage, so small that thousands can be read in a second.
std::vector<std::string> seeds(Storage storage);

/// Of libFuzzer's command line: puts the seeds into the first folder named there, if that is empty.
void plant_seeds(Storage storage, int argc, char** argv);

}  // namespace panvo::recorder::fuzz
