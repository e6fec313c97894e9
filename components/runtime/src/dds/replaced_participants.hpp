// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <memory>

namespace panvo::runtime::dds {

/// A killed process does not announce its departure: its readers stay known, and receive data, until their lease ends.
/// When it is restarted, it has the same UDP ports, so data for the dead readers reaches the new ones. Fragments of an
/// image for several readers name no reader: a new reader starts to assemble an image that was not sent to it and is
/// never completed. ROS 2's reader (Fast DDS 2.14) then stalls for good.
///
/// Therefore a participant is removed as soon as another one announces itself at its ports: `transport` injects the
/// missing departure message into Fast DDS. It also lets Fast DDS handle announcements one at a time.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> with_goodbyes_for_replaced(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp);

/// Removes `participant` after the message that this thread is processing, in which another participant announces
/// itself at its ports. No effect on threads of another transport.
void let_go_replaced(const eprosima::fastrtps::rtps::GuidPrefix_t& participant);

}  // namespace panvo::runtime::dds
