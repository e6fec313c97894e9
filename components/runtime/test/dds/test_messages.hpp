// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/test_domain.hpp"

namespace panvo::runtime::test {

/// Much longer than anything here takes on a busy machine; reached only on failure.
inline constexpr std::chrono::seconds kLimit{30};

/// A topic name that no other test uses.
std::string unique_topic(const std::string& name);

/// A topic of the named type, with `type` set if the type is known.
TopicDescription topic(const std::string& name, const std::string& type_name, interfaces::Qos qos = {});

/// An image of `size` pixel bytes, a multiple of four, derived from `seed`.
SamplePtr image_sample(std::size_t size, std::uint32_t seed);

/// A std_msgs/msg/String. Fast DDS pads to a multiple of four bytes with zeros; texts of three or seven letters arrive
/// unchanged.
SamplePtr text_sample(const std::string& text);

/// FNV-1a, to compare messages across processes.
std::uint64_t hash(std::span<const std::uint8_t> bytes);

}  // namespace panvo::runtime::test
