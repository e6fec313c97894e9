// SPDX-License-Identifier: Apache-2.0
// Images shared between processes of one machine, and images that cannot be shared.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <semaphore>
#include <set>

#include "bridge_fixture.hpp"
#include "dds/image_sharing.hpp"
#include "dds/shared_memory.hpp"
#include "panvo/runtime/shm_leftovers.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMaxShared = 2'000'000;
constexpr std::size_t kGraySize = 640 * 480, kPanoramaSize = 1080 * 540 * 3, kTooLarge = 3'000'000;

/// Paths of the shared-image segments that a process has mapped.
std::set<std::string> shared_by(pid_t process) {
  std::set<std::string> segments;
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    if (const auto path = line.find("/dev/shm/fast_datasharing_"); path != std::string::npos)
      segments.insert(line.substr(path));
  }
  return segments;
}

std::string size_and_hash(const Sample& sample) {
  return std::to_string(sample.bytes().size()) + " " + std::to_string(hash(sample.bytes()));
}

std::string write_image(const std::string& topic, std::size_t size, std::uint32_t seed) {
  return "write_image " + topic + " " + std::to_string(size) + " " + std::to_string(seed);
}

constexpr std::uint32_t kFirstSeed = 1000;  // of images sent before the actual test

class SharedImages : public BetweenProcesses {
 protected:
  SharedImages() : BetweenProcesses(kMaxShared) {}

  void SetUp() override {
    if (access("/dev/shm", W_OK) != 0) GTEST_SKIP() << "there is no /dev/shm";
  }

  /// Reads from the peer's shared memory with `size` bytes per message, which the peer creates at the first image of
  /// that size. The inbox is then empty.
  std::unique_ptr<BridgeReader> read_from_peer(const TopicDescription& wanted, std::size_t size = kGraySize) {
    auto reader = bridge->open_reader(wanted, inbox.callback());
    peer.ask("open_writer " + wanted.name + " " + kImageType + " best_effort volatile 5");
    EXPECT_TRUE(peer.matches(wanted.name, 1) && eventually([&] { return reader->matched_writers() == 1; }));
    EXPECT_TRUE(eventually([&] {  // the sending writer is gone once the sharing one has replaced it
      peer.ask(write_image(wanted.name, size, kFirstSeed));
      return shared_by(getpid()).size() == 2 && reader->matched_writers() == 1;
    })) << "the memory that the peer writes to, and that by which it tells of it";
    settle(wanted.name, *reader);
    return reader;
  }

  std::unique_ptr<BridgeWriter> write_to(PeerProcess& reader, const std::string& name, std::size_t size = kGraySize) {
    auto writer = bridge->open_writer(topic(name, kImageType, interfaces::qos::kSensorData));
    reader.ask("open_reader " + name + " " + kImageType + " best_effort volatile 5");
    EXPECT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && reader.matches(name, 1));
    EXPECT_TRUE(eventually([&] {
      writer->write(image_sample(size, kFirstSeed));
      return shared_by(reader.id()).size() == 2 && reader.ask("matched " + name) == "1";
    }));
    const auto last = image_sample(size, kFirstSeed + 1);
    EXPECT_TRUE(writer->write(last));
    while (reader.next_received(name) != size_and_hash(*last)) {
    }
    return writer;
  }

  /// Waits until everything the peer has written has arrived.
  void settle(const std::string& name, const BridgeReader& reader) {
    EXPECT_EQ(peer.ask(write_image(name, 4, kFirstSeed + 1)), "written");
    const auto last = image_sample(4, kFirstSeed + 1);
    EXPECT_TRUE(inbox.wait_for([&](const SamplePtr& sample) { return sample->bytes() == last->bytes(); }));
    received_before = reader.counters().received;
    inbox.clear();
  }

  std::uint64_t received_before = 0;  // before the inbox was emptied
};

TEST_F(SharedImages, ArrivePixelForPixelUpToTheLargest) {
  const auto name = unique_topic("image");
  const auto reader = read_from_peer(topic(name, kImageType, interfaces::qos::kSensorData), kMaxShared);
  std::size_t count = 0;
  for (const std::size_t size : {std::size_t{4}, kGraySize, kPanoramaSize, std::size_t{kMaxShared}}) {
    const auto seed = static_cast<std::uint32_t>(count);
    ASSERT_EQ(peer.ask(write_image(name, size, seed)), "written");
    const auto samples = inbox.wait_for_count(++count);
    ASSERT_EQ(samples.size(), count);
    EXPECT_TRUE(samples.back()->bytes() == image_sample(size, seed)->bytes()) << size << " pixels";
    EXPECT_EQ(Sample::as<sensor_msgs::msg::Image>(samples.back())->header().frame_id(), "camera");
  }
  EXPECT_EQ(reader->counters().received, received_before + count);
  EXPECT_EQ(reader->counters().overwritten, 0U);
}

TEST_F(SharedImages, ReachWhoDoesNotShareThemToo) {
  const auto name = unique_topic("image");
  const auto writer = write_to(peer, name);
  PeerProcess other(domain);
  other.ask("open_reader " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 2; }) && other.matches(name, 1));
  const auto sample = image_sample(kGraySize, 3);
  ASSERT_TRUE(writer->write(sample));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*sample));
  EXPECT_EQ(other.next_received(name), size_and_hash(*sample));
  EXPECT_TRUE(shared_by(other.id()).empty());
}

TEST_F(SharedImages, AreReadBesideThoseOfWhoDoesNotShareThemOfAnySize) {
  const auto name = unique_topic("image");
  PeerProcess other(domain);
  const auto reader = bridge->open_reader(topic(name, kImageType, interfaces::qos::kSensorData), inbox.callback());
  other.ask("open_writer " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(other.matches(name, 1) && eventually([&] { return reader->matched_writers() == 1; }));
  ASSERT_EQ(other.ask(write_image(name, kTooLarge, 5)), "written");
  const auto samples = inbox.wait_for_count(1);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_TRUE(samples[0]->bytes() == image_sample(kTooLarge, 5)->bytes());
}

TEST_F(SharedImages, GoOnWhileReadersThatDoNotShareThemComeAndGo) {
  const auto name = unique_topic("image");
  const auto writer = write_to(peer, name);
  PeerProcess other(domain);
  std::uint32_t seed = 0;
  std::size_t not_written = 0;
  for (int i = 0; i < 20; ++i) {
    other.ask("open_reader " + name + " " + kImageType + " reliable volatile 5");
    EXPECT_TRUE(eventually([&] {
      not_written += !writer->write(image_sample(4, ++seed));
      return writer->matched_readers() == 2 && other.ask("matched_writers " + name) == "1";
    }));
    other.ask("close_reader " + name);
    EXPECT_TRUE(eventually([&] {
      not_written += !writer->write(image_sample(4, ++seed));
      return writer->matched_readers() == 1;
    }));
  }
  EXPECT_EQ(not_written, 0U) << "of " << seed;
  const auto last = image_sample(4, ++seed);
  EXPECT_TRUE(writer->write(last));
  while (peer.next_received(name) != size_and_hash(*last)) {
  }
}

TEST_F(SharedImages, ComeOnceEach) {
  const auto name = unique_topic("image");
  const auto reader = read_from_peer(topic(name, kImageType, interfaces::qos::kSensorData));
  for (std::uint32_t seed : {1, 2}) ASSERT_EQ(peer.ask(write_image(name, kGraySize, seed)), "written");
  ASSERT_EQ(inbox.wait_for_count(2).size(), 2U);
  ASSERT_EQ(peer.ask(write_image(name, kGraySize, 3)), "written");
  ASSERT_EQ(inbox.wait_for_count(3).size(), 3U);
  for (std::uint32_t seed : {1, 2, 3})
    EXPECT_TRUE(inbox.items()[seed - 1]->bytes() == image_sample(kGraySize, seed)->bytes()) << seed;
}

TEST_F(SharedImages, GrowWithTheImages) {
  const auto name = unique_topic("image");
  const auto reader = read_from_peer(topic(name, kImageType, interfaces::qos::kSensorData), kGraySize);
  ASSERT_TRUE(eventually([&] {  // the first may be lost before the reader has discovered the larger writer
    EXPECT_EQ(peer.ask(write_image(name, kPanoramaSize, 1)), "written");
    return !inbox.items().empty();
  }));
  EXPECT_TRUE(inbox.items().front()->bytes() == image_sample(kPanoramaSize, 1)->bytes());
  EXPECT_TRUE(eventually([&] { return shared_by(getpid()).size() == 2 && reader->matched_writers() == 1; }));
}

TEST_F(SharedImages, ThatAreTooLargeAreSentAndThatIsSaid) {
  const auto name = unique_topic("image");
  const auto writer = write_to(peer, name);
  const auto large = image_sample(kTooLarge, 4);
  const auto before = peer.ask("counters " + name);
  // The first may be lost before the reader has discovered the writer.
  ASSERT_TRUE(eventually([&] { return writer->write(large) && peer.ask("counters " + name) != before; }));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*large));
  EXPECT_TRUE(is_warned_of(name, "exceeds shared_images_mb"));
}

TEST_F(SharedImages, AreSentWhereThereIsNoMemoryForThemAndThatIsSaid) {
  const auto name = unique_topic("image");
  // Memory is reserved for each kept message: more than any machine has.
  const interfaces::Qos deep{.requested = interfaces::Reliability::kBestEffort, .depth = 10'000'000};
  const auto writer = bridge->open_writer(topic(name, kImageType, deep));
  peer.ask("open_reader " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1; }) && peer.matches(name, 1));
  const auto sample = image_sample(kGraySize, 6);
  ASSERT_TRUE(writer->write(sample));
  EXPECT_EQ(peer.next_received(name), size_and_hash(*sample));
  EXPECT_TRUE(is_warned_of(name, "/dev/shm"));
  EXPECT_TRUE(shared_by(peer.id()).size() == 1) << "its own, by which it would be told of messages";
}

TEST(RoomToShare, IsAsMuchAsThereIs) {
  if (access("/dev/shm", W_OK) != 0) GTEST_SKIP() << "there is no /dev/shm";
  struct statvfs state {};
  ASSERT_EQ(statvfs("/dev/shm", &state), 0);
  const dds::SharingTurn turn;
  EXPECT_TRUE(turn.has_room(4096));
  EXPECT_FALSE(turn.has_room(std::uint64_t{state.f_blocks} * state.f_frsize + 4096));
}

TEST(RoomToShare, IsTakenByOneAtATime) {
  if (access("/dev/shm", R_OK) != 0) GTEST_SKIP() << "there is no /dev/shm";
  std::optional<dds::SharingTurn> first(std::in_place);
  const int other = open("/dev/shm", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  EXPECT_NE(flock(other, LOCK_EX | LOCK_NB), 0);
  first.reset();
  EXPECT_TRUE(eventually([&] { return flock(other, LOCK_EX | LOCK_NB) == 0; })) << "others have their turn, too";
  const dds::SharingTurn of_one_that_stands_still;  // does not wait forever
  close(other);
}

// Reads the first half of a message, then the second half when allowed.
std::binary_semaphore has_read_half{0}, may_read_on{0};
std::atomic<bool> is_slow = false;
interfaces::MessageType slowly_read_type() {
  interfaces::MessageType type = *interfaces::find_message_type(kImageType);
  type.deserialize = [](std::span<const std::uint8_t> bytes) {
    const auto middle = bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2);
    interfaces::Bytes copy(bytes.begin(), middle);
    if (is_slow.exchange(false)) {
      has_read_half.release();
      may_read_on.acquire();
    }
    copy.insert(copy.end(), middle, bytes.end());
    return interfaces::find_message_type(kImageType)->deserialize(copy);
  };
  return type;
}

TEST_F(SharedImages, ThatAreOverwrittenWhileTheyAreReadAreDroppedAndCounted) {
  constexpr std::uint32_t kEnough = 12;  // to wrap around in the memory for 6
  const auto name = unique_topic("image");
  const auto type = slowly_read_type();
  const auto reader = read_from_peer({name, kImageType, interfaces::qos::kSensorData, &type});
  is_slow = true;
  ASSERT_EQ(peer.ask(write_image(name, kGraySize, 0)), "written");
  ASSERT_TRUE(has_read_half.try_acquire_for(kLimit));
  for (std::uint32_t seed = 1; seed <= kEnough; ++seed)
    ASSERT_EQ(peer.ask(write_image(name, kGraySize, seed)), "written");
  may_read_on.release();
  ASSERT_TRUE(eventually([&] { return reader->counters().overwritten > 0; }));

  ASSERT_EQ(peer.ask(write_image(name, kGraySize, kEnough + 1)), "written");
  const auto stamp_s = [](const SamplePtr& sample) {
    return static_cast<std::uint32_t>(Sample::as<sensor_msgs::msg::Image>(sample)->header().stamp().sec());
  };
  ASSERT_TRUE(inbox.wait_for([&](const SamplePtr& sample) { return stamp_s(sample) == kEnough + 1; }));
  for (const auto& sample : inbox.items()) {
    EXPECT_NE(stamp_s(sample), 0U);
    EXPECT_TRUE(sample->bytes() == image_sample(kGraySize, stamp_s(sample))->bytes());
  }
}

TEST_F(SharedImages, DoNotWaitForAReaderThatStandsStillAndComeWholeAfterwards) {
  const auto name = unique_topic("image");
  const auto writer = write_to(peer, name);
  std::set<std::string> written;
  const auto write = [&](std::uint32_t seed) {
    const auto sample = image_sample(kGraySize, seed);
    EXPECT_TRUE(writer->write(sample));
    written.insert(size_and_hash(*sample));
    return size_and_hash(*sample);
  };
  peer.signal(SIGSTOP);
  peer.wait_until_stopped();
  for (std::uint32_t seed = 0; seed < 20; ++seed) write(seed);
  peer.signal(SIGCONT);
  const auto last = write(20);
  for (std::string received; received != last;) {
    received = peer.next_received(name);
    EXPECT_TRUE(written.contains(received)) << received;
  }
}

TEST(SharingNeighbourhood, IsTheSameInOneUsersProcessesAndNotInAnothers) {
  const auto own = dds::sharing_neighbourhood();
  EXPECT_EQ(dds::sharing_neighbourhood(), own);
  constexpr uid_t kNobody = 65534;
  if (geteuid() != 0) GTEST_SKIP() << "only root can be another user";
  ASSERT_EQ(seteuid(kNobody), 0);
  const auto others = dds::sharing_neighbourhood();
  ASSERT_EQ(seteuid(0), 0);
  EXPECT_NE(others, own);
}

/// Those of these segments, and of the marks of their participants, that exist.
std::set<std::string> files_of(const std::set<std::string>& segments) {
  std::set<std::string> files;
  for (const auto& segment : segments) {
    for (const auto& file : {segment, segment.substr(0, segment.rfind('_')) + "_el"}) {
      if (fs::exists(file)) files.insert(file);
    }
  }
  return files;
}

TEST_F(SharedImages, OfAKilledProcessLeaveNoMemoryBehind) {
  const auto reader = read_from_peer(topic(unique_topic("image"), kImageType, interfaces::qos::kSensorData));
  const auto segments = shared_by(getpid());  // of the reader and of the peer
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(files_of(segments).size(), 4U);
  peer.signal(SIGKILL);
  EXPECT_TRUE(eventually([&] {
    remove_shm_leftovers();
    return files_of(segments).size() == 2;
  }));
  remove_shm_leftovers();
  EXPECT_EQ(files_of(segments).size(), 2U) << "the memory of a living process was taken away";
}

TEST_F(SharedImages, LeaveNoMemoryBehind) {
  auto reader = read_from_peer(topic(unique_topic("image"), kImageType, interfaces::qos::kSensorData));
  const auto segments = shared_by(getpid());
  ASSERT_EQ(segments.size(), 2U);
  reader.reset();
  EXPECT_EQ(files_of(segments).size(), 3U) << "the mark is kept for other endpoints";
  bridge.reset();
  EXPECT_EQ(files_of(segments).size(), 2U);
}

TEST_F(BetweenProcesses, ShareNoMemoryForImagesUnlessAsked) {
  const auto name = unique_topic("image");
  const auto reader = bridge->open_reader(topic(name, kImageType, interfaces::qos::kSensorData), inbox.callback());
  peer.ask("open_writer " + name + " " + kImageType + " best_effort volatile 5");
  ASSERT_TRUE(peer.matches(name, 1) && eventually([&] { return reader->matched_writers() == 1; }));
  EXPECT_TRUE(shared_by(getpid()).empty());
  EXPECT_TRUE(shared_by(peer.id()).empty());
}

}  // namespace
}  // namespace panvo::runtime::test
