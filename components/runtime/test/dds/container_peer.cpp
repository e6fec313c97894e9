// SPDX-License-Identifier: Apache-2.0
// A container in its own process, controlled by tests in another. The argument is the DDS domain; ends with its input.
#include <sys/prctl.h>

#include <csignal>
#include <iostream>
#include <thread>

#include "node_service_topics.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::runtime::test {
namespace {

/// Forwards messages, with an optional prefix.
class Echo final : public Component {
 public:
  struct Parameters {
    std::string before;
    std::int64_t size = 3;
    template <class Field>
    static void describe(Field&& field) {
      field(&Parameters::before, "before", "", "put before each text");
      field(&Parameters::size, "size", "1", "of nothing", 1, 9);
    }
  };
  explicit Echo(Context& context) : parameters_(context.parameters<Parameters>()), output_(context.output(kEchoed)) {
    context.input(kToEcho, [this](const std::shared_ptr<const std_msgs::msg::String>& text) {
      std_msgs::msg::String echoed;
      echoed.data(parameters_.before + text->data());
      output_.publish(std::move(echoed));
    });
    context.on_parameters<Parameters>([this](const Parameters& wanted) { parameters_ = wanted; });
  }

 private:
  Parameters parameters_;
  Output<std_msgs::msg::String> output_;
};

}  // namespace
}  // namespace panvo::runtime::test

int main(int argc, char** argv) {
  using namespace panvo::runtime;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with a crashed test
  if (argc != 2) return 2;
  DdsSettings dds{.domain = std::stoi(argv[1]), .profiles = "", .name = "controlled"};
  dds.limits.max_topic_rate_hz = 1e6;  // tests write as fast as they can
  Container container({.dds = dds, .name = "controlled"});
  ComponentDescription echo;
  echo.name = "echo";
  echo.name_space = "/robot";
  container.add(echo, [](Context& context) { return std::make_unique<test::Echo>(context); });
  std::thread input([&] {
    while (std::cin.get() != EOF) {
    }
    container.request_stop();
  });
  container.run();
  input.join();
}
