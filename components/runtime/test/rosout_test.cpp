// SPDX-License-Identifier: Apache-2.0
#include "rosout.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <thread>
#include <utility>

namespace panvo::runtime {
namespace {

/// Waits in publish() until the log is closed, but no longer than it takes to see that it is not.
class SlowOutput final : public UntypedOutput {
 public:
  SlowOutput(std::promise<void>& entered, std::future<void> closed) : entered_(entered), closed_(std::move(closed)) {}

  void publish(std::shared_ptr<const void>) override {
    entered_.set_value();
    was_closed_meanwhile = closed_.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready;
  }
  void publish(interfaces::Bytes) override {}

  bool was_closed_meanwhile = false;

 private:
  std::promise<void>& entered_;
  std::future<void> closed_;
};

TEST(Rosout, IsClosedOnlyWhenNoThreadPublishesAnyMore) {
  std::promise<void> entered, closed;
  const auto output = std::make_shared<SlowOutput>(entered, closed.get_future());
  Rosout rosout;
  rosout.open(output);
  std::thread publisher([&] { rosout.publish(LogLevel::kInfo, "component", "text", 0); });
  entered.get_future().wait();
  rosout.close();
  closed.set_value();
  publisher.join();
  EXPECT_FALSE(output->was_closed_meanwhile);
}

TEST(Rosout, PublishesNothingOnceItIsClosed) {
  std::promise<void> entered, closed;
  const auto output = std::make_shared<SlowOutput>(entered, closed.get_future());
  Rosout rosout;
  rosout.open(output);
  rosout.close();
  rosout.publish(LogLevel::kInfo, "component", "text", 0);
  EXPECT_EQ(entered.get_future().wait_for(std::chrono::seconds(0)), std::future_status::timeout);
}

}  // namespace
}  // namespace panvo::runtime
