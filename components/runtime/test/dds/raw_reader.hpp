// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/subscriber/DataReaderListener.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "raw_type.hpp"

namespace eprosima::fastdds::dds {
class DomainParticipant;
}

namespace panvo::runtime::test {

/// Reads a reliable, transient local topic without the bridge, like a node of another program. `user_data` is announced
/// with the reader.
class RawReader final : private fdds::DataReaderListener {
 public:
  RawReader(int domain, const std::string& wire_topic_name, const std::string& wire_type_name,
            const std::string& user_data, std::function<void(const std::vector<std::uint8_t>&)> on_message);
  ~RawReader() override;

 private:
  void on_data_available(fdds::DataReader* reader) override;

  const std::function<void(const std::vector<std::uint8_t>&)> on_message_;
  fdds::DomainParticipant* participant_;
};

}  // namespace panvo::runtime::test
