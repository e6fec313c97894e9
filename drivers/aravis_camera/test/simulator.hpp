// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace panvo::aravis_camera::testing {

/// Runs the program gige_simulator as a separate process that can be stopped, killed and restarted.
class Simulator {
 public:
  /// `words`: command-line arguments. Returns once the cameras respond; throws std::runtime_error if they do not.
  explicit Simulator(const std::vector<std::string>& words);
  ~Simulator();  // kills it
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  void signal(int number) const;
  void kill();
  /// Terminates it and returns its report of the sent frames: "GVL filled 12 skipped 0\n...".
  std::string end();

 private:
  std::string read_to_end();

  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace panvo::aravis_camera::testing
