// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

namespace panvo::interfaces {

/// A serialised message as sent over the network and stored in bags: a 4-byte encapsulation header and XCDR1.
using Bytes = std::vector<std::uint8_t>;

/// Thrown by MessageType::deserialize for bytes that are not a message of its type.
class DecodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CdrLayout;

/// Handles messages of one type without their C++ class: sends, stores and reads them. The instances are in libraries
/// that are never unloaded, so references to them stay valid.
struct MessageType {
  std::string_view name;        ///< name in ROS 2 tools and bags: "nav_msgs/msg/Odometry"
  std::string_view dds_name;    ///< name in DDS: "nav_msgs::msg::dds_::Odometry_"
  std::string_view hash;        ///< ROS 2 type description hash: "RIHS01_" and 64 hexadecimal digits
  std::string_view definition;  ///< of the type and all nested types in ROS 2's .msg notation ("ros2msg")
  const CdrLayout* layout;      ///< of the members, see message_layout.hpp
  const std::type_info* cpp_type;

  /// Bytes, encapsulation included.
  std::size_t (*serialized_size)(const void* message);
  /// Writes exactly serialized_size(message) bytes.
  void (*serialize)(const void* message, std::span<std::uint8_t> out);
  /// Returns a new message. Reads both byte orders. Throws DecodeError.
  std::shared_ptr<void> (*deserialize)(std::span<const std::uint8_t> bytes);
  /// Stamp of the message, ns; nullopt if it has none.
  std::optional<std::int64_t> (*stamp_ns)(const void* message);
  /// See kIsStampedWhenSent.
  bool is_stamped_when_sent;
  /// Returns the first rule that a message violates, see validity.hpp; nullopt: none. The pointer is nullptr if the
  /// type has no rules.
  std::optional<std::string> (*problem)(const void* message);
};

/// Whether messages of this type are stamped close to the time of sending, so that a stamp far from its neighbours is
/// an error. Specialised for types where this does not hold.
template <class Message>
inline constexpr bool kIsStampedWhenSent = true;

/// The type of a generated message class: message_type<nav_msgs::msg::Odometry>(). Defined in the message library of
/// the package.
template <class Message>
const MessageType& message_type();

/// Type hash (kValue) that the including file was compiled with. Specialised in the header of each message.
template <class Message>
struct CompiledHash;

/// The type with a ROS 2 name ("nav_msgs/msg/Odometry"), or nullptr. Loads the library of the package if necessary:
/// lib<package>__panvo.so, built by panvo_generate_interfaces(), from message_folders().
const MessageType* find_message_type(std::string_view name);

/// Why find_message_type(name) returned nullptr, and the remedy. To be shown after the name: "is not a type name; ...".
std::string why_unknown(std::string_view name);

/// Types of all loaded libraries, sorted by name.
std::vector<const MessageType*> message_types();

}  // namespace panvo::interfaces
