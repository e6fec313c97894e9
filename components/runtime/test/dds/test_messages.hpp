// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/test_domain.hpp"

namespace panvo::runtime::test {

/// Long past what anything here takes on a busy machine; reached only by what is broken.
inline constexpr std::chrono::seconds kLimit{30};

/// A topic name no other test has.
std::string unique_topic(const std::string& name);

/// A topic of the named type; with `type` set where the type is known.
TopicDescription topic(const std::string& name, const std::string& type_name, interfaces::Qos qos = {});

/// An image of `size` pixel bytes, a multiple of four, that follow from `seed`.
SamplePtr image_sample(std::size_t size, std::uint32_t seed);

/// A std_msgs/msg/String. Fast DDS sends a multiple of four bytes and fills up with zeros: three letters (or
/// seven) arrive as they are.
SamplePtr text_sample(const std::string& text);

/// FNV-1a, to compare messages across processes.
std::uint64_t hash(std::span<const std::uint8_t> bytes);

}  // namespace panvo::runtime::test
