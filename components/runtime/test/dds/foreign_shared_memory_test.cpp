// SPDX-License-Identifier: Apache-2.0
// Shared memory in /dev/shm for the ports of our domain that is from another Fast DDS build, damaged or unfinished must
// be ignored and must not end a process.

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "bridge_fixture.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime::test {
namespace {

namespace fs = std::filesystem;

struct Bytes {
  std::size_t offset;
  std::string_view hexadecimal;
};

/// Non-zero bytes of a port left by Fast DDS 2.14 built with its bundled Boost (recorded, without the cells of its
/// queue, which are all equal).
constexpr std::size_t kPortSize = 52400;
constexpr std::array<Bytes, 13> kPort{
    {{0, "02"},
     {32, "80"},
     {56, "0100000000000000d8c9000000000000d0c9000000000000c8c90000000000006800000040c90000a0cc"},
     {120, "81"},
     {144, "01000000000000004800000000000000400000000000000038"},
     {184, "0100000000000000f8fffffffffffffff0ffffffffffffffbd0c00000f0a00c0"},
     {224,
      "baffffffffffffff01000000000000000100000000000000b0a000000e0008210009de08a201000001000000d8a10000f8c90000f31c0000"
      "00000000e80300004d010000000200000000000007000000ddce8d35671e3317"},
     {41368, "6661737472747073"},                                  // "fastrtps"
     {41392, "706f72745f6e6f64655f61626935000000000000820200c0"},  // "port_node_abi5"
     {41425, "28000000000401"},
     {51684, "030000c0"},
     {51696, "100000000000080100000000000200000002"},
     {51732, "290000402a36ffffffffffff010000000000000001"}}};

std::string port_of_another_build() {
  std::string content(kPortSize, '\0');
  for (const auto& [offset, hexadecimal] : kPort) {
    for (std::size_t i = 0; i < hexadecimal.size(); i += 2)
      content[offset + i / 2] = static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16));
  }
  return content;
}

std::string damaged_port() {
  std::string content = port_of_another_build();
  for (std::size_t i = 64; i < content.size(); i += 7) content[i] = static_cast<char>(i * 2654435761U >> 24);
  return content;
}

struct Planted {
  const char* name;
  std::string (*content)();
  std::uint32_t shared_image_bytes;
};
std::ostream& operator<<(std::ostream& out, const Planted& planted) { return out << planted.name; }

/// Creates such files for all ports of the first fifteen participants of a domain; removed by the destructor.
class PlantedPorts {
 public:
  explicit PlantedPorts(std::string content) : content_(std::move(content)) { plant(); }
  ~PlantedPorts() {
    for_each([](const fs::path& file) {
      std::error_code gone;
      fs::remove(file, gone);
    });
  }

  void plant() const {
    for_each([this](const fs::path& file) { std::ofstream(file, std::ios::binary) << content_; });
  }

 private:
  template <class Do>
  static void for_each(const Do& act) {
    constexpr int kFirst = 7400, kDomain = 250, kPorts = 42;  // from the DDSI-RTPS specification
    for (int port = 0; port < kPorts; ++port)
      act("/dev/shm/fastrtps_port" + std::to_string(kFirst + kDomain * test_domain() + port));
  }

  const std::string content_;
};

// The ports exist before the participants.
class BesideForeignMemory : private PlantedPorts,
                            public BetweenProcesses,
                            public ::testing::WithParamInterface<Planted> {
 protected:
  BesideForeignMemory() : PlantedPorts(GetParam().content()), BetweenProcesses(GetParam().shared_image_bytes) {}

  void plant_again() const { plant(); }

  void expect_messages_both_ways(PeerProcess& other) {
    const std::string number = std::to_string(++exchanges_);  // the peers keep opened topics
    const auto text = unique_topic("text" + number), image = unique_topic("image" + number);
    const auto reader = bridge->open_reader(topic(text, kStringType), inbox.callback());
    const auto writer = bridge->open_writer(topic(image, kImageType, interfaces::qos::kSensorData));
    other.ask("open_writer " + text + " " + kStringType + " reliable volatile 5");
    other.ask("open_reader " + image + " " + kImageType + " best_effort volatile 5");
    ASSERT_TRUE(other.matches(text, 1) && other.matches(image, 1));
    ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }));
    inbox.clear();
    ASSERT_EQ(other.ask("write_text " + text + " yes"), "written");
    EXPECT_EQ(inbox.wait_for_count(1).size(), 1U);
    const auto sample = image_sample(100'000, 1);
    ASSERT_TRUE(eventually([&] {  // until it is shared, if it is
      return writer->write(sample) && std::stoul(other.ask("counters " + image)) > 20;
    }));
    EXPECT_EQ(other.next_received(image),
              std::to_string(sample->bytes().size()) + " " + std::to_string(hash(sample->bytes())));
  }

 private:
  int exchanges_ = 0;
};

TEST_P(BesideForeignMemory, MessagesAndImagesPassFromTheStart) { expect_messages_both_ways(peer); }

TEST_P(BesideForeignMemory, MessagesAndImagesPassWhenItComesLater) {
  expect_messages_both_ways(peer);
  plant_again();
  PeerProcess later(domain, PANVO_BRIDGE_PEER, shared_image_bytes);
  expect_messages_both_ways(later);
  expect_messages_both_ways(peer);
}

INSTANTIATE_TEST_SUITE_P(Ports, BesideForeignMemory,
                         testing::Values(Planted{"of_another_build", port_of_another_build, 0},
                                         Planted{"of_another_build_beside_shared_images", port_of_another_build,
                                                 2'000'000},
                                         Planted{"damaged", damaged_port, 2'000'000},
                                         Planted{"never_finished", [] { return std::string(); }, 2'000'000}),
                         [](const auto& planted) { return planted.param.name; });

TEST_F(BetweenProcesses, AProfileThatNamesSharedMemoryIsTakenWithoutIt) {
  const panvo::test::TemporaryFolder folder;
  const auto file =
      folder.write("profile.xml", R"(<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
    <transport_descriptors>
      <transport_descriptor><transport_id>shm</transport_id><type>SHM</type></transport_descriptor>
    </transport_descriptors>
    <participant profile_name="shm_only" is_default_profile="true"><rtps>
      <userTransports><transport_id>shm</transport_id></userTransports>
      <useBuiltinTransports>false</useBuiltinTransports>
    </rtps></participant></profiles>)");
  const auto profiled = make_dds_bridge({.domain = domain, .profiles = file.string(), .name = "profiled"});
  Inbox<std::string> said;
  profiled->on_warning(said.callback());
  EXPECT_TRUE(said.wait_for([](const std::string& text) { return text.find("UDPv4") != std::string::npos; }));
  const auto name = unique_topic("text");
  const auto reader = profiled->open_reader(topic(name, kStringType), inbox.callback());
  peer.ask("open_writer " + name + " " + kStringType + " reliable volatile 5");
  ASSERT_TRUE(peer.matches(name, 1));
  ASSERT_EQ(peer.ask("write_text " + name + " yes"), "written");
  EXPECT_EQ(inbox.wait_for_count(1).size(), 1U);
}

}  // namespace
}  // namespace panvo::runtime::test
