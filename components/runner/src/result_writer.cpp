// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/result_writer.hpp"

#include <exception>
#include <string_view>

#include "panvo_msgs/msg/OdometryQuality.h"

namespace panvo::runner {
namespace {

using panvo_msgs::msg::OdometryQuality;

bool is_frame_in(const runtime::TopicDescription& topic) { return topic.name.ends_with("stereo/left/image_rect"); }
bool is_frame_out(const runtime::TopicDescription& topic) { return topic.name.ends_with("odometry/binocular"); }
bool is_quality(const runtime::TopicDescription& topic) {
  static const std::string_view type = interfaces::message_type<OdometryQuality>().name;
  return topic.name.ends_with("odometry/quality") && topic.type_name == type;
}

bool is_reliable(const runtime::SamplePtr& sample) {
  try {
    const auto quality = runtime::Sample::as<OdometryQuality>(sample);
    return quality && quality->reliable();
  } catch (const interfaces::DecodeError&) {
    return false;
  }
}

}  // namespace

ResultWriter::ResultWriter(RunFiles* files, std::function<void(const std::string&)> failed)
    : files_(files), failed_(std::move(failed)) {
  if (files_) thread_ = std::thread([this] { run(); });
}

ResultWriter::~ResultWriter() { finish(); }

void ResultWriter::observe(runtime::Container& container) {
  container.observe(
      [this](const runtime::TopicDescription& topic) {
        return is_frame_in(topic) || is_frame_out(topic) || is_quality(topic) || (files_ && files_->wants(topic));
      },
      [this](const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) { add(topic, sample); });
}

void ResultWriter::add(const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) {
  frames_in_ += is_frame_in(topic);
  frames_out_ += is_frame_out(topic);
  frames_unreliable_ += is_quality(topic) && !is_reliable(sample);
  if (!files_ || !files_->wants(topic)) return;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kCapacity || is_closed_; });
  if (is_closed_) return;
  waiting_.emplace_back(topic, sample);
  changed_.notify_all();
}

void ResultWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ResultWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || is_closed_; });
    if (waiting_.empty()) return;
    const Waiting message = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    const bool is_written = write(message);
    lock.lock();
    if (is_written) continue;
    is_closed_ = true;
    waiting_.clear();
    changed_.notify_all();
  }
}

bool ResultWriter::write(const Waiting& message) {
  try {
    files_->write(message.first, message.second);
    return true;
  } catch (const std::exception& error) {
    failed_(error.what());
    return false;
  }
}

}  // namespace panvo::runner
