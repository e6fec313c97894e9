// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace panvo::conversions {

/// Why there is no result: a sentence without its subject ("holds 10 bytes where ... need 30"), to be logged after the
/// topic name.
struct Reason {
  std::string text;
};

/// The converted message, or the reason why it cannot be used.
template <class Value>
class Result {
 public:
  Result(Value value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): `return value;`
  Result(Reason reason)
      : reason_(std::move(reason.text)) {}  // NOLINT(google-explicit-constructor): `return Reason{...};`

  explicit operator bool() const noexcept { return value_.has_value(); }
  /// Throws std::bad_optional_access if there is no value.
  const Value& operator*() const { return value_.value(); }
  const Value* operator->() const { return &value_.value(); }

  /// Empty if there is a value.
  const std::string& reason() const noexcept { return reason_; }

 private:
  std::optional<Value> value_;
  std::string reason_;
};

}  // namespace panvo::conversions
