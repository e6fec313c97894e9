// SPDX-License-Identifier: Apache-2.0
#include "policies_entry.hpp"

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "suggestion.hpp"

namespace panvo::runtime {
namespace {

constexpr int kMaxRequests = 100'000;  // per second

template <class Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

template <class Choice>
Choice read_choice(YamlMap& map, const std::string& key, const Choices<Choice>& choices, Choice otherwise,
                   Findings& findings) {
  const auto text = map.text(key);
  if (!text) return otherwise;
  std::vector<std::string> names;
  for (const auto& [name, choice] : choices) {
    if (name == *text) return choice;
    names.push_back(name);
  }
  findings.problems.add(map.where(key), fmt::format("{} is \"{}\"{}", key, *text, suggestion(*text, names)));
  return otherwise;
}

}  // namespace

OnError read_on_error(YamlMap& map, OnError otherwise, Findings& findings) {
  static const Choices<OnError> kChoices{
      {"restart", OnError::kRestart}, {"stop", OnError::kStop}, {"ignore", OnError::kIgnore}};
  return read_choice(map, "on_error", kChoices, otherwise, findings);
}

void read_policies(YamlMap& map, const Scope& scope, Findings& findings, ContainerDescription& container) {
  static const Choices<ServiceAccess> kAccess{
      {"look", ServiceAccess::kLook}, {"steer", ServiceAccess::kSteer}, {"off", ServiceAccess::kOff}};
  container.services = read_choice(map, "services", kAccess, ServiceAccess::kByHost, findings);
  container.requests_per_s = read_number(
      map, "requests_per_s", fmt::format("requests per second, 0 to {}", kMaxRequests), kMaxRequests, findings);
  container.required = map.flag("required", true);
  if (const auto folder = map.text("files_below")) {
    const auto path = beside(scope.file, *folder);
    std::error_code error;
    if (folder->empty() || !std::filesystem::is_directory(path, error)) {
      findings.problems.add(map.where("files_below"),
                            fmt::format("files_below: folder \"{}\" does not exist; create it, or remove the line to "
                                        "forbid files in requests",
                                        *folder));
    }
    container.files_below = std::filesystem::absolute(path).string();
  }
}

std::optional<double> read_number(YamlMap& map, const std::string& key, const std::string& what, double largest,
                                  Findings& findings) {
  const auto text = map.text(key);
  if (!text) return std::nullopt;
  double number = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error == std::errc() && end == text->data() + text->size() && number >= 0 && number <= largest) return number;
  findings.problems.add(map.where(key), fmt::format("{} is \"{}\"; write {}", key, *text, what));
  return std::nullopt;
}

}  // namespace panvo::runtime
