// SPDX-License-Identifier: Apache-2.0
// Latency of passing an image to another thread, from publishing to reception: with a container, and with a plain
// shared_ptr through a queue.
#include <benchmark/benchmark.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <semaphore>
#include <thread>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/container.hpp"

namespace {

using Image = sensor_msgs::msg::Image;
constexpr std::size_t kImageBytes = 1080 * 540 * 3;  // a colour panorama: 1.75 MB

std::shared_ptr<const Image> make_image() {
  auto image = std::make_shared<Image>();
  image->encoding("bgr8");
  image->width(1080);
  image->height(540);
  image->step(1080 * 3);
  image->data().resize(kImageBytes);
  return image;
}

void bare_shared_ptr(benchmark::State& state) {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::shared_ptr<const Image>> queue;
  std::binary_semaphore taken(0);
  bool ended = false;
  std::thread reader([&] {
    while (true) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return ended || !queue.empty(); });
      if (ended) return;
      const auto image = std::move(queue.front());
      queue.pop_front();
      lock.unlock();
      benchmark::DoNotOptimize(image->data().data());
      taken.release();
    }
  });
  const auto image = make_image();
  for (auto _ : state) {
    {
      const std::lock_guard lock(mutex);
      queue.push_back(image);
    }
    changed.notify_one();
    taken.acquire();
  }
  {
    const std::lock_guard lock(mutex);
    ended = true;
  }
  changed.notify_one();
  reader.join();
}
BENCHMARK(bare_shared_ptr)->UseRealTime()->Unit(benchmark::kMicrosecond);

void container(benchmark::State& state) {
  using namespace panvo::runtime;
  std::binary_semaphore taken(0);
  std::shared_ptr<UntypedOutput> output;
  const auto image = make_image();
  bool copied = false;

  Container container({.replay = false});
  const auto add = [&](const char* name, const std::function<void(Context&)>& set_up) {
    ComponentDescription description;
    description.name = name;
    description.name_space = "/";
    container.add(description, [&](Context& context) {
      set_up(context);
      return std::make_unique<Component>();
    });
  };
  add("reader", [&](Context& context) {
    context.input(panvo::topics::kPanorama, [&](std::shared_ptr<const Image> received) {
      copied |= received->data().data() != image->data().data();
      taken.release();
    });
  });
  add("writer", [&](Context& context) {
    const auto& type = panvo::interfaces::message_type<Image>();
    output = context.open_output(
        {std::string(panvo::topics::kPanorama.name), std::string(type.name), panvo::topics::kPanorama.qos, &type});
  });
  container.start();
  for (auto _ : state) {
    output->publish(std::shared_ptr<const void>(image));
    taken.acquire();
  }
  output.reset();
  if (copied) state.SkipWithError("the pixels were copied");
}
BENCHMARK(container)->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace
