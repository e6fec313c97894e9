// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace panvo::runtime::test {

/// Writes any bytes at all to a topic, past the bridge: what a faulty or foreign program may send. Its lease has no end: it is missed only if it
/// says goodbye or is replaced.
class RawWriter {
 public:
  struct Offer {
    bool reliable = true;
    bool transient_local = false;
  };
  RawWriter(int domain, const std::string& wire_topic_name, const std::string& wire_type_name, Offer offer);
  ~RawWriter();

  bool write(std::vector<std::uint8_t> payload);
  int matched_readers() const;

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

}  // namespace panvo::runtime::test
