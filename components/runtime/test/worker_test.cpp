// SPDX-License-Identifier: Apache-2.0
#include "worker.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>

namespace panvo::runtime {
namespace {

/// A live worker whose first task blocks until released, so later tasks are queued.
struct BusyWorker {
  StageTimes times;
  std::atomic<std::int64_t> in_flight = 0;
  std::string failure;
  std::promise<void> failed, started, release;
  Worker worker{"busy",
                times,
                nullptr,
                {.failed =
                     [this](const std::string& what) {
                       failure = what;
                       failed.set_value();
                     },
                 .progressed = [] {},
                 .in_flight = &in_flight}};

  void block(bool gives_way = false) {
    Port& port = worker.add_port("block", 1, false, [this](Task&) {
      started.set_value();
      release.get_future().wait();
    });
    worker.start(gives_way);
    worker.push(port, {});
    started.get_future().wait();
  }
};

Task stamped(std::int64_t stamp_ns) { return {.stamp_ns = stamp_ns}; }

TEST(Worker, KeepsTheNewestAndCountsWhatItDropped) {
  BusyWorker busy;
  std::vector<std::int64_t> handled;
  std::promise<void> last;
  Port& port = busy.worker.add_port("in", 2, false, [&](Task& task) {
    handled.push_back(task.stamp_ns);
    if (task.stamp_ns == 5) last.set_value();
  });
  busy.block();
  for (int i = 1; i <= 5; ++i) busy.worker.push(port, stamped(i));
  busy.release.set_value();
  last.get_future().wait();
  busy.worker.stop();
  EXPECT_EQ(handled, (std::vector<std::int64_t>{4, 5}));
  const auto counters = busy.worker.counters().front();
  EXPECT_EQ(counters.received, 5U);
  EXPECT_EQ(counters.handled, 2U);
  EXPECT_EQ(counters.dropped, 3U);
  EXPECT_EQ(busy.in_flight, 0);
}

TEST(Worker, OfOneInputDropsNothingForTheSakeOfAnother) {
  BusyWorker busy;
  std::vector<std::string> handled;
  std::promise<void> last;
  Port& slow = busy.worker.add_port("slow", 1, false, [&](Task&) { handled.push_back("slow"); });
  Port& fast = busy.worker.add_port("fast", 1, false, [&](Task& task) {
    handled.push_back("fast");
    if (task.stamp_ns == 9) last.set_value();
  });
  busy.block();
  busy.worker.push(slow, stamped(0));
  for (int i = 1; i <= 9; ++i) busy.worker.push(fast, stamped(i));
  busy.release.set_value();
  last.get_future().wait();
  busy.worker.stop();
  EXPECT_EQ(handled, (std::vector<std::string>{"slow", "fast"}));
}

TEST(Worker, GivesWayIfToldSo) {
  const auto nice_now = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); };
  const auto nice_of = [&](bool gives_way) {
    BusyWorker busy;
    std::promise<int> nice;
    Port& port = busy.worker.add_port("in", 1, false, [&](Task&) { nice.set_value(nice_now()); });
    busy.block(gives_way);
    busy.worker.push(port, {});
    busy.release.set_value();
    const int told = nice.get_future().get();
    busy.worker.stop();
    return told;
  };
  EXPECT_EQ(nice_of(false), nice_now());
  EXPECT_EQ(nice_of(true), std::min(nice_now() + 10, 19));
}

TEST(Worker, ReleasesWhoeverWaitsForRoomWhenItStops) {
  BusyWorker busy;
  Port& port = busy.worker.add_port("stage", 1, true, [](Task&) {});
  busy.block();
  busy.worker.push(port, {});
  auto waiting = std::async(std::launch::async, [&] { busy.worker.push(port, {}); });
  auto stopping = std::async(std::launch::async, [&] { busy.worker.stop(); });
  busy.release.set_value();
  waiting.get();  // would hang
  stopping.get();
  EXPECT_EQ(busy.in_flight, 0);
}

TEST(Worker, HandlesWhatWaitsAtItsEndIfThePortIsToComplete) {
  BusyWorker busy;
  std::vector<std::int64_t> handled;
  Port& tap = busy.worker.add_port("tap", 9, false, [&](Task& task) { handled.push_back(task.stamp_ns); });
  tap.completes = true;
  Port& stage = busy.worker.add_port("stage", 1, true, [](Task&) {});
  busy.block();
  for (int i = 1; i <= 3; ++i) busy.worker.push(tap, stamped(i));
  busy.worker.push(stage, {});
  auto waiting = std::async(std::launch::async, [&] { busy.worker.push(stage, {}); });
  auto stopping = std::async(std::launch::async, [&] { busy.worker.stop(); });
  waiting.get();  // so it is stopping
  busy.release.set_value();
  stopping.get();
  EXPECT_EQ(handled, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(busy.worker.counters().at(0).handled, 3U);
  EXPECT_EQ(busy.worker.counters().at(0).dropped, 0U);
  EXPECT_EQ(busy.worker.counters().at(1).dropped, 2U);
  EXPECT_EQ(busy.in_flight, 0);
}

TEST(Worker, HandlesNothingThatCameBeforeAStartThatFailed) {
  BusyWorker busy;
  int handled = 0;
  Port& tap = busy.worker.add_port("tap", 9, false, [&](Task&) { ++handled; });
  tap.completes = true;
  busy.worker.push(tap, {});
  busy.worker.stop();
  EXPECT_EQ(handled, 0);
  EXPECT_EQ(busy.worker.counters().front().dropped, 1U);
}

TEST(Worker, IsEndedByWhatATaskThrowsAndSaysWhat) {
  BusyWorker busy;
  Port& port = busy.worker.add_port("in", 4, false, [](Task&) { throw std::runtime_error("matrix is singular"); });
  busy.worker.start();
  busy.worker.push(port, {});
  busy.failed.get_future().wait();
  EXPECT_TRUE(busy.worker.failed());
  EXPECT_EQ(busy.failure, "matrix is singular");
}

TEST(Worker, CountsUndecodableMessagesAndGoesOn) {
  BusyWorker busy;
  std::promise<void> done;
  Port& port = busy.worker.add_port("in", 4, false, [&](Task& task) {
    if (task.stamp_ns == 1) throw interfaces::DecodeError("truncated");
    done.set_value();
  });
  busy.worker.start();
  busy.worker.push(port, stamped(1));
  busy.worker.push(port, stamped(2));
  done.get_future().wait();
  busy.worker.stop();
  EXPECT_FALSE(busy.worker.failed());
  EXPECT_EQ(busy.worker.counters().front().undecodable, 1U);
}

TEST(ReplayOrder, HandlesTasksOfAllWorkersFirstInFirstOut) {
  StageTimes times;
  std::atomic<std::int64_t> in_flight = 0;
  PassingTime time{PassingTime::Pace::kTasks, [] { return 0; }};
  ReplayOrder order(time);
  std::string handled;
  Worker first("first", times, &order, {.failed = {}, .progressed = [] {}, .in_flight = &in_flight});
  Worker second("second", times, &order, {.failed = {}, .progressed = [] {}, .in_flight = &in_flight});
  Port& out = second.add_port("out", 1, false, [&](Task&) { handled += "o"; });
  Port& in = first.add_port("in", 1, false, [&](Task&) {
    handled += "i";
    second.push(out, {});
  });
  first.push(in, {});
  first.push(in, {});
  while (order.run_one()) {
  }
  EXPECT_EQ(handled, "iioo");
  EXPECT_EQ(in_flight, 0);
}

TEST(Worker, FiresATimerWhateverArrives) {
  BusyWorker busy;
  std::promise<void> third;
  int fired = 0;
  busy.worker.add_timer(1'000'000, [&] {
    if (++fired == 3) third.set_value();
  });
  busy.worker.start();
  third.get_future().wait();
  busy.worker.stop();
  EXPECT_GE(fired, 3);
}

TEST(Worker, MakesUpForNoneOfTheTimesThatATimerMissed) {
  BusyWorker busy;
  int fired = 0;
  std::promise<void> last;
  busy.worker.add_timer(1'000'000, [&] { ++fired; });
  std::promise<int> fired_while_busy;
  Port& slow = busy.worker.add_port("slow", 1, false, [&](Task&) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    while (std::chrono::steady_clock::now() < until) {
    }
    fired = 0;
  });
  Port& next = busy.worker.add_port("next", 1, false, [&](Task&) { fired_while_busy.set_value(fired); });
  busy.worker.start();
  busy.worker.push(slow, {});
  busy.worker.push(next, {});
  EXPECT_LE(fired_while_busy.get_future().get(), 1) << "of the fifty that were due";
  busy.worker.stop();
}

TEST(Worker, ATimerThatThrowsStopsItAndIsReported) {
  BusyWorker busy;
  busy.worker.add_timer(1'000'000, [] { throw std::runtime_error("the timer is wrong"); });
  busy.worker.start();
  busy.failed.get_future().wait();
  EXPECT_EQ(busy.failure, "the timer is wrong");
  EXPECT_TRUE(busy.worker.failed());
}

struct TimersOfAReplay : testing::Test {
  StageTimes times;
  std::atomic<std::int64_t> in_flight = 0;
  PassingTime time{PassingTime::Pace::kTasks, [] { return 0; }};
  ReplayOrder order{time};
  Worker worker{"worker", times, &order, {.failed = {}, .progressed = [] {}, .in_flight = &in_flight}};
  std::vector<std::int64_t> fired;
  Port& in = worker.add_port("in", 1, false, [this](Task& task) { fired.push_back(-task.stamp_ns); });

  void handle(std::int64_t stamp_ns) {
    worker.push(in, stamped(stamp_ns));
    while (order.run_one()) {
    }
  }
};

TEST_F(TimersOfAReplay, FireWhenTheTimeOfWhatIsHandledPassesTheirs) {
  worker.add_timer(100, [&] { fired.push_back(time.now_ns()); });
  for (const std::int64_t stamp_ns : {1000, 1050, 1099, 1100, 1350}) handle(stamp_ns);
  EXPECT_EQ(fired, (std::vector<std::int64_t>{-1000, -1050, -1099, 1100, -1100, 1200, 1300, -1350}));
}

TEST_F(TimersOfAReplay, FireInTheOrderInWhichTheyAreDue) {
  worker.add_timer(100, [&] { fired.push_back(100); });
  worker.add_timer(70, [&] { fired.push_back(70); });
  handle(0);
  handle(220);
  EXPECT_EQ(fired, (std::vector<std::int64_t>{0, 70, 100, 70, 100, 70, -220}));
}

TEST_F(TimersOfAReplay, ThatMissedYearsFireABoundedNumberOfTimes) {
  int count = 0;
  worker.add_timer(100'000'000, [&] { ++count; });
  handle(1'700'000'000'000'000'000);
  handle(2'147'483'647'000'000'000);
  EXPECT_LE(count, 101);
}

}  // namespace
}  // namespace panvo::runtime
