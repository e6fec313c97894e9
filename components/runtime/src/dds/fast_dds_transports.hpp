// SPDX-License-Identifier: Apache-2.0
#pragma once

// Transports and addresses of Fast DDS 2 and 3, see fast_dds.hpp.

#include <chrono>
#include <cstdint>
#include <vector>

#include "fast_dds.hpp"

#ifdef PANVO_FAST_DDS_3
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.hpp>
#include <fastdds/rtps/transport/TransportDescriptorInterface.hpp>
#include <fastdds/rtps/transport/TransportInterface.hpp>
#include <fastdds/rtps/transport/TransportReceiverInterface.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/TransportDescriptorInterface.h>
#include <fastdds/rtps/transport/TransportInterface.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#endif

namespace panvo::runtime::dds {

#ifdef PANVO_FAST_DDS_3
/// Later versions want a priority, of which 0 is the default.
template <class Sender>
bool send_by(Sender& sender, const std::vector<rtps::NetworkBuffer>& buffers, std::uint32_t size,
             rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
             const std::chrono::steady_clock::time_point& limit) {
  if constexpr (requires { sender.send(buffers, size, begin, end, limit, 0); }) {
    return sender.send(buffers, size, begin, end, limit, 0);
  } else {
    return sender.send(buffers, size, begin, end, limit);
  }
}
#else
namespace rtps {
using eprosima::fastdds::rtps::LocatorsIterator;  // Clang does not find it in two namespaces
}
#endif

/// A transport whose outgoing messages pass unchanged.
class ReceivingTransport : public rtps::ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

 private:
#ifdef PANVO_FAST_DDS_3
  bool send(rtps::SenderResource* sender, const std::vector<rtps::NetworkBuffer>& buffers, std::uint32_t size,
            rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& limit) final {
    return send_by(*sender, buffers, size, begin, end, limit);
  }
#else
  bool send(rtps::SenderResource* sender, const rtps::octet* bytes, std::uint32_t size, rtps::LocatorsIterator* begin,
            rtps::LocatorsIterator* end, const std::chrono::steady_clock::time_point& limit) final {
    return sender->send(bytes, size, begin, end, limit);
  }
#endif
};

}  // namespace panvo::runtime::dds
