// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime {

class Sample;
using SamplePtr = std::shared_ptr<const Sample>;

/// A message in transit: as object, as bytes, or both; or stored elsewhere. The missing form is created on demand and
/// shared, so a message is serialised at most once for any number of remote readers and recorders. Immutable to users;
/// thread-safe.
class Sample {
 public:
  using Bytes = interfaces::Bytes;
  using MessageType = interfaces::MessageType;

  /// Publisher of a message: the component of this process, or the GID of a remote writer.
  using Sender = std::shared_ptr<const std::string>;

  /// A message published in this process. `keep_alive` (the plugin with the message's code) is held until the message
  /// is destroyed.
  static SamplePtr of(const MessageType& type, std::shared_ptr<const void> message, std::int64_t time_ns,
                      std::shared_ptr<const void> keep_alive = nullptr, Sender sender = nullptr);

  /// A message received as bytes. `type` is nullptr if the type is unknown here; the message can still be recorded and
  /// forwarded.
  static SamplePtr from_bytes(const MessageType* type, std::string type_name, Bytes bytes, std::int64_t time_ns,
                              Sender sender = nullptr);

  /// Reads the bytes of a stored message. Throws interfaces::DecodeError if they can no longer be read.
  using Read = std::function<Bytes()>;

  /// This message, stored: its bytes are read when message() or bytes() is called first, and kept by the result.
  SamplePtr stored(Read read) const;

  /// A sample of the same stored message that is not read yet, for a user of its own; `sample` itself if it is not
  /// stored.
  static SamplePtr unread(const SamplePtr& sample);

  const MessageType* type() const noexcept { return type_; }
  const std::string& type_name() const noexcept { return type_name_; }  ///< "nav_msgs/msg/Odometry"

  /// Empty: unknown.
  const std::string& sender() const noexcept;
  /// Size of the received bytes; 0 if the message was published as an object.
  std::size_t received_size() const noexcept { return received_size_; }

  /// Time of publication or reception, ns: system clock (live) or replay time.
  std::int64_t time_ns() const noexcept { return time_ns_; }

  /// Stamp of the header, ns; time_ns() for messages without one, and of unknown types.
  std::int64_t stamp_ns() const;

  /// The message, deserialised at the first call. Throws interfaces::DecodeError; nullptr if the type is unknown.
  const void* message() const;

  /// The serialised message with encapsulation, created at the first call.
  const Bytes& bytes() const;

  /// Serialises into caller-owned memory of serialized_size() bytes, or copies bytes() if they exist.
  std::size_t serialized_size() const;
  void serialize_to(std::span<std::uint8_t> out) const;

  /// The message as `Message`, sharing ownership with `sample`: no copy, and its plugin stays loaded. The type must
  /// match.
  template <class Message>
  static std::shared_ptr<const Message> as(const SamplePtr& sample) {
    return {sample, static_cast<const Message*>(sample->message())};
  }

  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

 private:
  Sample() = default;
  void read_stored() const;

  std::shared_ptr<const void> keep_alive_;  // first, so it is destroyed last
  const MessageType* type_ = nullptr;
  std::string type_name_;
  std::int64_t time_ns_ = 0;
  Sender sender_;
  std::size_t received_size_ = 0;
  Read read_;                               // of a stored message; else empty
  std::optional<std::int64_t> stamp_ns_{};  // of a stored message
  mutable std::mutex mutex_;                // guards creation of the missing form
  mutable std::shared_ptr<const void> message_;
  mutable Bytes bytes_;
};

}  // namespace panvo::runtime
