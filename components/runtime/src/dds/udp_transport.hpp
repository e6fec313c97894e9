// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <memory>

#include "fast_dds_transports.hpp"

namespace panvo::runtime::dds {

/// UDP with remedies for four faults of Fast DDS 2.9:
///
/// 1. A killed process does not announce its departure: its readers stay known, and receive data, until their lease
///    ends. When it is restarted, it has the same UDP ports, so data for the dead readers reaches the new ones. Fragments
///    of an image for several readers name no reader: a new reader starts to assemble an image that was not sent to it
///    and is never completed. ROS 2's reader (Fast DDS 2.14) then stalls for good. Therefore a participant is removed as
///    soon as another one announces itself at its ports: the transport injects the missing departure message.
/// 2. A new participant announces itself before it receives. Answers that arrive within this time, a fraction of a
///    millisecond, are lost, and the others answer only once: it meets them at their next periodic announcement, with
///    ROS 2's settings after up to 3 s. Therefore received messages wait for start_reception().
/// 3. Announcements that are handled at the same time confuse its security manager. Therefore they are handled one at a
///    time.
/// 4. To readers with a common multicast address it opens no sender for the address of each, but sends the first message
///    to a new one there: an assertion, or undefined behaviour (mended in 2.14.5). Readers of Cyclone DDS announce such
///    addresses. Therefore a reader's own addresses are preferred.
std::shared_ptr<rtps::TransportDescriptorInterface> mended_udp(std::shared_ptr<rtps::TransportDescriptorInterface> udp);

/// To be called once the participant with these transports has been created.
void start_reception(const fdds::DomainParticipantQos& qos);

/// Removes `participant` after the message that this thread is processing, in which another participant announces
/// itself at its ports. No effect on threads of another transport.
void let_go_replaced(const rtps::GuidPrefix_t& participant);

}  // namespace panvo::runtime::dds
