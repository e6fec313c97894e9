// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace panvo::runtime::test {

/// A service client whose reply reader the server discovers only when it is announced, as if discovery packets were
/// lost.
class LateClient {
 public:
  LateClient(int domain, const std::string& service, const std::string& service_type);
  ~LateClient();

  bool ask(std::vector<std::uint8_t> request);
  void show_reader();
  /// The next reply; empty at the timeout.
  std::vector<std::uint8_t> reply();

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

}  // namespace panvo::runtime::test
