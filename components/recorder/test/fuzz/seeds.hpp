// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/recorder/bag_writer.hpp"

namespace panvo::recorder::fuzz {

/// A bag file of our writer with `messages` messages on one topic and a quarter as many on a topic of another type.
/// Without `details` the topics have no definition and no quality of service, whose YAML dominates the reading time.
std::string written(const BagWriter::Options& options, std::uint64_t messages, bool details = true);

/// Bag files of every kind of a storage, small enough to read thousands per second.
std::vector<std::string> seeds(Storage storage);

/// Writes the seeds to the first folder on libFuzzer's command line, if it is empty.
void plant_seeds(Storage storage, int argc, char** argv);

}  // namespace panvo::recorder::fuzz
