// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/sample.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "sensor_msgs/msg/Image.h"

namespace panvo::runtime {
namespace {

std::atomic<int> serialisations = 0;

/// Image's type with counted serialisations.
interfaces::MessageType counting_type() {
  interfaces::MessageType type = interfaces::message_type<sensor_msgs::msg::Image>();
  type.serialize = [](const void* message, std::span<std::uint8_t> out) {
    ++serialisations;
    interfaces::message_type<sensor_msgs::msg::Image>().serialize(message, out);
  };
  return type;
}

TEST(Sample, HandsOverTheVeryMessageThatWasPublished) {
  const auto image = std::make_shared<const sensor_msgs::msg::Image>();
  const SamplePtr sample = Sample::of(interfaces::message_type<sensor_msgs::msg::Image>(), image, 7);
  EXPECT_EQ(Sample::as<sensor_msgs::msg::Image>(sample).get(), image.get());
  EXPECT_EQ(sample->time_ns(), 7);
}

TEST(Sample, IsSerialisedOnceHoweverManyWantItsBytes) {
  static const interfaces::MessageType type = counting_type();
  serialisations = 0;
  const SamplePtr sample = Sample::of(type, std::make_shared<const sensor_msgs::msg::Image>(), 0);
  EXPECT_EQ(serialisations, 0);
  std::thread other([&] { sample->bytes(); });
  const auto& bytes = sample->bytes();
  other.join();
  EXPECT_EQ(serialisations, 1);
  EXPECT_EQ(bytes.size(), type.serialized_size(sample->message()));
}

TEST(Sample, IsSerialisedIntoMemoryOfTheCallersAsItsBytesAre) {
  sensor_msgs::msg::Image image;
  image.encoding("mono8");
  image.data({1, 2, 3});
  const auto& type = interfaces::message_type<sensor_msgs::msg::Image>();
  const SamplePtr sample = Sample::of(type, std::make_shared<const sensor_msgs::msg::Image>(image), 0);
  interfaces::Bytes before(sample->serialized_size());
  sample->serialize_to(before);
  EXPECT_EQ(before, sample->bytes());
  interfaces::Bytes after(sample->serialized_size());  // bytes() now exists and is copied
  sample->serialize_to(after);
  EXPECT_EQ(after, before);
}

TEST(Sample, ReadsItsMessageFromBytes) {
  sensor_msgs::msg::Image image;
  image.encoding("mono8");
  image.data({1, 2, 3});
  const auto& type = interfaces::message_type<sensor_msgs::msg::Image>();
  const SamplePtr sent = Sample::of(type, std::make_shared<const sensor_msgs::msg::Image>(image), 0);
  const SamplePtr received = Sample::from_bytes(&type, "sensor_msgs/msg/Image", sent->bytes(), 0);
  EXPECT_EQ(*Sample::as<sensor_msgs::msg::Image>(received), image);
}

TEST(Sample, OfAnUnknownTypeMayBeEmpty) {
  const SamplePtr sample = Sample::from_bytes(nullptr, "other_msgs/msg/Other", {}, 0);
  EXPECT_TRUE(sample->bytes().empty());
  EXPECT_EQ(sample->serialized_size(), 0U);
}

TEST(Sample, RefusesBytesThatAreNoMessageOfItsType) {
  const auto& type = interfaces::message_type<sensor_msgs::msg::Image>();
  const SamplePtr sample = Sample::from_bytes(&type, "sensor_msgs/msg/Image", {0, 1, 0, 0, 9}, 0);
  EXPECT_THROW(sample->message(), interfaces::DecodeError);
}

TEST(Sample, KeepsItsPluginUntilTheMessageIsGone) {
  auto plugin = std::make_shared<int>(1);
  const std::weak_ptr<int> alive = plugin;
  auto message = Sample::as<sensor_msgs::msg::Image>(Sample::of(interfaces::message_type<sensor_msgs::msg::Image>(),
                                                                std::make_shared<const sensor_msgs::msg::Image>(), 0,
                                                                std::move(plugin)));
  EXPECT_FALSE(alive.expired());
  message.reset();
  EXPECT_TRUE(alive.expired());
}

TEST(Sample, IsReadFromWhereItIsStoredWhenItIsNeeded) {
  sensor_msgs::msg::Image image;
  image.header().stamp().sec(3);
  image.width(5);
  const auto& type = interfaces::message_type<sensor_msgs::msg::Image>();
  const SamplePtr published = Sample::of(type, std::make_shared<const sensor_msgs::msg::Image>(image), 7);
  int reads = 0;
  const SamplePtr stored = published->stored([&, bytes = published->bytes()] {
    ++reads;
    return bytes;
  });
  EXPECT_EQ(stored->stamp_ns(), 3'000'000'000);
  EXPECT_EQ(reads, 0) << "its stamp is known";
  EXPECT_EQ(Sample::as<sensor_msgs::msg::Image>(stored)->width(), 5U);
  EXPECT_EQ(stored->bytes(), published->bytes());
  EXPECT_EQ(reads, 1);
  const SamplePtr other = Sample::unread(stored);
  EXPECT_EQ(reads, 1);
  EXPECT_EQ(other->bytes(), published->bytes());
  EXPECT_EQ(reads, 2);
  EXPECT_EQ(Sample::unread(published), published);
}

}  // namespace
}  // namespace panvo::runtime
