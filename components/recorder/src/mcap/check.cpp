// SPDX-License-Identifier: Apache-2.0
#include "check.hpp"

namespace panvo::recorder::mcap {
namespace {

constexpr std::size_t kMaxComplaints = 20;

class Check {
 public:
  Check(const InputFile& file, const Layout& layout) : file_(file), layout_(layout) {}

  std::vector<std::string> run() {
    for (const auto& block : layout_.blocks) {
      if (block.is_chunk) {
        check_chunk(block);
      } else {
        count(read_lone_messages(file_, block));
      }
    }
    for (const auto& [id, channel] : layout_.channels) {
      const auto told = layout_.messages.find(id);
      const auto expected = told == layout_.messages.end() ? 0 : told->second;
      if (found_[id] != expected) {
        complain("topic " + channel.topic + " has " + std::to_string(found_[id]) + " messages, the summary states " +
                 std::to_string(expected));
      }
    }
    return std::move(complaints_);
  }

 private:
  void complain(std::string what) {
    if (complaints_.size() < kMaxComplaints) {
      complaints_.push_back(std::move(what));
    }
  }

  void check_chunk(const Block& block) {
    const auto name = "the chunk at byte " + std::to_string(block.begin);
    try {
      const auto chunk = read_chunk(file_, block.begin);
      count(chunk.messages);
      if (!chunk.fault.empty()) {
        complain(name + " " + chunk.fault);
        return;
      }
      for (const auto& message : chunk.messages) {
        if (message.log_time < block.first_ns || message.log_time > block.last_ns) {
          complain(name + " has a message outside the time range of its index");
          return;
        }
        if (!block.channels.empty() && !block.channels.contains(message.channel)) {
          complain(name + " has a message of a channel missing in its index");
          return;
        }
      }
    } catch (const FormatError& error) {
      complain(name + " " + error.what());
    }
  }

  void count(const std::vector<StoredMessage>& messages) {
    for (const auto& message : messages) {
      ++found_[message.channel];
    }
  }

  const InputFile& file_;
  const Layout& layout_;
  std::map<std::uint16_t, std::uint64_t> found_;
  std::vector<std::string> complaints_;
};

}  // namespace

std::vector<std::string> check(const InputFile& file, const Layout& layout) {
  return layout.is_scanned ? std::vector<std::string>() : Check(file, layout).run();
}

}  // namespace panvo::recorder::mcap
