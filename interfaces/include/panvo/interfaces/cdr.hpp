// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "panvo/interfaces/message_type.hpp"

/// Plain CDR (XCDR1) [OMG DDS-XTypes 1.3, 7.4.1]: sizes, writes and reads the members of a message class, each by a
/// visitor. A number is aligned to its own size, from the beginning of the message; strings and sequences begin with
/// their length. Only for generated message tables.
namespace panvo::interfaces {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <class T>
inline constexpr bool kIsSequence = false;
template <class T>
inline constexpr bool kIsSequence<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t size>
inline constexpr bool kIsArray<std::array<T, size>> = true;

/// Walks over values of any type; `Archive` handles numbers, strings, and the length of a sequence.
template <class Archive>
class CdrVisitor {
 public:
  template <class T>
  void operator()(T& value) {
    using Value = std::remove_const_t<T>;
    if constexpr (std::is_arithmetic_v<Value>) {
      archive().numbers(&value, 1);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      archive().text(value);
    } else if constexpr (kIsSequence<Value>) {
      archive().length(value);
      elements(value);
    } else if constexpr (kIsArray<Value>) {
      elements(value);
    } else {
      Value::for_each_member(value, *this);
    }
  }

 private:
  template <class T>
  void elements(T& values) {
    using Element = typename T::value_type;
    if constexpr (std::is_same_v<std::remove_const_t<T>, std::vector<bool>>) {
      archive().bits(values);
    } else if constexpr (std::is_arithmetic_v<Element>) {
      archive().numbers(values.data(), values.size());
    } else {
      for (auto& value : values) (*this)(value);
    }
  }

  Archive& archive() { return static_cast<Archive&>(*this); }
};

/// Length of a text in CDR: up to its first NUL, which ends it.
inline std::size_t text_length(const std::string& text) { return ::strnlen(text.data(), text.size()); }

/// Bytes of a message without encapsulation.
class CdrSize : public CdrVisitor<CdrSize> {
 public:
  std::size_t value() const noexcept { return size_; }

  template <class T>
  void numbers(const T*, std::size_t count) {
    if (count > 0) size_ = (size_ + sizeof(T) - 1) / sizeof(T) * sizeof(T) + count * sizeof(T);
  }
  void bits(const std::vector<bool>& values) { size_ += values.size(); }
  void length(const auto&) { numbers<std::uint32_t>(nullptr, 1); }
  void text(const std::string& text) {
    length(text);
    size_ += text_length(text) + 1;
  }

 private:
  std::size_t size_ = 0;
};

/// Writes a message, little endian; padding is zero, so that equal messages have equal bytes. Throws std::length_error
/// if `out` is too short.
class CdrWriter : public CdrVisitor<CdrWriter> {
 public:
  explicit CdrWriter(std::span<std::uint8_t> out) : out_(out) {}
  /// Zeroes what is left of `out`.
  void finish();

  template <class T>
  void numbers(const T* values, std::size_t count) {
    if (count > 0) write(sizeof(T), values, count * sizeof(T));
  }
  void bits(const std::vector<bool>& values) {
    for (const bool value : values) numbers(&value, 1);
  }
  void length(const auto& values) { length_of(values.size()); }
  void text(const std::string& text);

 private:
  void length_of(std::size_t length);
  void write(std::size_t alignment, const void* bytes, std::size_t size);

  std::span<std::uint8_t> out_;
  std::size_t at_ = 0;
};

/// Reads a message in either byte order. Throws DecodeError if bytes are missing or a boolean is neither 0 nor 1. It
/// allocates memory for a length before it reads the elements, so the layout must have been checked.
class CdrReader : public CdrVisitor<CdrReader> {
 public:
  CdrReader(std::span<const std::uint8_t> bytes, std::endian order) : bytes_(bytes), order_(order) {}

  template <class T>
  void numbers(T* values, std::size_t count) {
    if (count == 0) return;
    const std::uint8_t* from = take(sizeof(T), count * sizeof(T));
    if constexpr (std::is_same_v<T, bool>) {
      for (std::size_t i = 0; i < count; ++i) values[i] = is_true(from[i]);
    } else {
      std::memcpy(values, from, count * sizeof(T));
      if constexpr (sizeof(T) > 1) {
        if (order_ != std::endian::native) swap_bytes(values, sizeof(T), count);
      }
    }
  }
  void bits(std::vector<bool>& values) {
    for (auto&& value : values) value = is_true(*take(1, 1));
  }
  void length(auto& values) { values.resize(read_length()); }
  void text(std::string& text);

 private:
  std::uint32_t read_length() {
    std::uint32_t length = 0;
    numbers(&length, 1);
    return length;
  }
  const std::uint8_t* take(std::size_t alignment, std::size_t size);
  static bool is_true(std::uint8_t byte);
  static void swap_bytes(void* values, std::size_t size, std::size_t count);

  std::span<const std::uint8_t> bytes_;
  std::endian order_;
  std::size_t at_ = 0;
};

}  // namespace panvo::interfaces
