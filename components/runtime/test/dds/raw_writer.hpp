// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace panvo::runtime::test {

/// Writes arbitrary bytes to a topic without the bridge, like a faulty or foreign program. Its lease never expires: it
/// is only removed when it leaves or is replaced.
class RawWriter {
 public:
  struct Offer {
    bool reliable = true;
    bool transient_local = false;
    bool on_localhost = false;  ///< looks for others on this machine only, as rmw_fastrtps with range LOCALHOST
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
