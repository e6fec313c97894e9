// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace panvo::recorder {

struct RecorderParameters {
  std::string output;
  bool overwrite = false;
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  bool include_images = true;
  bool include_hidden = false;
  double max_file_mb = 0.0;
  double max_file_s = 0.0;
  int max_files = 0;
  bool start_paused = false;
  int queue_mb = 100;
  int max_topics = 1000;
  std::string storage = "sqlite3";
  std::string compression = "none";

  template <class Field>
  static void describe(Field&& field) {
    using P = RecorderParameters;
    field.path(&P::output, "output", "folder of the bag; empty: rosbag2_ with date and time, in the working directory");
    field(&P::overwrite, "overwrite", "",
          "replace an existing bag; never one of the same run, before a crash of the process");
    field(&P::topics, "topics", "", "topics to record: names or regular expressions for whole names; empty: all");
    field(&P::exclude, "exclude", "", "topics not to record: names or regular expressions for whole names");
    field(&P::include_images, "include_images", "", "also record sensor_msgs/Image and CompressedImage");
    field(&P::include_hidden, "include_hidden", "",
          "also record hidden topics, which have a name part that begins with _");
    field(&P::max_file_mb, "max_file_mb", "MB", "size at which the next file is started; 0: no limit", 0.0, 1e6);
    field(&P::max_file_s, "max_file_s", "s", "recorded time after which the next file is started; 0: no limit", 0.0,
          1e7);
    field(&P::max_files, "max_files", "1",
          "number of files kept, with max_file_mb or max_file_s: the oldest are removed, and each begins with the "
          "latched "
          "messages so far; 0: all",
          0, 1'000'000);
    field(&P::start_paused, "start_paused", "", "record nothing before ~/resume is called");
    field(&P::storage, "storage", "", "sqlite3 (.db3) or mcap");
    field(&P::compression, "compression", "", "compression of mcap: none, lz4 or zstd");
    field(&P::queue_mb, "queue_mb", "MB", "size of the write queue; messages beyond it are dropped and counted", 1,
          1e5);
    field(&P::max_topics, "max_topics", "",
          "maximum number of topics; each needs memory and a DDS reader. Further ones are skipped, counted and named "
          "in the log",
          1, 65'535);
  }
};

}  // namespace panvo::recorder
