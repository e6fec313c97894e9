// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <memory>

namespace panvo::runtime::dds {

/// A process that is killed says no goodbye: its readers stay known, and are sent to, until their lease ends. When it is started again it has the
/// same UDP ports, so what is sent to the dead readers reaches the new ones. Fragments of an image bear no reader's name where several read it: a
/// new reader begins to put together an image that was never for it and is never completed, and ROS 2's (Fast DDS 2.14) stops for good then.
///
/// So a participant whose ports another one has got is let go at once: `transport` passes Fast DDS the goodbye that it did not say.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> with_goodbyes_for_replaced(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp);

/// Lets `participant` go once the message is processed which this thread is processing: one in which another participant announces itself at its
/// ports. Does nothing on a thread of another transport.
void let_go_replaced(const eprosima::fastrtps::rtps::GuidPrefix_t& participant);

}  // namespace panvo::runtime::dds
