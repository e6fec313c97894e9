// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime {

class Sample;
using SamplePtr = std::shared_ptr<const Sample>;

/// A message on its way: the message itself, its bytes, or both. Whoever needs the other form gets it made once and shared: however many
/// remote readers and recorders there are, a message is serialised at most once, and not at all when nobody asks. Immutable to its
/// users; safe to use from several threads.
class Sample {
 public:
  using Bytes = interfaces::Bytes;
  using MessageType = interfaces::MessageType;

  /// Who published a message: the component of this process, or the gid of another one's writer.
  using Sender = std::shared_ptr<const std::string>;

  /// A message published in this process. `keep_alive` is held until the message is gone: the plugin whose code made the message.
  static SamplePtr of(const MessageType& type, std::shared_ptr<const void> message, std::int64_t time_ns,
                      std::shared_ptr<const void> keep_alive = nullptr, Sender sender = nullptr);

  /// A message that came as bytes. `type` is nullptr for a type this process does not know; it can still be recorded and forwarded.
  static SamplePtr from_bytes(const MessageType* type, std::string type_name, Bytes bytes, std::int64_t time_ns,
                              Sender sender = nullptr);

  const MessageType* type() const noexcept { return type_; }
  const std::string& type_name() const noexcept { return type_name_; }  ///< "nav_msgs/msg/Odometry"

  /// Empty: not known.
  const std::string& sender() const noexcept;
  /// Of the bytes as which it came; 0: it came as a message.
  std::size_t received_size() const noexcept { return received_size_; }

  /// When it was published or received, ns: system clock live, time of the replay in replay.
  std::int64_t time_ns() const noexcept { return time_ns_; }

  /// The message; read from its bytes at the first call. Throws interfaces::DecodeError; nullptr if the type is not known.
  const void* message() const;

  /// The serialised message, encapsulation included; made at the first call.
  const Bytes& bytes() const;

  /// The same for who has memory of its own for them: a copy of bytes(), or without these being made. `out` is of serialized_size() bytes.
  std::size_t serialized_size() const;
  void serialize_to(std::span<std::uint8_t> out) const;

  /// `sample`'s message as `Message`, sharing its ownership: no copy, and what made it stays loaded. The type must be right.
  template <class Message>
  static std::shared_ptr<const Message> as(const SamplePtr& sample) {
    return {sample, static_cast<const Message*>(sample->message())};
  }

  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

 private:
  Sample() = default;

  std::shared_ptr<const void> keep_alive_;  // first, so that it goes last
  const MessageType* type_ = nullptr;
  std::string type_name_;
  std::int64_t time_ns_ = 0;
  Sender sender_;
  std::size_t received_size_ = 0;
  mutable std::mutex mutex_;  // guards the making of the missing form
  mutable std::shared_ptr<const void> message_;
  mutable Bytes bytes_;
};

}  // namespace panvo::runtime
