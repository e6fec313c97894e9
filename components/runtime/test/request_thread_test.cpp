// SPDX-License-Identifier: Apache-2.0
#include "request_thread.hpp"

#include <gtest/gtest.h>

#include <future>

namespace panvo::runtime {
namespace {

using interfaces::Bytes;

/// Answer to one request.
class Asked {
 public:
  std::shared_ptr<Reply> reply() {
    return std::make_shared<Reply>([this](std::optional<Bytes> bytes) { answer_.set_value(std::move(bytes)); });
  }
  std::optional<Bytes> answer() { return answer_.get_future().get(); }

 private:
  std::promise<std::optional<Bytes>> answer_;
};

const int kOneOwner = 0, kOtherOwner = 0;  // owners

TEST(RequestThread, AnswersInOrder) {
  RequestThread thread;
  Bytes seen;
  const auto serve = thread.serve(&kOneOwner, [&](const Bytes& request) {
    seen.push_back(request.at(0));
    return seen;
  });
  Asked one, two;
  serve({1}, one.reply());
  serve({2}, two.reply());
  EXPECT_EQ(one.answer(), Bytes({1}));
  EXPECT_EQ(two.answer(), Bytes({1, 2}));
}

TEST(RequestThread, LeavesMalformedRequestsUnanswered) {
  RequestThread thread;
  const auto serve =
      thread.serve(&kOneOwner, [](const Bytes&) -> Bytes { throw interfaces::DecodeError("malformed"); });
  Asked asked;
  serve({1}, asked.reply());
  EXPECT_EQ(asked.answer(), std::nullopt);
}

TEST(RequestThread, ForgetsTheRequestsOfAnOwnerThatIsRemoved) {
  RequestThread thread;
  std::promise<void> go_on;
  const auto slow = thread.serve(&kOneOwner, [&](const Bytes& request) {
    go_on.get_future().wait();
    return request;
  });
  bool is_called = false;
  const auto removed = thread.serve(&kOtherOwner, [&](const Bytes& request) {
    is_called = true;
    return request;
  });
  Asked first, second;
  slow({1}, first.reply());
  removed({2}, second.reply());
  thread.remove_of(&kOtherOwner);  // while the other owner's is being answered
  EXPECT_EQ(second.answer(), std::nullopt);
  go_on.set_value();
  EXPECT_EQ(first.answer(), Bytes({1}));
  thread.remove_of(&kOneOwner);
  EXPECT_FALSE(is_called);
}

}  // namespace
}  // namespace panvo::runtime
