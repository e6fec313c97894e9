// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace panvo::landmarks {

/// Where a landmark store is: a file, or a PostgreSQL database, `postgresql://USER@HOST/DATABASE`.
class StoreLocation {
 public:
  StoreLocation(const char* text) : text_(text) {}                            // NOLINT(google-explicit-constructor)
  StoreLocation(const std::string& text) : text_(text) {}                     // NOLINT(google-explicit-constructor)
  StoreLocation(const std::filesystem::path& file) : text_(file.string()) {}  // NOLINT(google-explicit-constructor)

  bool is_server() const noexcept;
  /// As given: the location of a server may contain a password.
  const std::string& text() const noexcept { return text_; }
  /// For messages: without a password.
  std::string shown() const;

 private:
  std::string text_;
};

/// How long to wait for a server. For files, without effect.
struct StorePatience {
  int connect_s = 5;  ///< to connect; a connect_timeout in the location prevails
  int answer_s = 10;  ///< for an answer, and for other writers
  /// Waits before reconnecting; returns false to give up. `attempt` counts from 0 in each call of
  /// the store. Empty: four attempts within 4 s, not counting the waits above.
  std::function<bool(int attempt, const std::string& problem)> pause;
};

}  // namespace panvo::landmarks
