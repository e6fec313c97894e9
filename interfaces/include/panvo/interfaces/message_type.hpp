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

/// A serialised message as it goes over the wire and into a bag: XCDR1, led by its 4-byte encapsulation header.
using Bytes = std::vector<std::uint8_t>;

/// Thrown by MessageType::deserialize on bytes that are not a message of its type.
class DecodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CdrLayout;

/// What is needed to carry, store and read messages of a type without knowing their C++ class. The instances live in libraries that are never
/// unloaded, so references to them stay valid.
struct MessageType {
  std::string_view name;        ///< as ROS 2 tools and bags print it: "nav_msgs/msg/Odometry"
  std::string_view dds_name;    ///< as it is matched on the wire: "nav_msgs::msg::dds_::Odometry_"
  std::string_view hash;        ///< ROS 2 type description hash: "RIHS01_" and 64 hexadecimal digits
  std::string_view definition;  ///< the type and all it contains in ROS 2's .msg notation ("ros2msg")
  const CdrLayout* layout;      ///< the members, see message_layout.hpp
  const std::type_info* cpp_type;

  std::size_t (*serialized_size)(const void* message);
  /// Writes exactly serialized_size(message) bytes, encapsulation included.
  void (*serialize)(const void* message, std::span<std::uint8_t> out);
  /// A new message; throws DecodeError. Either byte order is read.
  std::shared_ptr<void> (*deserialize)(std::span<const std::uint8_t> bytes);
  /// The stamp of the message's header in ns; nullopt for a type without one.
  std::optional<std::int64_t> (*stamp_ns)(const void* message);
  /// Whether that is about the time at which the message is sent, see validity.hpp.
  bool is_stamped_when_sent;
  /// What is wrong with a message by the rules of its type, see validity.hpp; nullptr: the type has no rules.
  std::optional<std::string> (*problem)(const void* message);
};

/// Whether the stamps of a type's messages are of about the time at which they are sent, so that a stamp far from its neighbours is wrong. Types for
/// which this is not so specialise it.
template <class Message>
inline constexpr bool kIsStampedWhenSent = true;

/// The type of a generated message class: message_type<nav_msgs::msg::Odometry>(). Defined in the library of the message's package.
template <class Message>
const MessageType& message_type();

/// The hash of a message's definition as the including file was compiled with it (kValue). Specialised in the header of each message.
template <class Message>
struct CompiledHash;

/// The type of that ROS 2 name ("nav_msgs/msg/Odometry"), or nullptr. A package that is not loaded yet is loaded: the library lib<package>__panvo.so that
/// panvo_generate_interfaces() makes, from one of message_folders().
const MessageType* find_message_type(std::string_view name);

/// Why find_message_type(name) gives nothing, with the remedy, to be shown after the name: "is not a type name; ...".
std::string why_unknown(std::string_view name);

/// The types of all libraries that are loaded, sorted by name.
std::vector<const MessageType*> message_types();

}  // namespace panvo::interfaces
