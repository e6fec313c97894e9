// SPDX-License-Identifier: Apache-2.0
#include "udp_transport.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

#include "announcement.hpp"
#include "fast_dds.hpp"

namespace panvo::runtime::dds {

namespace {

using Message = std::vector<rtps::octet>;

// Participants replaced by the sender of the message this thread is processing; nullptr: none is being processed.
thread_local std::vector<rtps::GuidPrefix_t>* replaced_here = nullptr;

/// The message of a leaving participant [RTPS 2.2, 8.5.3, 9.4.5.3 and 9.6.3.4]: DATA of its announcing writer, without
/// payload, whose inline QoS name the disposed participant. Its sequence number is above those of all earlier
/// announcements.
Message goodbye_of(const rtps::GuidPrefix_t& participant) {
  constexpr std::array<rtps::octet, 8> kHeader{'R', 'T', 'P', 'S', 2, 2, 1, 15};
  constexpr std::array<rtps::octet, 28> kData{0x15, 0x03, 52, 0,     // DATA, little endian, inline QoS, 52 bytes
                                              0,    0,    16, 0,     // inline QoS are 16 bytes from here
                                              0,    1,    0,  0xc7,  // to the reader of announcements
                                              0,    1,    0,  0xc2,  // from the writer of announcements
                                              1,    0,    0,  0,    0, 0, 0, 0,  // sequence number 2^32
                                              0x70, 0,    16, 0};                // key hash: the participant's GUID
  constexpr std::array<rtps::octet, 16> kEnd{0,    0, 1, 0xc1,                   // the participant's entity in it
                                             0x71, 0, 4, 0,    0, 0, 0, 3,       // status: disposed of and unregistered
                                             1,    0, 0, 0};                     // no more
  Message message;
  const auto append = [&](const auto& bytes) { std::ranges::copy(bytes, std::back_inserter(message)); };
  append(kHeader);
  append(participant.value);
  append(kData);
  append(participant.value);
  append(kEnd);
  return message;
}

/// Holds received messages back until the participant can handle them.
class Gate {
 public:
  void open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    opened_.notify_all();
  }
  void wait() {
    // If creating a participant fails, it waits for the threads that wait here.
    constexpr std::chrono::seconds kLimit{1};
    std::unique_lock lock(mutex_);
    opened_.wait_for(lock, kLimit, [this] { return is_open_; });
    is_open_ = true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool is_open_ = false;
};

class Transport final : public ReceivingTransport {
 public:
  Transport(const rtps::ChainingTransportDescriptor& descriptor, std::shared_ptr<Gate> gate)
      : ReceivingTransport(descriptor), udp_(descriptor.low_level_descriptor), gate_(std::move(gate)) {}

  rtps::TransportDescriptorInterface* get_configuration() override { return udp_.get(); }

  // Outgoing messages bypass this transport. If its senders were wrapped, UDP would not recognise its own and would
  // open more per participant.
  bool OpenOutputChannel(rtps::SendResourceList& senders, const rtps::Locator_t& locator) override {
    return low_level_transport_->OpenOutputChannel(senders, locator);
  }
  /// Chooses the own addresses of each reader, also if several readers share a multicast address.
  void select_locators(rtps::LocatorSelector& selector) const override {
    auto& readers = selector.transport_starts();
    for (std::size_t i = 0; i < readers.size(); ++i) {
      if (!readers[i]->transport_should_process) continue;
      const auto choose = [&](const auto& addresses, auto& chosen) {
        for (std::size_t j = 0; j < addresses.size(); ++j) {
          if (!IsLocatorSupported(addresses[j]) || selector.is_selected(addresses[j])) continue;
          chosen.push_back(j);
          selector.select(i);
        }
      };
      choose(readers[i]->unicast, readers[i]->state.unicast);
      if (readers[i]->unicast.empty()) choose(readers[i]->multicast, readers[i]->state.multicast);
    }
  }
  void receive(rtps::TransportReceiverInterface* receiver, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& local, const rtps::Locator_t& remote) override {
    gate_->wait();
    std::unique_lock one_at_a_time(announcements_, std::defer_lock);
    if (is_announcement({bytes, size})) one_at_a_time.lock();
    std::vector<rtps::GuidPrefix_t> replaced;
    auto* const outer = std::exchange(replaced_here, &replaced);
    receiver->OnDataReceived(bytes, size, local, remote);
    replaced_here = outer;
    for (const auto& participant : replaced) {
      const Message goodbye = goodbye_of(participant);
      receiver->OnDataReceived(goodbye.data(), static_cast<std::uint32_t>(goodbye.size()), local, remote);
    }
  }

 private:
  const std::shared_ptr<rtps::TransportDescriptorInterface> udp_;
  const std::shared_ptr<Gate> gate_;
  // Each socket has a thread. The security manager of Fast DDS 2.9 keeps the participant it connects to in a member
  // without a lock: of two participants announced at the same time, one was connected twice and the other never.
  std::recursive_mutex announcements_;
};

struct Descriptor final : rtps::ChainingTransportDescriptor {
  using rtps::ChainingTransportDescriptor::ChainingTransportDescriptor;
  rtps::TransportInterface* create_transport() const override { return new Transport(*this, gate); }

  const std::shared_ptr<Gate> gate = std::make_shared<Gate>();
};

}  // namespace

std::shared_ptr<rtps::TransportDescriptorInterface> mended_udp(
    std::shared_ptr<rtps::TransportDescriptorInterface> udp) {
  return std::make_shared<Descriptor>(std::move(udp));
}

void start_reception(const fdds::DomainParticipantQos& qos) {
  for (const auto& transport : qos.transport().user_transports) {
    if (const auto mended = std::dynamic_pointer_cast<Descriptor>(transport)) mended->gate->open();
  }
}

void let_go_replaced(const rtps::GuidPrefix_t& participant) {
  if (replaced_here) replaced_here->push_back(participant);
}

}  // namespace panvo::runtime::dds
