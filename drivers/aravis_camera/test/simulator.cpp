// SPDX-License-Identifier: Apache-2.0
#include "simulator.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>

namespace panvo::aravis_camera::testing {

Simulator::Simulator(const std::vector<std::string>& words) {
  std::vector<std::string> all{PANVO_GIGE_SIMULATOR};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (auto& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // the simulator ends with the test
    dup2(ends[1], STDOUT_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  output_ = ends[0];
  std::string line;
  char letter = 0;
  while (read(output_, &letter, 1) == 1 && letter != '\n') line += letter;
  if (line != "ready") throw std::runtime_error(std::string(PANVO_GIGE_SIMULATOR) + " does not start: " + line);
}

Simulator::~Simulator() {
  kill();
  close(output_);
}

void Simulator::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

void Simulator::kill() {
  if (pid_ <= 0) return;
  signal(SIGKILL);
  waitpid(std::exchange(pid_, -1), nullptr, 0);
}

std::string Simulator::end() {
  signal(SIGTERM);
  auto text = read_to_end();
  waitpid(std::exchange(pid_, -1), nullptr, 0);
  return text;
}

std::string Simulator::read_to_end() {
  std::string text;
  char letters[256];
  for (ssize_t count = 0; (count = read(output_, letters, sizeof letters)) > 0;)
    text.append(letters, static_cast<std::size_t>(count));
  return text;
}

}  // namespace panvo::aravis_camera::testing
