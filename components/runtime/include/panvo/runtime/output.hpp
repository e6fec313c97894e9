// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// A topic that a component publishes, whatever its type.
class UntypedOutput {
 public:
  virtual ~UntypedOutput() = default;
  /// Hands the message to every reader in this process by pointer, and to the bridge.
  virtual void publish(std::shared_ptr<const void> message) = 0;
  /// The same for a message that is there as bytes only.
  virtual void publish(interfaces::Bytes bytes) = 0;
};

/// A topic that a component publishes. A published message belongs to its readers: it must not be changed any more.
template <class Message>
class Output {
 public:
  explicit Output(std::shared_ptr<UntypedOutput> output) : output_(std::move(output)) {}

  void publish(std::shared_ptr<const Message> message) {
    output_->publish(std::shared_ptr<const void>(std::move(message)));
  }
  void publish(Message message) { publish(std::make_shared<const Message>(std::move(message))); }

 private:
  std::shared_ptr<UntypedOutput> output_;
};

}  // namespace panvo::runtime
