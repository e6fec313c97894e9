// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace panvo::fleet {

/// FNV-1a with a final mix, over the bytes of numbers and texts; equal on all computers of one byte order.
class Hash {
 public:
  Hash& add(const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ static_cast<const unsigned char*>(bytes)[i]) * kPrime;
    return *this;
  }
  template <class Number>
  Hash& add(const Number& number) {
    static_assert(std::is_arithmetic_v<Number>);
    return add(&number, sizeof number);
  }
  Hash& add(std::string_view text) { return add(text.data(), text.size()).add(text.size()); }

  std::uint64_t value() const {
    std::uint64_t mixed = value_;
    mixed = (mixed ^ (mixed >> 33)) * 0xff51afd7ed558ccdULL;
    mixed = (mixed ^ (mixed >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return mixed ^ (mixed >> 33);
  }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace panvo::fleet
