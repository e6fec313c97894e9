// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/container.hpp"
#include "panvo/interfaces/topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <numeric>

#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::runtime {
namespace {

using sensor_msgs::msg::Image;
using testing::ElementsAre;
using testing::HasSubstr;

Image image_at(std::int64_t stamp_ns, std::uint32_t size = 1) {
  Image image;
  image.encoding("mono8");
  image.width(size);
  image.height(1);
  image.step(size);
  image.header().stamp().sec(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  image.header().stamp().nanosec(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  image.data().resize(size);
  return image;
}

std::int64_t stamp_of(const Image& image) {
  return image.header().stamp().sec() * std::int64_t{1'000'000'000} + image.header().stamp().nanosec();
}

/// Plays images with the given stamps.
class Player : public Component, public Source {
 public:
  Player(Context& context, const interfaces::Topic<Image>& topic, std::vector<std::int64_t> stamps)
      : output_(context.output(topic)), stamps_(std::move(stamps)) {
    context.source(*this);
  }
  std::optional<std::int64_t> next_stamp_ns() override {
    return done_ < stamps_.size() ? std::optional(stamps_[done_]) : std::nullopt;
  }
  void emit() override { output_.publish(image_at(stamps_[done_++])); }
  Progress progress() const override { return {done_, stamps_.size()}; }

 private:
  Output<Image> output_;
  std::vector<std::int64_t> stamps_;
  std::size_t done_ = 0;
};

/// Records received messages.
struct Sink : Component {
  explicit Sink(Context& context, const interfaces::Topic<Image>& topic,
                std::function<void(std::shared_ptr<const Image>)> take) {
    context.input(topic, std::move(take));
  }
};

ComponentDescription named(const std::string& name) {
  ComponentDescription description;
  description.name = name;
  description.package = "panvo_" + name;
  description.name_space = "/";
  return description;
}

std::vector<std::int64_t> stamps(std::int64_t first, std::int64_t step, int count) {
  std::vector<std::int64_t> result(count);
  for (int i = 0; i < count; ++i) result[i] = first + i * step;
  return result;
}

TEST(Container, HandsAMessageToEveryReaderByPointer) {
  ComponentHarness harness;
  std::vector<const void*> seen;
  for (const char* name : {"first", "second"}) {
    harness.container().add(named(name), [&](Context& context) {
      return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw,
                                    [&](std::shared_ptr<const Image> image) { seen.push_back(image->data().data()); });
    });
  }
  auto image = std::make_shared<const Image>(image_at(1, 50'000));
  const void* pixels = image->data().data();
  harness.publish(topics::kStereoLeftImageRaw, image);
  EXPECT_THAT(seen, ElementsAre(pixels, pixels));
}

TEST(Container, ReplaysSourcesInOrderOfStamp) {
  Container container({.replay = true});
  std::vector<std::int64_t> seen;
  for (const auto* topic : {&topics::kStereoLeftImageRaw, &topics::kPanorama}) {
    container.add(named("sink" + std::to_string(seen.capacity()) + std::string(topic->name.substr(0, 4))),
                  [&](Context& context) {
                    return std::make_unique<Sink>(
                        context, *topic, [&](std::shared_ptr<const Image> image) { seen.push_back(stamp_of(*image)); });
                  });
  }
  container.add(named("slow"),
                [](Context& context) { return std::make_unique<Player>(context, topics::kPanorama, stamps(0, 5, 3)); });
  container.add(named("quick"), [](Context& context) {
    return std::make_unique<Player>(context, topics::kStereoLeftImageRaw, stamps(1, 3, 4));
  });
  EXPECT_TRUE(container.run().empty());
  EXPECT_THAT(seen, ElementsAre(0, 1, 4, 5, 7, 10, 10));
}

TEST(Container, AtFullSpeedDropsNothingHoweverSlowAComponentIs) {
  Container container({.replay = false, .rate = 0});
  std::atomic<int> handled = 0;
  container.add(named("player"), [](Context& context) {
    return std::make_unique<Player>(context, topics::kStereoLeftImageRaw, stamps(0, 1, 200));
  });
  container.add(named("sink"), [&](Context& context) {
    return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw, [&](std::shared_ptr<const Image>) {
      volatile double work = 0;
      for (int i = 0; i < 20000; ++i) work = work + i;
      ++handled;
    });
  });
  EXPECT_TRUE(container.run().empty());
  EXPECT_EQ(handled, 200);
  for (const auto& queue : container.queue_counters())
    EXPECT_EQ(queue.dropped, 0U) << queue.component << " " << queue.input;
}

TEST(Container, PairsMessagesOfOneStampAndCountsThoseLeftAlone) {
  struct Pairs : Component {
    explicit Pairs(Context& context, std::vector<std::int64_t>& seen) {
      context.input_pair(topics::kStereoLeftImageRaw, topics::kStereoRightImageRaw,
                         [&seen](std::shared_ptr<const Image> left, std::shared_ptr<const Image> right) {
                           EXPECT_EQ(stamp_of(*left), stamp_of(*right));
                           seen.push_back(stamp_of(*left));
                         });
    }
  };
  ComponentHarness harness;
  std::vector<std::int64_t> seen;
  harness.container().add(named("pairs"), [&](Context& context) { return std::make_unique<Pairs>(context, seen); });
  for (const int stamp : {1, 2, 4}) harness.publish(topics::kStereoLeftImageRaw, image_at(stamp));
  for (const int stamp : {1, 3, 4}) harness.publish(topics::kStereoRightImageRaw, image_at(stamp));
  EXPECT_THAT(seen, ElementsAre(1, 4));
  std::uint64_t dropped = 0;
  for (const auto& queue : harness.container().queue_counters()) dropped += queue.dropped;
  EXPECT_EQ(dropped, 2U);  // 2 and 3
}

/// Two stages; the second depends on the order of its items.
struct TwoStages : Component {
  TwoStages(Context& context, std::uint64_t& hash)
      : second(context.stage<std::int64_t>("second", 2,
                                           [&hash](std::int64_t stamp) { hash = (hash ^ stamp) * 1099511628211ULL; })) {
    context.input(topics::kStereoLeftImageRaw,
                  [this](std::shared_ptr<const Image> image) { second.push(stamp_of(*image)); });
  }
  Stage<std::int64_t> second;
};

TEST(Container, GivesStagesTheSameItemsInTheSameOrderLiveAndInReplay) {
  std::uint64_t hashes[2] = {1, 1};
  for (const bool replay : {false, true}) {
    Container container({.replay = replay});
    container.add(named("player"), [](Context& context) {
      return std::make_unique<Player>(context, topics::kStereoLeftImageRaw, stamps(0, 1, 500));
    });
    container.add(named("stages"),
                  [&](Context& context) { return std::make_unique<TwoStages>(context, hashes[replay]); });
    EXPECT_TRUE(container.run().empty());
  }
  EXPECT_NE(hashes[0], 1U);
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Container, GoesOnWhenOneComponentFailsAndSaysSoAtTheEnd) {
  ComponentHarness harness;
  int handled = 0;
  harness.container().add(named("broken"), [](Context& context) {
    return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw,
                                  [](std::shared_ptr<const Image>) { throw std::logic_error("index out of range"); });
  });
  harness.container().add(named("sound"), [&](Context& context) {
    return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw,
                                  [&](std::shared_ptr<const Image>) { ++handled; });
  });
  for (const int stamp : {1, 2, 3}) harness.publish(topics::kStereoLeftImageRaw, image_at(stamp));
  EXPECT_EQ(handled, 3);
  EXPECT_THAT(harness.container().run(), ElementsAre("broken stopped by an error, see the log"));
  EXPECT_TRUE(harness.log_contains("index out of range"));
}

TEST(Container, RefusesATopicOfAnotherTypeAndNamesBoth) {
  Container container({.replay = true});
  container.add(named("first"), [](Context& context) {
    return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw, [](std::shared_ptr<const Image>) {});
  });
  struct Wrong : Component {
    explicit Wrong(Context& context) {
      context.output(interfaces::Topic<nav_msgs::msg::Odometry>{"stereo/left/image_raw"});
    }
  };
  try {
    container.add(named("second"), [](Context& context) { return std::make_unique<Wrong>(context); });
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("/stereo/left/image_raw has type sensor_msgs/msg/Image here, not nav_msgs/msg/Odometry"));
  }
  EXPECT_THAT(container.components(), ElementsAre("first"));
}

TEST(Container, GivesLateReadersWhatATransientLocalTopicHolds) {
  ComponentHarness harness;
  harness.publish(topics::kTfStatic, tf2_msgs::msg::TFMessage{});
  int seen = 0;
  struct Late : Component {
    Late(Context& context, int& count) {
      context.input(topics::kTfStatic, [&count](std::shared_ptr<const tf2_msgs::msg::TFMessage>) { ++count; });
    }
  };
  harness.container().add(named("late"), [&](Context& context) { return std::make_unique<Late>(context, seen); });
  harness.container().run_until_quiet();
  EXPECT_EQ(seen, 1);
}

TEST(Container, StopsSoonWhenAskedThoughNoSourceEnds) {
  Container container({.replay = false});
  auto run = std::async(std::launch::async, [&] { return container.run(); });
  container.request_stop();
  EXPECT_TRUE(run.get().empty());
}

/// Records how it ends.
struct Ending : Component {
  Ending(Context& context, const std::function<void()>& end) { context.on_end(end); }
};

TEST(Container, HasComponentsFinishWhatTheyMadeAndCountsWhatFails) {
  Container container({.replay = true});
  int ended = 0;
  container.add(named("first"), [&](Context& context) {
    return std::make_unique<Ending>(context, [&ended] {
      ++ended;
      throw std::runtime_error("the disk is full");
    });
  });
  container.add(named("second"),
                [&](Context& context) { return std::make_unique<Ending>(context, [&ended] { ++ended; }); });
  EXPECT_THAT(container.run(), ElementsAre("first: the disk is full"));
  EXPECT_EQ(ended, 2);
}

/// Publishes one more image after all messages.
struct HoldingBack : Component {
  explicit HoldingBack(Context& context) : output(context.output(topics::kPanorama)) {
    context.before_end([this] { output.publish(image_at(7)); });
  }
  Output<Image> output;
};

TEST(Container, DeliversWhatComponentsHeldBackBeforeAnyOfThemEnds) {
  for (const bool replay : {true, false}) {
    for (const bool receives_first : {true, false}) {  // components end in the order in which they were added
      Container container({.replay = replay});
      std::vector<std::int64_t> seen;
      const auto add_sink = [&] {
        container.add(named("sink"), [&](Context& context) {
          context.on_end([&] { seen.push_back(-1); });
          return std::make_unique<Sink>(context, topics::kPanorama, [&](const std::shared_ptr<const Image>& image) {
            seen.push_back(stamp_of(*image));
          });
        });
      };
      if (receives_first) add_sink();
      container.add(named("holding_back"), [](Context& context) { return std::make_unique<HoldingBack>(context); });
      if (!receives_first) add_sink();
      container.add(named("player"), [](Context& context) {
        return std::make_unique<Player>(context, topics::kPanorama, std::vector<std::int64_t>{5});
      });
      EXPECT_THAT(container.run(), testing::IsEmpty());
      EXPECT_THAT(seen, ElementsAre(5, 7, -1)) << replay << receives_first;
    }
  }
}

TEST(Container, KnowsWhetherItWasStoppedBeforeAllWasPlayed) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  for (const bool replay : {true, false}) {
    for (const bool stops : {true, false}) {
      Container container({.replay = replay, .rate = 1});
      container.add(named("sink"), [&](Context& context) {
        return std::make_unique<Sink>(context, topics::kPanorama, [&](const auto&) {
          if (stops) container.request_stop();
        });
      });
      container.add(named("player"), [stops](Context& context) {
        return std::make_unique<Player>(context, topics::kPanorama, stamps(10, stops ? kHour_ns : 10, 2));
      });
      EXPECT_THAT(container.run(), testing::IsEmpty());
      EXPECT_EQ(container.was_interrupted(), stops) << replay;
      EXPECT_EQ(container.source_steps(), stops ? 1U : 2U) << replay;
    }
  }
}

TEST(Container, EndsWhenNoneOfItsComponentsIsLeft) {
  Container container({});
  std::shared_ptr<UntypedOutput> images;
  container.add(named("failing"), [&](Context& context) {
    images = context.open_output({std::string(topics::kPanorama.name), "sensor_msgs/msg/Image", topics::kPanorama.qos,
                                  &interfaces::message_type<Image>()});
    return std::make_unique<Sink>(context, topics::kPanorama, [](const auto&) { throw std::runtime_error("broken"); });
  });
  container.start();
  images->publish(std::make_shared<const Image>(image_at(1)));
  EXPECT_THAT(container.run(), ElementsAre(HasSubstr("failing stopped by an error")));
  images.reset();
}

TEST(Container, GivesEachComponentItsOwnSeedAndTheSameEachTime) {
  struct Seeded : Component {
    Seeded(Context& context, std::vector<std::uint64_t>& seeds) { seeds.push_back(context.seed()); }
  };
  std::vector<std::uint64_t> seeds;
  for (const std::uint64_t seed : {1, 1, 2}) {
    Container container({.replay = true, .seed = seed});
    for (const char* name : {"a", "b"}) {
      container.add(named(name), [&](Context& context) { return std::make_unique<Seeded>(context, seeds); });
    }
  }
  EXPECT_EQ(seeds[0], seeds[2]);
  EXPECT_EQ(seeds[1], seeds[3]);
  EXPECT_NE(seeds[0], seeds[1]);
  EXPECT_NE(seeds[0], seeds[4]);
}

/// Records the time periodically.
struct Ticker : Component {
  Ticker(Context& context, std::chrono::nanoseconds period, std::function<void(std::int64_t)> take) {
    context.every(period, [&context, take = std::move(take)] { take(context.passing_ns()); });
  }
};

TEST(Container, FiresTimersInReplayByTheTimeOfWhatIsPlayed) {
  std::vector<std::int64_t> seen;
  Container container({.replay = true});
  container.add(named("player"), [](Context& context) {
    return std::make_unique<Player>(context, topics::kStereoLeftImageRaw, std::vector<std::int64_t>{1000, 1050, 1320});
  });
  container.add(named("ticker"), [&](Context& context) {
    return std::make_unique<Ticker>(context, std::chrono::nanoseconds(100),
                                    [&](std::int64_t now) { seen.push_back(now); });
  });
  container.add(named("sink"), [&](Context& context) {
    return std::make_unique<Sink>(context, topics::kStereoLeftImageRaw,
                                  [&](std::shared_ptr<const Image> image) { seen.push_back(-stamp_of(*image)); });
  });
  EXPECT_TRUE(container.run().empty());
  EXPECT_THAT(seen, ElementsAre(-1000, -1050, 1100, 1200, 1300, -1320));
}

TEST(Container, FiresTimersLiveWhereNothingArrives) {
  std::promise<void> third;
  std::atomic<int> fired = 0;
  Container container({.replay = false});
  container.add(named("ticker"), [&](Context& context) {
    return std::make_unique<Ticker>(context, std::chrono::milliseconds(1), [&](std::int64_t) {
      if (++fired == 3) third.set_value();
    });
  });
  container.start();
  third.get_future().wait();
  EXPECT_TRUE(container.unload("ticker"));
}

}  // namespace
}  // namespace panvo::runtime
