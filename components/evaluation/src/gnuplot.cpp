// SPDX-License-Identifier: Apache-2.0
#include "gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "panvo/evaluation/plot.hpp"

namespace panvo::evaluation {
namespace {

constexpr const char* kRemedy = "install it with `apt-get install gnuplot-nox`, or use --no-plot";

// Reads everything that the child writes to the pipe until it closes it.
std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  // Doubling the quote is documented, but at the start of a string gnuplot 5.4 treats it as the end of the string.
  constexpr const char* kApostrophe = "\u2019";
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += kApostrophe;
    } else {
      quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return quoted + "'";
}

void run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw PlotError(std::string("cannot start gnuplot: ") + std::strerror(errno) + "; " + kRemedy);
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot";
  std::string no_start_up_files = "-d";
  std::string file = script;
  std::array<char*, 4> arguments{program.data(), no_start_up_files.data(), file.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe_ends[1]);
  const std::string said = error == 0 ? read_all(pipe_ends[0]) : "";
  ::close(pipe_ends[0]);
  if (error != 0 && error != ENOENT) {
    throw PlotError(std::string("cannot start gnuplot: ") + std::strerror(error) + "; " + kRemedy);
  }
  // POSIX allows both for a missing program: the call fails, or the child exits with 127.
  const int status = error == 0 ? wait_for(child) : 0;
  if (error == ENOENT || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) {
    throw PlotError(std::string("gnuplot is not installed; ") + kRemedy);
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw PlotError("gnuplot failed on " + (folder / script).string() + ": " + said +
                    "; run gnuplot on that file for details, or use --no-plot");
  }
}

void write_and_run_gnuplot(const std::filesystem::path& folder, const std::string& script, const std::string& text) {
  std::ofstream stream(folder / script);
  stream << text;
  stream.close();
  if (!stream) throw PlotError((folder / script).string() + " cannot be written; check the folder and the disk");
  run_gnuplot(folder, script);
}

}  // namespace panvo::evaluation
