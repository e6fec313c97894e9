// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/message_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "panvo/interfaces/message_layout.hpp"
#include "panvo/interfaces/message_payload.hpp"

namespace panvo::interfaces {
namespace {

template <class Number>
std::string digits(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

template <class Float>
std::string float_text(Float value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  std::string text = digits(value);
  // Without a point it would be read back as an integer.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// In double quotes, the only style that supports escape sequences.
std::string escaped(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      quoted += std::string("\\") + letter;
    } else if (letter == '\n') {
      quoted += "\\n";
    } else if (code < 0x20 || code == 0x7f) {
      quoted += std::string("\\x") + kHex[code >> 4] + kHex[code & 15];
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

/// Without quotes if YAML reads the text as a string.
std::string in_quotes(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_/";
  const auto is_control = [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; };
  if (std::ranges::any_of(text, is_control)) return escaped(text);
  const bool is_word = !text.empty() && kPlain.find(text.front()) != std::string_view::npos &&
                       text.find_first_not_of(std::string(kPlain) + "0123456789.-() ") == std::string_view::npos &&
                       text.back() != ' ';
  constexpr std::array<std::string_view, 8> kOther{"true", "false", "null", "yes", "no", "on", "off", "y"};
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  if (is_word && std::ranges::find(kOther, lower) == kOther.end() && lower != "n") return std::string(text);
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("''") : std::string(1, letter);
  return quoted + "'";
}

/// Prints a payload that check_cdr has accepted.
class Printer {
 public:
  Printer(std::span<const std::uint8_t> payload, std::endian order, std::size_t longest)
      : payload_(payload), order_(order), longest_(longest) {}

  std::string take() { return std::move(text_); }

  void message(const CdrLayout& layout, const std::string& indent, bool first_follows_dash = false) {
    for (const CdrField& field : layout.fields) {
      text_ += (first_follows_dash ? "" : indent) + std::string(field.name) + ":";
      first_follows_dash = false;
      if (field.is_sequence || field.is_array) {
        list(field, indent);
      } else if (field.nested) {
        text_ += "\n";
        message(*field.nested, indent + "  ");
      } else {
        text_.append(" ").append(scalar(field)).append("\n");
      }
    }
  }

 private:
  void list(const CdrField& field, const std::string& indent) {
    const std::uint32_t count = field.is_sequence ? number<std::uint32_t>() : field.array_size;
    if (count == 0) {
      text_ += " []\n";
      return;
    }
    text_ += "\n";
    for (std::uint32_t i = 0; i < count; ++i) {
      if (longest_ != 0 && i == longest_) {
        text_ += indent + "- '...'\n";
        shown_.push_back(std::move(text_));  // the rest is skipped
        text_.clear();
      }
      text_ += indent + "- ";
      if (field.nested) {
        message(*field.nested, indent + "  ", true);
      } else {
        text_ += scalar(field) + "\n";
      }
      if (longest_ != 0 && i >= longest_) text_.clear();
    }
    if (longest_ != 0 && count > longest_) {
      text_ = std::move(shown_.back());
      shown_.pop_back();
    }
  }

  std::string scalar(const CdrField& field) {
    if (field.is_string) return text();
    switch (field.number) {
      case CdrNumber::kBool:
        return number<std::uint8_t>() != 0 ? "true" : "false";
      case CdrNumber::kFloat:
        return field.size == 4 ? float_text(number<float>()) : float_text(number<double>());
      case CdrNumber::kSigned:
        return field.size == 1   ? digits(int{number<std::int8_t>()})
               : field.size == 2 ? digits(number<std::int16_t>())
               : field.size == 4 ? digits(number<std::int32_t>())
                                 : digits(number<std::int64_t>());
      case CdrNumber::kUnsigned:
        break;
    }
    return field.size == 1   ? digits(unsigned{number<std::uint8_t>()})
           : field.size == 2 ? digits(number<std::uint16_t>())
           : field.size == 4 ? digits(number<std::uint32_t>())
                             : digits(number<std::uint64_t>());
  }

  std::string text() {
    const auto length = number<std::uint32_t>();
    std::string_view text(reinterpret_cast<const char*>(payload_.data() + position_), length);
    position_ += length;
    if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
    if (longest_ != 0 && text.size() > longest_) return in_quotes(std::string(text.substr(0, longest_)) + "...");
    return in_quotes(text);
  }

  template <class Number>
  Number number() {
    position_ += (sizeof(Number) - position_ % sizeof(Number)) % sizeof(Number);
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    std::copy_n(payload_.begin() + static_cast<std::ptrdiff_t>(position_), sizeof(Number), bytes.begin());
    if (order_ != std::endian::native) std::ranges::reverse(bytes);
    position_ += sizeof(Number);
    return std::bit_cast<Number>(bytes);
  }

  std::span<const std::uint8_t> payload_;
  std::endian order_;
  std::size_t longest_;
  std::size_t position_ = 0;
  std::string text_;
  std::vector<std::string> shown_;
};

}  // namespace

std::string to_yaml(const MessageType& type, std::span<const std::uint8_t> bytes, std::size_t longest) {
  const auto [payload, order] = checked_payload(type, bytes);
  Printer printer(payload, order, longest);
  printer.message(*type.layout, "");
  return printer.take();
}

}  // namespace panvo::interfaces
