// SPDX-License-Identifier: Apache-2.0
#include "message_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <vector>

#include "panvo/interfaces/message_layout.hpp"
#include "panvo/interfaces/message_payload.hpp"

namespace panvo::python {
namespace {

using interfaces::CdrField;
using interfaces::CdrLayout;
using interfaces::CdrNumber;

py::dtype dtype_of(const CdrField& field) {
  constexpr std::string_view kKinds = "uifb";  // in the order of CdrNumber
  std::string name(1, kKinds.at(static_cast<std::size_t>(field.number)));
  return py::dtype(field.number == CdrNumber::kBool ? "?" : name + std::to_string(field.size));
}

/// Reads a payload that checked_payload() has accepted.
class Reader {
 public:
  Reader(const interfaces::Payload& payload, py::capsule owner) : payload_(payload), owner_(std::move(owner)) {}

  py::dict message(const CdrLayout& layout) {
    py::dict values;
    for (const CdrField& field : layout.fields) {
      values[py::str(field.name.data(), field.name.size())] = member(field);
    }
    return values;
  }

 private:
  py::object member(const CdrField& field) {
    if (!field.is_sequence && !field.is_array) return element(field);
    const auto count = field.is_sequence ? number<std::uint32_t>() : field.array_size;
    if (field.size > 0) return numbers(field, count);
    py::list list;
    for (std::uint32_t i = 0; i < count; ++i) list.append(element(field));
    return list;
  }

  py::object element(const CdrField& field) {
    if (field.nested != nullptr) return message(*field.nested);
    return field.is_string ? text() : scalar(field);
  }

  py::object numbers(const CdrField& field, std::size_t count) {
    const auto dtype = dtype_of(field);
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)};
    if (count == 0) return py::array(dtype, shape);
    align(field.size);
    const std::uint8_t* begin = payload_.bytes.data() + position_;
    position_ += count * field.size;
    if (field.size == 1) {
      py::array view(dtype, shape, {}, begin, owner_);
      view.attr("flags").attr("writeable") = false;
      return view;
    }
    py::array copy(dtype, shape);
    std::copy_n(begin, count * field.size, static_cast<std::uint8_t*>(copy.mutable_data()));
    if (payload_.order != std::endian::native) copy.attr("byteswap")(true);
    return copy;
  }

  py::object scalar(const CdrField& field) {
    switch (field.number) {
      case CdrNumber::kBool:
        return py::bool_(number<std::uint8_t>() != 0);
      case CdrNumber::kFloat:
        return py::float_(field.size == 4 ? double{number<float>()} : number<double>());
      case CdrNumber::kSigned:
        return py::int_(field.size == 1   ? std::int64_t{number<std::int8_t>()}
                        : field.size == 2 ? std::int64_t{number<std::int16_t>()}
                        : field.size == 4 ? std::int64_t{number<std::int32_t>()}
                                          : number<std::int64_t>());
      case CdrNumber::kUnsigned:
        break;
    }
    return py::int_(field.size == 1   ? std::uint64_t{number<std::uint8_t>()}
                    : field.size == 2 ? std::uint64_t{number<std::uint16_t>()}
                    : field.size == 4 ? std::uint64_t{number<std::uint32_t>()}
                                      : number<std::uint64_t>());
  }

  /// Bytes that are not UTF-8 become U+FFFD.
  py::object text() {
    const auto length = number<std::uint32_t>();
    std::string_view text(reinterpret_cast<const char*>(payload_.bytes.data() + position_), length);
    position_ += length;
    if (!text.empty() && text.back() == '\0') text.remove_suffix(1);
    auto* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
    if (decoded == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
  }

  void align(std::size_t size) { position_ += (size - position_ % size) % size; }

  template <class Number>
  Number number() {
    align(sizeof(Number));
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    std::copy_n(payload_.bytes.begin() + static_cast<std::ptrdiff_t>(position_), sizeof(Number), bytes.begin());
    if (payload_.order != std::endian::native) std::ranges::reverse(bytes);
    position_ += sizeof(Number);
    return std::bit_cast<Number>(bytes);
  }

  interfaces::Payload payload_;
  py::capsule owner_;
  std::size_t position_ = 0;
};

}  // namespace

py::dict message_values(const interfaces::MessageType& type, const std::shared_ptr<const interfaces::Bytes>& bytes) {
  using Kept = std::shared_ptr<const interfaces::Bytes>;
  const auto payload = interfaces::checked_payload(type, *bytes);
  auto kept = std::make_unique<Kept>(bytes);
  py::capsule owner(kept.get(), [](void* pointer) { delete static_cast<Kept*>(pointer); });
  static_cast<void>(kept.release());  // the capsule owns it
  return Reader(payload, std::move(owner)).message(*type.layout);
}

}  // namespace panvo::python
