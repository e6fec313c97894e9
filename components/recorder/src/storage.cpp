// SPDX-License-Identifier: Apache-2.0
#include "panvo/recorder/storage.hpp"

#include <array>
#include <utility>

#include "panvo/recorder/bag_error.hpp"

namespace panvo::recorder {
namespace {

constexpr std::array kStorages{std::pair{Storage::kSqlite3, "sqlite3"}, std::pair{Storage::kMcap, "mcap"}};
constexpr std::array kCompressions{std::pair{Compression::kNone, "none"}, std::pair{Compression::kLz4, "lz4"},
                                   std::pair{Compression::kZstd, "zstd"}};

template <class Values, class Value>
std::string name_in(const Values& values, Value value) {
  for (const auto& [known, name] : values) {
    if (known == value) {
      return name;
    }
  }
  return {};
}

template <class Values>
auto value_in(const Values& values, const char* what, const std::string& text) {
  std::string names;
  for (const auto& [known, name] : values) {
    if (text == name) {
      return known;
    }
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw BagError("unknown bag " + std::string(what) + " '" + text + "'; choose one of " + names);
}

}  // namespace

std::string to_text(Storage storage) { return name_in(kStorages, storage); }
std::string to_text(Compression compression) { return name_in(kCompressions, compression); }

Storage storage_from_text(const std::string& text) { return value_in(kStorages, "storage", text); }
Compression compression_from_text(const std::string& text) { return value_in(kCompressions, "compression", text); }

}  // namespace panvo::recorder
