// SPDX-License-Identifier: Apache-2.0
#include "video_encoder.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "panvo/evaluation/plot.hpp"

namespace panvo::evaluation {
namespace {

constexpr const char* kNotInstalled = "ffmpeg is not installed; install it with `apt-get install ffmpeg`";
constexpr std::chrono::seconds kPatience(60);  // for ffmpeg, which needs milliseconds per picture

/// "drive.mp4" -> "drive.part.mp4"
std::filesystem::path part_of(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  return part.replace_extension(".part" + file.extension().string());
}

/// Starts ffmpeg, which reads raw pictures. Returns 0 or the error.
int start(const std::filesystem::path& file, cv::Size size, int frames_per_s, int input, int messages, pid_t& child) {
  std::vector<std::string> words{"ffmpeg", "-nostdin", "-loglevel",     "error", "-y",
                                 "-f",     "rawvideo", "-pixel_format", "bgr24"};
  const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  add({"-video_size", std::to_string(size.width) + "x" + std::to_string(size.height)});
  add({"-framerate", std::to_string(frames_per_s), "-i", "pipe:0"});
  add({"-pix_fmt", "yuv420p"});  // other formats are not played by browsers
  add({"-movflags", "+faststart", "file:" + file.string()});
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
  const int error = posix_spawnp(&child, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

VideoEncoder::VideoEncoder(std::filesystem::path file, cv::Size size, int frames_per_s)
    : file_(std::move(file)), part_(part_of(file_)), size_(size) {
  // A socket instead of a pipe: if ffmpeg ends, writing fails without a signal.
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw PlotError(std::string("cannot start ffmpeg: ") + std::strerror(errno));
  }
  input_ = ends[0];
  messages_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  const timeval patience{.tv_sec = kPatience.count(), .tv_usec = 0};
  ::setsockopt(input_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  const int error = start(part_, size, frames_per_s, ends[1], messages_, child_);
  ::close(ends[1]);
  if (error == 0) return;
  child_ = -1;
  close_input();
  ::close(messages_);
  throw PlotError(error == ENOENT ? kNotInstalled : std::string("cannot start ffmpeg: ") + std::strerror(error));
}

VideoEncoder::~VideoEncoder() {
  close_input();
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);  // gone if the video was finished
  ::close(messages_);
}

void VideoEncoder::add(const cv::Mat3b& picture) {
  CV_Assert(picture.size() == size_ && picture.isContinuous());
  const std::size_t size = picture.total() * picture.elemSize();
  for (std::size_t sent = 0; sent < size;) {
    const ssize_t count = ::send(input_, picture.data + sent, size - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail();
    sent += static_cast<std::size_t>(count);
  }
}

void VideoEncoder::finish() {
  close_input();
  if (!has_succeeded()) fail();
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw PlotError(file_.string() + " cannot be written: " + error.message());
}

void VideoEncoder::close_input() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
}

bool VideoEncoder::has_succeeded() {
  for (const auto end = std::chrono::steady_clock::now() + kPatience; std::chrono::steady_clock::now() < end;) {
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) == child_) {
      child_ = -1;
      return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

void VideoEncoder::fail() const {
  std::array<char, 1000> text{};
  const ssize_t count = ::pread(messages_, text.data(), text.size(), 0);
  std::string said(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  throw PlotError("ffmpeg failed on " + part_.string() + ": " + (said.empty() ? "it took no more pictures" : said));
}

}  // namespace panvo::evaluation
