// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace panvo::aravis_camera::testing {

/// The program gige_simulator as a process of its own, to be stopped, killed and started again.
class Simulator {
 public:
  /// `words` as on its command line. Returns when its cameras answer; throws std::runtime_error when they do not.
  explicit Simulator(const std::vector<std::string>& words);
  ~Simulator();  // kills it
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  void signal(int number) const;
  void kill();
  /// Ends it in order: what it says each camera has sent, "GVL filled 12 skipped 0\n...".
  std::string end();

 private:
  std::string read_to_end();

  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace panvo::aravis_camera::testing
