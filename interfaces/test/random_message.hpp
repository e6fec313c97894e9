// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "cdr_layout.hpp"

namespace panvo::interfaces {

/// Writes messages with random content from their layout alone, independently of the generated classes.
class RandomMessage {
 public:
  /// The content depends on the seed only, not on the byte order.
  RandomMessage(std::endian order, unsigned seed) : order_(order), random_(seed) {
    bytes_ = {0, static_cast<std::uint8_t>(order == std::endian::little ? 1 : 0), 0, 0};
  }

  void message(const CdrLayout& layout) {
    for (const CdrField& field : layout.fields) {
      const std::uint32_t count = field.is_sequence ? random_() % 4 : field.array_size;
      if (field.is_sequence) {
        number(count, 4);
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        element(field);
      }
    }
  }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void element(const CdrField& field) {
    if (field.nested != nullptr) {
      message(*field.nested);
    } else if (field.is_string) {
      text();
    } else if (field.size == 1) {
      number(random_() % 2, 1);  // a boolean must be 0 or 1
    } else {
      number(std::uint64_t{random_()} << 32 | random_(), field.size);
    }
  }

  void text() {
    const std::uint32_t length = random_() % 12;
    number(length + 1, 4);
    for (std::uint32_t i = 0; i < length; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>('a' + random_() % 26));
    }
    bytes_.push_back(0);
  }

  void number(std::uint64_t value, std::size_t size) {
    constexpr std::size_t kHeader = 4;  // alignment is relative to the end of the encapsulation header
    while ((bytes_.size() - kHeader) % size != 0) {
      bytes_.push_back(0);
    }
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t shift = order_ == std::endian::little ? i : size - 1 - i;
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * shift)));
    }
  }

  std::endian order_;
  std::mt19937 random_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace panvo::interfaces
