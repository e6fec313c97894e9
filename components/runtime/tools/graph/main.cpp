// SPDX-License-Identifier: Apache-2.0
// Inspects and controls the nodes of a DDS domain, ours and ROS 2's.
#include <cstdio>
#include <exception>

#include "../doctor/doctor_command.hpp"
#include "commands.hpp"
#include "panvo/runtime/errors.hpp"
#include "printable_output.hpp"

int main(int argc, char** argv) {
  using namespace panvo::runtime;
  constexpr int kFailed = 1, kBadCommandLine = 2, kInterrupted = 130;
  const graph::PrintableOutput output;
  graph::SessionOptions options;
  CLI::App app("Inspects and controls the nodes of a DDS domain: panvo's own, and those of ROS 2.", "panvo");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "ROS_DOMAIN_ID, ROS_DISTRO, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and "
      "ROS_DISCOVERY_SERVER are honoured. Exit status: 0 success, 1 "
      "not found, no answer or refused, 2 invalid command line, 130 interrupted.");
  try {
    options.dds = dds_settings_from_environment();
    options.dds.name = "panvo_graph";
    app.add_option("--domain", options.dds.domain, "DDS domain; overrides ROS_DOMAIN_ID")
        ->check(CLI::Range(0, DdsSettings::kMaxDomain));
    app.add_option("--dds-profiles", options.dds.profiles, "Fast DDS XML profile file")->check(CLI::ExistingFile);
    app.add_option("--timeout", options.timeout_s, "seconds to wait for discovery, an answer or a first message")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    graph::add_node_commands(app, options);
    graph::add_param_commands(app, options);
    graph::add_topic_commands(app, options);
    graph::add_service_commands(app, options);
    graph::add_component_commands(app, options);
    doctor::add_doctor_command(app, options);
    graph::watch_for_stop();
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadCommandLine;
  } catch (const ConfigError& error) {
    for (const auto& problem : error.problems()) std::fprintf(stderr, "panvo: %s\n", printable(problem).c_str());
    return kBadCommandLine;
  } catch (const std::exception& error) {
    if (graph::is_stopped()) return kInterrupted;
    std::fprintf(stderr, "panvo: %s\n", printable(error.what()).c_str());
    return kFailed;
  }
  return 0;
}
