// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "panvo/runtime/sample.hpp"

namespace panvo::runtime {

/// Type-erased publisher of a component.
class UntypedOutput {
 public:
  virtual ~UntypedOutput() = default;
  /// Passes the message by pointer to all readers in this process, and to the bridge.
  virtual void publish(std::shared_ptr<const void> message) = 0;
  /// The same for a serialised message.
  virtual void publish(interfaces::Bytes bytes) = 0;
};

/// Publisher of a component. A message must not be modified after publishing.
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
