// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/reconnection.hpp"

#include <gtest/gtest.h>

namespace panvo::camera_stream {
namespace {

using Action = Reconnection::Action;
using Loss = Reconnection::Loss;
using State = Reconnection::State;

constexpr Reconnection::Settings kSettings{.watchdog_ns = 1000, .retry_ns = 250};

/// A camera that streamed until `now_ns`.
Reconnection streaming(std::int64_t now_ns) {
  Reconnection machine(kSettings);
  machine.step(0);
  machine.opened(0);
  for (std::int64_t t = 0; t <= now_ns; t += 50) machine.frame(t);
  return machine;
}

/// Steps as often as a driver does, until `to_ns` or the first action.
Action watch(Reconnection& machine, std::int64_t from_ns, std::int64_t to_ns) {
  Action action = Action::kNone;
  for (std::int64_t t = from_ns; t < to_ns && action == Action::kNone; t += 50) action = machine.step(t);
  return action == Action::kNone ? machine.step(to_ns) : action;
}

TEST(Reconnection, OpensAtOnceAndThenStreams) {
  Reconnection machine(kSettings);
  EXPECT_EQ(machine.step(0), Action::kOpen);
  EXPECT_EQ(machine.state(), State::kOpening);
  EXPECT_EQ(machine.step(10), Action::kNone);
  machine.opened(20);
  machine.frame(30);
  EXPECT_EQ(machine.step(500), Action::kNone);
  EXPECT_EQ(machine.state(), State::kStreaming);
  EXPECT_EQ(machine.reconnects(), 0u);
}

TEST(Reconnection, TriesAgainAfterAWhile) {
  Reconnection machine(kSettings);
  machine.step(0);
  machine.failed(100);
  EXPECT_EQ(machine.step(349), Action::kNone);
  EXPECT_EQ(machine.step(350), Action::kOpen);
}

TEST(Reconnection, ClosesACameraThatIsSilentAndOpensItAgain) {
  auto machine = streaming(2000);
  EXPECT_EQ(watch(machine, 2050, 3000), Action::kNone);
  EXPECT_EQ(machine.step(3001), Action::kClose);
  EXPECT_EQ(machine.last_loss(), Loss::kNoFrames);
  EXPECT_EQ(machine.step(3001), Action::kOpen);
  machine.opened(3100);
  EXPECT_EQ(machine.reconnects(), 0u) << "opened, but no frame yet";
  machine.frame(3110);
  machine.frame(3120);
  EXPECT_EQ(machine.reconnects(), 1u);
}

TEST(Reconnection, DoesNotWaitForTheWatchdogWhenTheDeviceIsGone) {
  auto machine = streaming(2000);
  machine.device_gone();
  EXPECT_EQ(machine.step(2010), Action::kClose);
  EXPECT_EQ(machine.last_loss(), Loss::kDeviceGone);
  machine.step(2010);
  machine.opened(2020);
  EXPECT_EQ(machine.step(2030), Action::kNone) << "the report about the old device does not apply to the new one";
}

TEST(Reconnection, WatchesACameraThatOpensAndSendsNothing) {
  Reconnection machine(kSettings);
  machine.step(0);
  machine.opened(100);
  EXPECT_EQ(watch(machine, 150, 1100), Action::kNone);
  EXPECT_EQ(machine.step(1101), Action::kClose);
  EXPECT_FALSE(machine.has_streamed());
}

TEST(Reconnection, DoesNotTakeACameraForSilentWhileItWasKeptFromWatching) {
  auto machine = streaming(2000);
  EXPECT_EQ(watch(machine, 2050, 2100), Action::kNone);
  EXPECT_EQ(machine.step(1'000'000), Action::kNone) << "the host was suspended";
  machine.frame(1'000'010);
  EXPECT_EQ(watch(machine, 1'000'050, 1'001'010), Action::kNone);
  EXPECT_EQ(watch(machine, 1'001'011, 1'001'100), Action::kClose) << "now the camera is silent";
}

TEST(Reconnection, FindsSilenceAlsoWhereItIsOftenKeptFromWatching) {
  auto machine = streaming(2000);
  EXPECT_EQ(machine.step(3000), Action::kNone);
  EXPECT_EQ(machine.step(4000), Action::kNone);
  EXPECT_EQ(machine.step(5000), Action::kNone);
  EXPECT_EQ(machine.step(6000), Action::kNone);
  EXPECT_EQ(machine.step(7000), Action::kClose);
}

TEST(Reconnection, CountsWhatCameBackOnly) {
  Reconnection machine(kSettings);
  machine.step(0);
  machine.opened(0);
  ASSERT_EQ(watch(machine, 0, 1500), Action::kClose) << "silent from the start";
  ASSERT_EQ(machine.step(1500), Action::kOpen);
  machine.opened(1600);
  machine.frame(1700);
  EXPECT_EQ(machine.reconnects(), 0u);
  for (int i = 1; i <= 20; ++i) {
    machine.device_gone();
    ASSERT_EQ(machine.step(2000 * i), Action::kClose);
    ASSERT_EQ(machine.step(2000 * i), Action::kOpen);
    machine.failed(2000 * i);
    ASSERT_EQ(machine.step(2000 * i + 250), Action::kOpen);
    machine.opened(2000 * i + 300);
    machine.frame(2000 * i + 310);
    EXPECT_EQ(machine.reconnects(), static_cast<std::uint64_t>(i));
  }
}

TEST(Reconnection, LeavesACameraThatWaitsForATriggerAlone) {
  Reconnection machine({.watchdog_ns = 0, .retry_ns = 250});
  machine.step(0);
  machine.opened(0);
  EXPECT_EQ(machine.step(1'000'000'000'000), Action::kNone);
  machine.device_gone();
  EXPECT_EQ(machine.step(1'000'000'000'001), Action::kClose);
}

}  // namespace
}  // namespace panvo::camera_stream
