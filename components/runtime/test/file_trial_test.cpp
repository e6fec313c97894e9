// SPDX-License-Identifier: Apache-2.0
#include "file_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <stdexcept>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

const interfaces::Topic<sensor_msgs::msg::Image> kImages = topics::kStereoLeftImageRaw;

class FileTrial : public testing::Test {
 protected:
  FileTrial() { write("bad"); }

  void write(const std::string& text) const { std::ofstream(file_) << text; }
  fs::path beside(const std::string& ending) const { return file_.string() + ending; }

  panvo::test::TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "store.db";
};

TEST_F(FileTrial, AFileThatThreeCrashedProcessesReadIsSetAsideForTheNext) {
  for (int i = 0; i < 3; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      const rlimit no_dump{0, 0};
      setrlimit(RLIMIT_CORE, &no_dump);
      if (begin_trial(file_)) _exit(0);
      std::signal(SIGSEGV, SIG_DFL);
      raise(SIGSEGV);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "crash " << i;
  }
  EXPECT_EQ(begin_trial(file_), beside(".bad-1"));
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(fs::exists(beside(".bad-1")));
  EXPECT_FALSE(fs::exists(beside(".attempts")));
}

TEST_F(FileTrial, OneThatDidNoHarmIsCountedAnew) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(begin_trial(file_));
    EXPECT_FALSE(begin_trial(file_));
    end_trial(file_);
  }
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_FALSE(fs::exists(beside(".attempts")));
}

TEST_F(FileTrial, WhatWasSetAsideEarlierStaysAndItsJournalGoesAlong) {
  std::ofstream(beside(".bad-1")) << "the first";
  std::ofstream(beside("-journal")) << "of the database";
  for (int i = 0; i < 3; ++i) ASSERT_FALSE(begin_trial(file_));
  EXPECT_EQ(begin_trial(file_), beside(".bad-2"));
  EXPECT_TRUE(fs::exists(beside(".bad-2-journal")));
  EXPECT_FALSE(fs::exists(beside("-journal")));
}

TEST_F(FileTrial, AFileThatIsNotThereIsNotCounted) {
  fs::remove(file_);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(begin_trial(file_));
  EXPECT_FALSE(fs::exists(beside(".attempts")));
}

/// Reads a file in the constructor and, if it is bad, fails on the first message.
class FileReader final : public Component {
 public:
  FileReader(Context& context, const fs::path& file) {
    context.about_to_read(file);
    std::string text;
    std::ifstream(file) >> text;
    is_bad_ = text == "bad";
    context.input(kImages, [this](const std::shared_ptr<const sensor_msgs::msg::Image>&) {
      if (is_bad_) throw std::runtime_error("a row beyond the matrix");
    });
  }

 private:
  bool is_bad_ = false;
};

/// A live run with one message; returns the problems.
std::vector<std::string> run_on(const fs::path& file, std::vector<std::string>& log) {
  Container container({.log = [&](LogLevel, const std::string&, const std::string& text) { log.push_back(text); }});
  ComponentDescription description;
  description.name = "reader";
  container.add(description, [&](Context& context) { return std::make_unique<FileReader>(context, file); });
  std::shared_ptr<UntypedOutput> output;
  description.name = "writer";
  container.add(description, [&](Context& context) {
    const auto& type = interfaces::message_type<sensor_msgs::msg::Image>();
    output = context.open_output({std::string(kImages.name), std::string(type.name), kImages.qos, &type});
    return std::make_unique<Component>();
  });
  container.start();
  const auto image = std::make_shared<sensor_msgs::msg::Image>();
  image->width(1);
  image->height(1);
  image->step(1);
  image->encoding("mono8");
  image->data({0});
  output->publish(image);
  output.reset();
  container.request_stop();
  return container.run();
}

TEST_F(FileTrial, AComponentThatFailsOnAFileThreeTimesGoesOnWithoutIt) {
  std::vector<std::string> log;
  for (int i = 0; i < 3; ++i) ASSERT_FALSE(run_on(file_, log).empty()) << "run " << i;
  EXPECT_THAT(run_on(file_, log), IsEmpty());
  EXPECT_THAT(log, Contains(HasSubstr("was set aside as " + beside(".bad-1").string())));
}

TEST_F(FileTrial, ARunThatEndsWellLeavesNoCounter) {
  std::vector<std::string> log;
  ASSERT_FALSE(run_on(file_, log).empty());
  EXPECT_TRUE(fs::exists(beside(".attempts")));
  write("mended");
  EXPECT_THAT(run_on(file_, log), IsEmpty());
  EXPECT_FALSE(fs::exists(beside(".attempts")));
}

}  // namespace
}  // namespace panvo::runtime
