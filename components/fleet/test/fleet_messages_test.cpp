// SPDX-License-Identifier: Apache-2.0
#include "fleet_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "made_up_maps.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/interfaces/fleet_validity.hpp"

namespace panvo::fleet {
namespace {

using interfaces::problem_of;
using testing::HasSubstr;
using testing::Optional;

const landmarks::DescriptionSettings kSettings{{"histogram_bins", "2"}, {"patches", "400"}};
const Sender kSender{"one", "map", 5};

template <class Message>
Message over_the_wire(const Message& message) {
  const auto& type = interfaces::message_type<Message>();
  interfaces::Bytes bytes(type.serialized_size(&message));
  type.serialize(&message, bytes);
  return *std::static_pointer_cast<const Message>(type.deserialize(bytes));
}

SharedMap example_map() {
  SharedMap map(11, 3, 100);
  map.add(place_at(1, flat(1, 2, 0.5)));
  map.add(place_at(2, flat(11, 2, 0.7)));
  map.add(Sighting{4, 1, {22, 9}, flat(1, -1, 2.0), covariance_of(0.05, 0.003), 40, 12.5});
  return map;
}

TEST(FleetMessages, CarryAMapToAnEqualOne) {
  auto map = example_map();
  SharedMap replica(11, 3, 100);
  const auto whole = to_changes(over_the_wire(to_message(*map.since(0, 9, 9), kSender)), kSettings);
  ASSERT_TRUE(whole) << whole.reason();
  EXPECT_EQ(replica.apply(*whole), SharedMap::Applied::kApplied);
  map.move({{2, flat(12, 2, 0.8), covariance_of(0.3, 0.02)}}, 0.01, 0.01);
  const auto moved = to_changes(over_the_wire(to_message(*map.since(3, 9, 9), kSender)), kSettings);
  ASSERT_TRUE(moved) << moved.reason();
  EXPECT_EQ(replica.apply(*moved), SharedMap::Applied::kApplied);
  EXPECT_EQ(replica.digest(), map.digest());
  EXPECT_TRUE(replica.find(2)->map_from_base.isApprox(flat(12, 2, 0.8)));
  const auto& sighting = replica.sightings().at(4).sighting;
  EXPECT_EQ(sighting.seen, (PlaceKey{22, 9}));
  EXPECT_TRUE(sighting.own_from_seen.isApprox(flat(1, -1, 2.0)));
  EXPECT_TRUE(sighting.covariance.isApprox(covariance_of(0.05, 0.003)));
}

TEST(FleetMessages, CarryAnnouncementsRequestsAndKeypoints) {
  const Announcement said{"one", 11, 3, 17, 0xabcdef0123456789U, 5, "patches=400\n", 11};
  const auto heard = to_announcement(over_the_wire(to_message(said, kSender)));
  EXPECT_EQ(heard.robot, "one");
  EXPECT_EQ(heard.version, 17U);
  EXPECT_EQ(heard.digest, said.digest);
  EXPECT_EQ(heard.settings, said.settings);

  const auto gap = to_request(over_the_wire(to_message(Request{22, 0, {}}, kSender)));
  EXPECT_EQ(gap.from_version, std::optional<std::uint64_t>(0));
  const auto wish = to_request(over_the_wire(to_message(Request{22, std::nullopt, {4, 5}}, kSender)));
  EXPECT_EQ(wish.from_version, std::nullopt);
  EXPECT_EQ(wish.keypoints, (std::vector<std::uint32_t>{4, 5}));

  landmarks::Keypoint keypoint;
  keypoint.descriptor.fill(7);
  keypoint.has_point = true;
  keypoint.point_in_panorama = {1, 2, 3};
  const auto answer = to_answer(over_the_wire(to_message(KeypointAnswer{11, 4, {keypoint}}, kSender)));
  EXPECT_EQ(answer.place, 4U);
  ASSERT_EQ(answer.keypoints.size(), 1U);
  EXPECT_EQ(answer.keypoints[0], keypoint);
}

TEST(FleetMessages, AreValidAsTheyAreMade) {
  auto map = example_map();
  EXPECT_EQ(problem_of(to_message(*map.since(0, 9, 9), kSender)), std::nullopt);
  EXPECT_EQ(problem_of(to_message(Announcement{"one", 11, 3, 17, 1, 5, "a=1\n", 11}, kSender)), std::nullopt);
  EXPECT_EQ(problem_of(to_message(Request{22, 0, {}}, kSender)), std::nullopt);
  EXPECT_EQ(problem_of(to_message(KeypointAnswer{11, 4, {}}, kSender)), std::nullopt);
}

TEST(FleetMessages, AreRefusedWithValuesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto map = example_map();
  auto message = to_message(*map.since(0, 9, 9), kSender);
  auto broken = message;
  broken.places()[0].pose().pose().position().x(nan);
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("places have an invalid landmark: pose.pose.position")));
  broken = message;
  broken.places()[0].large_features()[0].value(std::numeric_limits<float>::infinity());
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("large_features.value")));
  broken = message;
  broken.sightings()[0].own_from_seen().pose().position().y(1e300);
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("sightings.own_from_seen.pose.position")));
  broken = message;
  broken.sightings()[0].own_from_seen().covariance()[0] = 0.0;
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("sightings.own_from_seen.covariance")));
  broken = message;
  broken.sightings()[0].travelled_m(nan);
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("sightings.travelled_m")));
}

TEST(FleetMessages, AreRefusedIfTheyAreHuge) {
  auto map = example_map();
  const auto message = to_message(*map.since(0, 9, 9), kSender);
  auto broken = message;
  broken.places().resize(interfaces::kMaxFleetPlaces + 1, broken.places()[0]);
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("places is longer than 64")));
  broken = message;
  broken.places()[0].keypoints().resize(1);
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("places have keypoints")));
  broken = message;
  broken.robot(std::string(1000, 'x'));
  EXPECT_THAT(problem_of(broken), Optional(HasSubstr("robot")));
  auto request = to_message(Request{22, 0, {}}, kSender);
  request.keypoints().resize(1000);
  EXPECT_THAT(problem_of(request), Optional(HasSubstr("keypoints")));
}

TEST(FleetMessages, AreRefusedWithoutASenderOrAnOrder) {
  auto map = example_map();
  auto message = to_message(*map.since(0, 9, 9), kSender);
  message.robot("");
  EXPECT_EQ(problem_of(message), "robot is empty");
  message = to_message(*map.since(0, 9, 9), kSender);
  message.previous(message.version());
  EXPECT_EQ(problem_of(message), "version is not later than previous");
}

}  // namespace
}  // namespace panvo::fleet
