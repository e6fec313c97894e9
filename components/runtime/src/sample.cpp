// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/sample.hpp"

#include <algorithm>
#include <utility>

namespace panvo::runtime {

SamplePtr Sample::of(const MessageType& type, std::shared_ptr<const void> message, std::int64_t time_ns,
                     std::shared_ptr<const void> keep_alive, Sender sender) {
  std::shared_ptr<Sample> sample(new Sample);
  sample->keep_alive_ = std::move(keep_alive);
  sample->type_ = &type;
  sample->type_name_ = type.name;
  sample->time_ns_ = time_ns;
  sample->message_ = std::move(message);
  sample->sender_ = std::move(sender);
  return sample;
}

SamplePtr Sample::from_bytes(const MessageType* type, std::string type_name, Bytes bytes, std::int64_t time_ns,
                             Sender sender) {
  std::shared_ptr<Sample> sample(new Sample);
  sample->type_ = type;
  sample->type_name_ = std::move(type_name);
  sample->time_ns_ = time_ns;
  sample->received_size_ = bytes.size();
  sample->bytes_ = std::move(bytes);
  sample->sender_ = std::move(sender);
  return sample;
}

SamplePtr Sample::stored(Read read) const {
  std::shared_ptr<Sample> sample(new Sample);
  sample->keep_alive_ = keep_alive_;
  sample->type_ = type_;
  sample->type_name_ = type_name_;
  sample->time_ns_ = time_ns_;
  sample->received_size_ = received_size_;
  sample->sender_ = sender_;
  sample->stamp_ns_ = stamp_ns();
  sample->read_ = std::move(read);
  return sample;
}

SamplePtr Sample::unread(const SamplePtr& sample) { return sample->read_ ? sample->stored(sample->read_) : sample; }

const std::string& Sample::sender() const noexcept {
  static const std::string kNobody;
  return sender_ ? *sender_ : kNobody;
}

std::int64_t Sample::stamp_ns() const {
  if (stamp_ns_) return *stamp_ns_;
  const void* const read = type_ ? message() : nullptr;
  return read ? type_->stamp_ns(read).value_or(time_ns_) : time_ns_;
}

/// With the mutex locked.
void Sample::read_stored() const {
  if (read_ && !message_ && bytes_.empty()) bytes_ = read_();
}

const void* Sample::message() const {
  const std::lock_guard lock(mutex_);
  read_stored();
  if (!message_ && type_) message_ = type_->deserialize(bytes_);
  return message_.get();
}

const Sample::Bytes& Sample::bytes() const {
  const std::lock_guard lock(mutex_);
  read_stored();
  if (bytes_.empty() && message_) {
    Bytes bytes(type_->serialized_size(message_.get()));
    type_->serialize(message_.get(), bytes);
    bytes_ = std::move(bytes);
  }
  return bytes_;
}

std::size_t Sample::serialized_size() const {
  const std::lock_guard lock(mutex_);
  read_stored();
  return bytes_.empty() && message_ ? type_->serialized_size(message_.get()) : bytes_.size();
}

void Sample::serialize_to(std::span<std::uint8_t> out) const {
  const std::lock_guard lock(mutex_);
  read_stored();
  if (bytes_.empty() && message_) {
    type_->serialize(message_.get(), out);
  } else {
    std::ranges::copy(bytes_, out.begin());
  }
}

}  // namespace panvo::runtime
