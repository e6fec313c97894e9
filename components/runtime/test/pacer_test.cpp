// SPDX-License-Identifier: Apache-2.0
#include "pacer.hpp"

#include <gtest/gtest.h>

#include <future>
#include <limits>

namespace panvo::runtime {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Pacer, MakesStampsDueInProportionToTheRate) {
  Pacer pacer(2);
  pacer.start(100 * kSecond, 5 * kSecond);
  EXPECT_EQ(pacer.state().due_ns(100 * kSecond), 5 * kSecond);
  EXPECT_EQ(pacer.state().due_ns(104 * kSecond), 7 * kSecond);
}

TEST(Pacer, ContinuesWhereItWasPaused) {
  Pacer pacer;
  pacer.pause();  // before the run, as a component does
  pacer.start(100 * kSecond, 5 * kSecond);
  EXPECT_TRUE(pacer.is_paused());
  pacer.resume();
  const auto state = pacer.state();
  EXPECT_FALSE(state.is_paused);
  EXPECT_EQ(state.stamp_ns, 100 * kSecond);  // time passed, but nothing was played
  EXPECT_EQ(state.due_ns(101 * kSecond), state.since_ns + kSecond);
}

TEST(Pacer, ChangesTheRateFromThePresentStampOn) {
  Pacer pacer;
  pacer.start(100 * kSecond, 5 * kSecond);
  pacer.pause();
  const std::int64_t stamp_ns = pacer.state().stamp_ns;
  EXPECT_TRUE(pacer.set_rate(4));
  pacer.resume();
  const auto state = pacer.state();
  EXPECT_EQ(state.stamp_ns, stamp_ns);
  EXPECT_EQ(state.due_ns(stamp_ns + 4 * kSecond), state.since_ns + kSecond);
}

TEST(Pacer, RefusesRatesThatAreNone) {
  Pacer pacer;
  pacer.start(0, 0);
  for (const double rate :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(pacer.set_rate(rate)) << rate;
  EXPECT_EQ(pacer.rate(), 1);
  EXPECT_FALSE(Pacer(0).set_rate(1)) << "played as fast as possible";
}

TEST(Pacer, KeepsTheOrderOfTimesAtAnyRate) {
  Pacer pacer;
  pacer.start(100 * kSecond, 5 * kSecond);
  EXPECT_TRUE(pacer.set_rate(1e-300));
  auto state = pacer.state();
  EXPECT_GT(state.due_ns(state.stamp_ns + 1), state.since_ns + 1'000'000'000 * kSecond);
  EXPECT_EQ(state.due_ns(state.stamp_ns), state.since_ns);
  EXPECT_LT(state.due_ns(state.stamp_ns - 1), state.since_ns);
  EXPECT_TRUE(pacer.set_rate(1e300));
  EXPECT_EQ(pacer.state().due_ns(200 * kSecond), pacer.state().since_ns);
  pacer.start(100 * kSecond, 0);
  pacer.pause();
  EXPECT_GT(pacer.state().stamp_ns, 1'000'000'000 * kSecond);
  pacer.resume();
  pacer.start(std::numeric_limits<std::int64_t>::max(), 0);  // nothing to play
  pacer.pause();
  EXPECT_EQ(pacer.state().stamp_ns, std::numeric_limits<std::int64_t>::max());
}

TEST(Pacer, KeepsARateThatWasSetBeforeTheRun) {
  Pacer pacer(1);
  EXPECT_TRUE(pacer.set_rate(8));
  pacer.start(100 * kSecond, 5 * kSecond);
  EXPECT_EQ(pacer.rate(), 8);
  EXPECT_EQ(pacer.state().due_ns(108 * kSecond), 6 * kSecond);
}

/// Records where it is moved.
class MovableSource final : public Source {
 public:
  explicit MovableSource(std::optional<StampRange> range) : range_(range) {}
  std::optional<std::int64_t> next_stamp_ns() override { return std::nullopt; }
  void emit() override {}
  Progress progress() const override { return {}; }
  std::optional<StampRange> range() const override { return range_; }
  void seek(std::int64_t stamp_ns) override { moved_to.push_back(stamp_ns); }

  std::vector<std::int64_t> moved_to;

 private:
  const std::optional<StampRange> range_;
};

TEST(Pacer, MovesTheSourcesThatCanBeMovedWithinWhatTheyHold) {
  MovableSource first({{100, 200}}), second({{150, 300}}), fixed(std::nullopt);
  Pacer pacer;
  EXPECT_FALSE(pacer.range());
  EXPECT_FALSE(pacer.seek(120)) << "nothing is played";
  for (auto* source : {&first, &second, &fixed}) pacer.add(*source);
  ASSERT_TRUE(pacer.range());
  EXPECT_EQ(pacer.range()->first_ns, 100);
  EXPECT_EQ(pacer.range()->last_ns, 300);
  for (const std::int64_t to : {50, 250, 400}) EXPECT_TRUE(pacer.seek(to));
  EXPECT_EQ(first.moved_to, (std::vector<std::int64_t>{100, 250, 300}));
  EXPECT_EQ(second.moved_to, first.moved_to);
  EXPECT_TRUE(fixed.moved_to.empty());
  pacer.remove(second);
  EXPECT_EQ(pacer.range()->last_ns, 200);
  pacer.remove(first);
  EXPECT_FALSE(pacer.range());
}

TEST(Pacer, TellsOfEachChangeOnce) {
  MovableSource source({{0, 10 * kSecond}});
  Pacer pacer;
  pacer.add(source);
  int changes = 0, moves = 0;
  pacer.on_change([&] { ++changes; }, [&] { ++moves; });
  const auto before = pacer.state().version;
  pacer.pause();
  pacer.pause();
  EXPECT_EQ(changes, 1);
  pacer.seek(7 * kSecond);
  EXPECT_EQ(changes, 2);
  EXPECT_EQ(moves, 1);
  EXPECT_EQ(pacer.state().stamp_ns, 7 * kSecond);
  EXPECT_EQ(pacer.state().version, before + 2);
}

TEST(Pacer, TellsItsRangeToOtherThreadsWhileItTellsOfAMove) {
  MovableSource source({{100, 200}});
  Pacer pacer;
  pacer.add(source);
  std::future<std::optional<StampRange>> range;
  bool is_told = false;
  pacer.on_change(
      [&] {
        range = std::async(std::launch::async, [&] { return pacer.range(); });
        is_told = range.wait_for(std::chrono::seconds(5)) == std::future_status::ready;
      },
      [] {});
  pacer.seek(150);
  EXPECT_TRUE(is_told) << "a lock that seek() holds: with those of the listener, a deadlock";
}

TEST(Pacer, KnowsTheStampThatIsReached) {
  MovableSource source({{0, 10}});
  Pacer pacer;
  pacer.add(source);
  EXPECT_EQ(pacer.stamp_ns(), std::nullopt);
  pacer.reach(8);
  EXPECT_EQ(pacer.stamp_ns(), 8);
  pacer.pause();
  pacer.seek(5);
  EXPECT_EQ(pacer.stamp_ns(), 5) << "paused, no step tells it";
}

}  // namespace
}  // namespace panvo::runtime
