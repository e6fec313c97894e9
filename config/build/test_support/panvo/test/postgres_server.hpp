// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::test {

/// Waits for a condition of another process or thread. Returns whether it became true within the limit.
inline bool becomes_true(const std::function<bool()>& condition,
                         std::chrono::seconds limit = std::chrono::seconds(60)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

/// A PostgreSQL server of the test's own in a temporary folder, on a Unix socket; it ends with the test. The server
/// refuses to be root, so that a test of root runs it as the user postgres or nobody.
class PostgresServer {
 public:
  /// Folder of Debian's newest server programs, if they are installed.
  static std::optional<std::filesystem::path> programs() {
    std::vector<std::filesystem::path> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/usr/lib/postgresql", error)) {
      if (std::filesystem::exists(entry.path() / "bin/initdb")) found.push_back(entry.path() / "bin");
    }
    if (found.empty()) return std::nullopt;
    return *std::ranges::max_element(found, {},
                                     [](const auto& path) { return std::atoi(path.parent_path().filename().c_str()); });
  }

  PostgresServer() {
    if (::geteuid() == 0) {
      const passwd* user = ::getpwnam("postgres");
      if (!user) user = ::getpwnam("nobody");
      if (!user) throw std::runtime_error("there is no user postgres or nobody to run the server");
      user_ = user->pw_uid;
      group_ = user->pw_gid;
      if (::chown(folder_.path().c_str(), *user_, *group_) != 0) throw std::runtime_error("chown failed");
    }
    const auto made = run_to_end({"initdb", "--pgdata=" + data(), "--username=panvo", "--auth=trust", "--no-sync",
                                  "--encoding=UTF8", "--locale=C"});
    if (made != 0) throw std::runtime_error("initdb failed: " + folder_.read("log"));
    start();
  }
  ~PostgresServer() { end(SIGQUIT); }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// That of the process: the tests of one program share it, each with its own database.
  static PostgresServer& shared() {
    static PostgresServer server;
    return server;
  }

  void start() {
    if (pid_ > 0) return;
    std::error_code ignored;
    std::filesystem::remove(data() + "/postmaster.pid", ignored);
    pid_ = spawn({"postgres", "-D", data(), "-k", folder_.path().string(), "-c", "listen_addresses=", "-c", "fsync=off",
                  "-c", "max_connections=40", "-c", "shared_buffers=16MB", "-c", "log_min_messages=fatal"});
    const auto is_ready = [&] { return folder_.read("data/postmaster.pid").find("\nready") != std::string::npos; };
    if (!becomes_true([&] { return is_ready() || has_ended(); }) || pid_ <= 0) {
      throw std::runtime_error("the server does not start: " + folder_.read("log"));
    }
  }
  /// SIGINT: orderly, without waiting for clients; SIGQUIT: like a crash.
  void stop(int signal = SIGINT) { end(signal); }
  /// Like a machine that hangs: connections stay open, nothing answers.
  void freeze() { signal_all(SIGSTOP); }
  void thaw() { signal_all(SIGCONT); }

  /// Location of a database. `options`: "&name=value".
  std::string location(const std::string& database, const std::string& options = "") const {
    return "postgresql:///" + database + "?host=" + folder_.path().string() + "&user=panvo" + options;
  }
  /// Runs SQL with psql; throws if it fails. Returns its output, values separated by '|'.
  std::string sql(const std::string& database, const std::string& statements) const {
    const auto file = folder_.write("statements.sql", statements), output = folder_ / "output";
    const auto command = "psql --quiet --no-psqlrc --tuples-only --no-align --set=ON_ERROR_STOP=1 --dbname='" +
                         location(database) + "' --file='" + file.string() + "' >'" + output.string() + "' 2>&1";
    const int status = std::system(command.c_str());
    auto told = folder_.read("output");
    if (status != 0) throw std::runtime_error("psql: " + told);
    if (told.ends_with('\n')) told.pop_back();
    return told;
  }
  const TemporaryFolder& folder() const noexcept { return folder_; }
  std::string data() const { return folder_ / "data"; }

 private:
  pid_t spawn(std::vector<std::string> command) const {
    command.front() = (programs().value() / command.front()).string();
    std::vector<char*> arguments;
    for (auto& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string log = folder_ / "log";
    const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const pid_t parent = ::getpid(), pid = ::fork();
    if (pid != 0) {
      ::close(output);
      return pid;
    }
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    if (user_ && (::setgroups(0, nullptr) != 0 || ::setgid(*group_) != 0 || ::setuid(*user_) != 0)) ::_exit(126);
    ::prctl(PR_SET_PDEATHSIG, SIGQUIT);
    if (::getppid() != parent) ::_exit(126);
    ::setenv("LC_ALL", "C", 1);
    if (::chdir("/") != 0) ::_exit(126);
    ::execv(arguments.front(), arguments.data());
    ::_exit(127);
  }

  int run_to_end(const std::vector<std::string>& command) const {
    int status = -1;
    ::waitpid(spawn(command), &status, 0);
    return status;
  }

  bool has_ended() {
    if (pid_ > 0 && ::waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = -1;
    return pid_ <= 0;
  }

  void end(int signal) {
    if (pid_ <= 0) return;
    thaw();
    ::kill(pid_, signal);
    if (becomes_true([&] { return has_ended(); })) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

  /// The postmaster first when it freezes, so that it starts no further session.
  void signal_all(int signal) const {
    if (pid_ <= 0) return;
    ::kill(pid_, signal);
    const std::string list = "/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children";
    std::ifstream children(list);
    for (pid_t child = 0; children >> child;) ::kill(child, signal);
  }

  TemporaryFolder folder_;
  std::optional<uid_t> user_;
  std::optional<gid_t> group_;
  pid_t pid_ = -1;
};

}  // namespace panvo::test

/// For the start of a test or SetUp(): skips it where no server can be started.
#define PANVO_SKIP_WITHOUT_POSTGRES()                                                                   \
  if (!::panvo::test::PostgresServer::programs()) {                                                     \
    GTEST_SKIP() << "no server programs in /usr/lib/postgresql; install the Debian package postgresql"; \
  }                                                                                                     \
  static_assert(true, "")
