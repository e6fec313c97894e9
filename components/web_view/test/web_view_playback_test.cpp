// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <optional>
#include <thread>

#include "panvo/runtime/source.hpp"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000, kFirst = 1000 * kSecond, kLast = 4600 * kSecond;

/// An hour with a step each second.
class Hour final : public runtime::Source {
 public:
  std::optional<std::int64_t> next_stamp_ns() override {
    const std::lock_guard lock(mutex_);
    return next_ns_ <= kLast ? std::optional(next_ns_) : std::nullopt;
  }
  void emit() override {
    if (on_step) on_step();
    const std::lock_guard lock(mutex_);
    next_ns_ += kSecond;
  }
  Progress progress() const override { return {}; }
  bool waits_at_end() const override { return true; }
  std::optional<runtime::StampRange> range() const override { return runtime::StampRange{kFirst, kLast}; }
  void seek(std::int64_t stamp_ns) override {
    const std::lock_guard lock(mutex_);
    next_ns_ = stamp_ns;
  }

  std::function<void()> on_step;

 private:
  std::mutex mutex_;
  std::int64_t next_ns_ = kFirst;
};

struct Command {
  bool is_to_play;
  float speed;
  std::optional<std::uint64_t> seek_ns;
  std::string id;
};

struct Told {
  int status = -1;
  std::int64_t time_ns = 0;
  float speed = 0;
  bool is_moved = false;
  std::string id;
};

template <class Integer>
void put(std::vector<std::uint8_t>& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(value); ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void send(WebSocketClient& client, const Command& command) {
  std::vector<std::uint8_t> frame{3, static_cast<std::uint8_t>(command.is_to_play ? 0 : 1)};
  put(frame, std::bit_cast<std::uint32_t>(command.speed));
  frame.push_back(command.seek_ns ? 1 : 0);
  put(frame, command.seek_ns.value_or(0));
  put(frame, static_cast<std::uint32_t>(command.id.size()));
  frame.insert(frame.end(), command.id.begin(), command.id.end());
  client.send_binary(frame);
}

std::uint64_t number_in(const std::vector<std::uint8_t>& frame, std::size_t from, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{frame.at(from + i)} << (8 * i);
  return value;
}

/// The next state; other frames are skipped.
Told next_told(WebSocketClient& client) {
  while (const auto frame = client.receive()) {
    if (frame->operation != 2 || frame->data.at(0) != 5) continue;
    const auto number = [&](std::size_t from, std::size_t bytes) { return number_in(frame->data, from, bytes); };
    EXPECT_EQ(number(15, 4), frame->data.size() - 19);
    return {frame->data.at(1),
            static_cast<std::int64_t>(number(2, 8)),
            std::bit_cast<float>(static_cast<std::uint32_t>(number(10, 4))),
            frame->data.at(14) != 0,
            {frame->data.begin() + 19, frame->data.end()}};
  }
  return {};
}

/// A paused recording in the container of the view.
class WebViewPlayback : public WebView {
 protected:
  void play(const std::string& allow_control) {
    start({{"allow_control", allow_control}});
    container_->add(description("player"), [this](runtime::Context& context) {
      playback_ = &context.playback();
      playback_->pause();
      context.source(hour_);
      return std::make_unique<runtime::Component>();
    });
    run_ = std::thread([this] { container_->run(); });
  }

  void TearDown() override {
    container_->request_stop();
    run_.join();
    WebView::TearDown();
  }

  Hour hour_;
  runtime::Playback* playback_ = nullptr;
  std::thread run_;
};

TEST_F(WebViewPlayback, IsControlledByAClient) {
  play("true");
  WebSocketClient client(port());
  const json info = next_text(client, "serverInfo");
  EXPECT_EQ(std::ranges::count(info["capabilities"], "playbackControl"), 1) << info;
  EXPECT_EQ(info["dataStartTime"], json::parse(R"({"sec": 1000, "nsec": 0})"));
  EXPECT_EQ(info["dataEndTime"], json::parse(R"({"sec": 4600, "nsec": 0})"));

  send(client, {false, 0.5F, kFirst + 90 * kSecond, "move"});
  const auto moved = next_told(client);
  EXPECT_EQ(moved.status, 1);
  EXPECT_EQ(moved.time_ns, kFirst + 90 * kSecond);
  EXPECT_EQ(moved.speed, 0.5F);
  EXPECT_TRUE(moved.is_moved);
  EXPECT_EQ(moved.id, "move");
  EXPECT_TRUE(playback_->is_paused());

  send(client, {true, -3, std::nullopt, "play"});
  const auto playing = next_told(client);
  EXPECT_EQ(playing.status, 0);
  EXPECT_EQ(playing.speed, 0.5F) << "an impossible speed is not taken";
  EXPECT_FALSE(playing.is_moved);
  EXPECT_FALSE(playback_->is_paused());
}

TEST_F(WebViewPlayback, TellsItsClientsWhatOthersDo) {
  play("true");
  WebSocketClient one(port()), other(port());
  send(one, {false, 1, std::nullopt, "1"});
  EXPECT_EQ(next_told(one).id, "1");
  send(other, {false, 1, std::nullopt, "2"});
  EXPECT_EQ(next_told(other).id, "2");
  send(other, {false, 1, kLast + kSecond, "3"});
  const auto moved = next_told(one);
  EXPECT_EQ(moved.time_ns, kLast) << "limited to what is recorded";
  EXPECT_TRUE(moved.is_moved);
  EXPECT_EQ(moved.id, "");
  playback_->resume();
  auto last = next_told(one);
  if (last.status == 0) last = next_told(one);  // the last step is still to come
  EXPECT_EQ(last.status, 3) << "the end";
  send(one, {true, 1, kFirst, "again"});
  EXPECT_EQ(next_told(one).status, 0);
}

/// Viewers drop the messages that came before a time that goes back, also the transforms that are sent only once.
TEST_F(WebViewPlayback, TellsTheTimeBeforeTheMessagesWhenItGoesBack) {
  hour_.on_step = [this] { odometry_->publish(odometry(1)); };
  play("true");
  WebSocketClient client(port());
  subscribe(client, 3, channel_of(client, "/odometry/binocular"));
  settle(client);
  std::uint64_t told_ns = 0;
  for (int i = 0; i < 20; ++i) {
    const auto to_ns = static_cast<std::uint64_t>(kLast - (10 * i + 10) * kSecond);
    send(client, {true, 1, to_ns, ""});
    std::uint64_t of_message_ns = 0;
    while (of_message_ns < to_ns || of_message_ns >= to_ns + 10 * kSecond) {
      const auto frame = client.receive();
      ASSERT_TRUE(frame);
      if (frame->operation != 2) continue;
      if (frame->data.at(0) == 2) told_ns = number_in(frame->data, 1, 8);
      if (frame->data.at(0) == 1) of_message_ns = number_in(frame->data, 5, 8);
    }
    EXPECT_LE(told_ns, of_message_ns) << "move " << i;
  }
}

TEST_F(WebViewPlayback, IsNotControlledWithoutPermission) {
  play("false");
  WebSocketClient client(port());
  const json info = next_text(client, "serverInfo");
  EXPECT_EQ(std::ranges::count(info["capabilities"], "playbackControl"), 0) << info;
  send(client, {true, 1, std::nullopt, "play"});
  EXPECT_NE(next_status(client).find("allow_control"), std::string::npos);
  EXPECT_TRUE(playback_->is_paused());
}

TEST_F(WebView, RefusesToControlPlaybackWhereNothingIsPlayed) {
  start({{"allow_control", "true"}});
  WebSocketClient client(port());
  EXPECT_FALSE(next_text(client, "serverInfo").contains("dataStartTime"));
  send(client, {true, 1, std::nullopt, "play"});
  EXPECT_EQ(next_status(client), "nothing that can be moved is played here");
}

}  // namespace
}  // namespace panvo::web_view::test
