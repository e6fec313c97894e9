// SPDX-License-Identifier: Apache-2.0
#include "doctor_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iostream>

#include "finding.hpp"
#include "graph_checks.hpp"
#include "host_checks.hpp"

namespace panvo::runtime::doctor {
namespace {

std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::kWarning:
      return "warning";
    case Severity::kProblem:
      return "PROBLEM";
    case Severity::kOk:
      break;
  }
  return "ok";
}

void print(const Findings& findings) {
  for (const auto& finding : findings) {
    std::cout << fmt::format("{:<8} {}: {}\n", word(finding.severity), finding.subject, finding.text);
    if (!finding.remedy.empty()) std::cout << fmt::format("{:<8} Remedy: {}\n", "", finding.remedy);
  }
}

Findings examine_host() {
  const std::filesystem::path root = "/";
  Findings findings{check_versions(),
                    check_machine(root),
                    check_shared_memory(root),
                    check_socket_buffers(root),
                    check_network(network_interfaces()),
                    check_clock(is_clock_synchronised())};
  for (auto& more : {check_cameras(root), check_environment(process_environment())})
    findings.insert(findings.end(), more.begin(), more.end());
  return findings;
}

void examine(const graph::SessionOptions& options) {
  Findings findings = examine_host();
  print(findings);
  graph::Session session(options);
  const Findings domain = check_graph(session.settled_graph());
  print(domain);
  findings.insert(findings.end(), domain.begin(), domain.end());
  const auto problems = std::ranges::count(findings, Severity::kProblem, &Finding::severity);
  if (problems > 0) throw graph::Failure(fmt::format("{} problems, see above", problems));
}

}  // namespace

void add_doctor_command(CLI::App& app, const graph::SessionOptions& options) {
  app.add_subcommand("doctor", "examine this machine and the DDS domain")->callback([&options] { examine(options); });
}

}  // namespace panvo::runtime::doctor
