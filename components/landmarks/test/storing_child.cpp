// SPDX-License-Identifier: Apache-2.0
/// Process for interrupted_store_test that is killed while it adds landmarks. Prints the id of each added landmark;
/// with a file size limit, prints the error and exits. With "lock" it locks a store until it is killed. With "share" it adds
/// some landmarks beside those of other processes.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/sqlite/database.hpp"

namespace {

int lock(const char* file) {
  panvo::sqlite::Database database(file, panvo::sqlite::Database::Mode::kReadWrite);
  database.execute("BEGIN EXCLUSIVE");
  std::printf("locked\n");
  std::fflush(stdout);
  ::pause();
  return 0;
}

int share(const char* location, std::uint32_t count) {
  using namespace panvo::landmarks;
  LandmarkStore store(location, test::made_up_settings());
  for (std::uint32_t id = 1; id <= count; ++id) store.add(test::made_up_landmark(id), IfTaken::kNextId);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace panvo::landmarks;
  if (argc < 3) {
    std::fprintf(
        stderr,
        "usage: storing_child STORE KEYPOINTS|lock [FILE_SIZE_LIMIT]\n       storing_child STORE share COUNT\n");
    return 2;
  }
  if (std::string(argv[2]) == "lock") return lock(argv[1]);
  if (std::string(argv[2]) == "share" && argc > 3)
    return share(argv[1], static_cast<std::uint32_t>(std::stoul(argv[3])));
  if (argc > 3) {
    const rlim_t limit = std::stoul(argv[3]);
    const rlimit limits{limit, limit};
    setrlimit(RLIMIT_FSIZE, &limits);
    std::signal(SIGXFSZ, SIG_IGN);
  }
  try {
    LandmarkStore store(argv[1], test::made_up_settings());
    for (std::uint32_t id = 1;; ++id) {
      store.add(test::made_up_landmark(id, std::stoul(argv[2])));
      std::printf("%u\n", id);
      std::fflush(stdout);
    }
  } catch (const StoreError& error) {
    std::printf("%s\n", error.what());
  }
  return 1;
}
