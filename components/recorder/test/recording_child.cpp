// SPDX-License-Identifier: Apache-2.0
/// Process that interrupted_recording_test kills while it records. Writes numbered messages without end and prints the
/// number of committed messages after each commit. With a file size limit (0: none) it prints the error and exits.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "panvo/recorder/bag_writer.hpp"
#include "test_bag.hpp"

int main(int argc, char** argv) {
  using namespace panvo::recorder;
  if (argc < 5) {
    std::fprintf(stderr, "usage: recording_child BAG MESSAGE_BYTES STORAGE FILE_SIZE_LIMIT\n");
    return 2;
  }
  const std::size_t size = std::stoul(argv[2]);
  if (const rlim_t limit = std::stoul(argv[4]); limit > 0) {
    const rlimit limits{limit, limit};
    setrlimit(RLIMIT_FSIZE, &limits);
    std::signal(SIGXFSZ, SIG_IGN);
  }
  std::optional<BagWriter> writer;
  try {
    writer.emplace(argv[1], BagWriter::Options{.batch_bytes = 10 * size, .storage = storage_from_text(argv[3])});
    const int data = writer->add_topic(test::topic("/data"));
    std::uint64_t told = 0;
    for (std::uint64_t i = 0;; ++i) {
      writer->write(data, test::kStart + static_cast<std::int64_t>(i) * test::kStep, test::payload(i, size));
      if (writer->committed_messages() != told) {
        told = writer->committed_messages();
        std::printf("%llu\n", static_cast<unsigned long long>(told));
        std::fflush(stdout);
      }
    }
  } catch (const BagError& error) {
    std::printf("%llu committed, %llu lost: %s\n",
                static_cast<unsigned long long>(writer ? writer->committed_messages() : 0),
                static_cast<unsigned long long>(writer ? writer->lost_messages() : 0), error.what());
  }
  return 1;
}
