// SPDX-License-Identifier: Apache-2.0
// Cost of sending a message to another component: within a process, to another process, to another host (network
// namespaces, MTU 1400; needs root); with panvo, panvo with shared images, bare Fast DDS and Cyclone DDS. Counters:
// latency from writing to having the message as a struct (p50, p95, p99), CPU time of both sides per message, and
// fraction of lost messages. An odometry message or a grey image every 10 ms, a panorama every 40 ms.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/runtime/test_domain.hpp"
#include "process.hpp"
#include "transport_peer.hpp"
#include "two_hosts.hpp"

namespace panvo::bench {
namespace {

using Words = std::vector<std::string>;
constexpr std::chrono::seconds kLimit(60);

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  const auto rank = static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

Words peer(const PeerTask& task) {
  Words words{std::filesystem::read_symlink("/proc/self/exe").string()};
  for (const auto& word : task.words()) words.push_back(word);
  return words;
}

Measured measure_one_process(const PeerTask& task) {
  Measured measured;
  measured.add(test::run(peer(task), kLimit).output);
  return measured;
}

Measured measure_two_processes(const Words& reader_words, const Words& writer_words) {
  Measured measured;
  test::Process reader(reader_words);
  test::Process writer(writer_words);
  writer.wait(kLimit);
  reader.signal(SIGTERM);
  reader.wait(kLimit);
  measured.add(writer.output());
  measured.add(reader.output());
  return measured;
}

Measured measure(const std::string& path, const std::string& stack, const std::string& message) {
  const int domain = runtime::test_domain();
  const PeerTask both{"both", stack, message, domain}, read{"read", stack, message, domain},
      write{"write", stack, message, domain};
  if (path == "in_process") return measure_one_process(both);
  if (path == "other_process") return measure_two_processes(peer(read), peer(write));
  const test::TwoHosts hosts({});
  return measure_two_processes(hosts.on_a(peer(read)), hosts.on_b(peer(write)));
}

void transport(benchmark::State& state, const std::string& path, const std::string& stack, const std::string& message) {
  for (auto _ : state) {
    const Measured measured = measure(path, stack, message);
    if (measured.sent == 0 || measured.latencies_us.empty()) {
      state.SkipWithError("nothing arrived");
      return;
    }
    state.counters["p50_us"] = quantile(measured.latencies_us, 0.5);
    state.counters["p95_us"] = quantile(measured.latencies_us, 0.95);
    state.counters["p99_us"] = quantile(measured.latencies_us, 0.99);
    state.counters["cpu_us"] = measured.cpu_us / measured.sent;
    state.counters["lost"] = 1.0 - static_cast<double>(measured.latencies_us.size()) / measured.sent;
  }
}

void register_all() {
  Words paths{"in_process", "other_process"}, stacks{"panvo", "fastdds"};
  if (test::TwoHosts::why_not().empty()) paths.emplace_back("other_host");
#ifdef PANVO_HAS_CYCLONE
  stacks.emplace_back("cyclone");
#endif
  const auto add = [](const std::string& message, const std::string& path, const std::string& stack) {
    benchmark::RegisterBenchmark((message + "/" + path + "/" + stack).c_str(),
                                 [=](benchmark::State& state) { transport(state, path, stack, message); })
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
  };
  for (const std::string message : {"odometry", "gray", "panorama"}) {
    for (const auto& path : paths) {
      for (const auto& stack : stacks) add(message, path, stack);
      if (message != "odometry" && path == "other_process") add(message, path, "panvo_shared");
    }
  }
}

}  // namespace
}  // namespace panvo::bench

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--peer") return panvo::bench::run_peer({argv + 2, argv + argc});
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  panvo::bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
}
