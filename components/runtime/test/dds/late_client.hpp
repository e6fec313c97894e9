// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace panvo::runtime::test {

/// A client of a service whose reader of replies the server does not hear of before it is shown: as if the packets that tell of it were lost.
class LateClient {
 public:
  LateClient(int domain, const std::string& service, const std::string& service_type);
  ~LateClient();

  bool ask(std::vector<std::uint8_t> request);
  void show_reader();
  /// The next reply; empty if none comes in time.
  std::vector<std::uint8_t> reply();

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

}  // namespace panvo::runtime::test
