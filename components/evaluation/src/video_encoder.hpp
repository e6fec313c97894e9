// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <opencv2/core.hpp>

namespace panvo::evaluation {

/// Encodes pictures of one size as a video, with the program ffmpeg. The file appears when it is complete.
class VideoEncoder {
 public:
  /// The name's extension decides the format (.mp4, .webm, .mkv); width and height are even. Throws PlotError, with the
  /// remedy, if ffmpeg is not installed.
  VideoEncoder(std::filesystem::path file, cv::Size size, int frames_per_s);
  ~VideoEncoder();  // without finish(), leaves no file
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// Throws PlotError, with ffmpeg's message, if it has ended or takes no data for a minute.
  void add(const cv::Mat3b& picture);

  /// Throws PlotError, with ffmpeg's message, if it failed.
  void finish();

 private:
  [[noreturn]] void fail() const;
  void close_input();
  bool has_succeeded();

  const std::filesystem::path file_, part_;
  const cv::Size size_;
  int input_ = -1;     // socket to ffmpeg's standard input
  int messages_ = -1;  // file in memory with its standard error
  pid_t child_ = -1;
};

}  // namespace panvo::evaluation
