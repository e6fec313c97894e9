// SPDX-License-Identifier: Apache-2.0
#include "substitution.hpp"

#include <cstdlib>
#include <vector>

#include "suggestion.hpp"

namespace panvo::runtime {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string unquoted(std::string_view text) {
  const bool quoted = text.size() >= 2 && (text.front() == '\'' || text.front() == '"') && text.front() == text.back();
  return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

/// The first word and the trimmed rest.
std::pair<std::string_view, std::string_view> split_first(std::string_view text) {
  const auto blank = text.find_first_of(" \t\n");
  return {text.substr(0, blank), blank == std::string_view::npos ? std::string_view{} : trim(text.substr(blank))};
}

std::string variable(const std::string& name, const Scope& scope) {
  if (const auto found = scope.variables.find(name); found != scope.variables.end()) {
    return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [known, value] : scope.variables) {
    names.push_back(known);
  }
  throw SubstitutionError("there is no variable \"" + name + "\"" + suggestion(name, names));
}

std::string environment(std::string_view arguments) {
  const auto [name, fallback] = split_first(arguments);
  if (const char* value = std::getenv(std::string(name).c_str())) {
    return value;
  }
  if (fallback.empty()) {
    throw SubstitutionError("the environment variable " + std::string(name) + " is not set; set it, or write $(env " +
                            std::string(name) + " DEFAULT)");
  }
  return unquoted(fallback);
}

void add_folders(const char* environment_name, std::vector<std::filesystem::path>& folders) {
  const char* value = std::getenv(environment_name);
  std::string_view rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    if (const auto folder = rest.substr(0, colon); !folder.empty()) {
      folders.emplace_back(folder);
    }
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  }
}

std::string package_share(const std::string& package) {
  std::vector<std::filesystem::path> prefixes;
  add_folders("AMENT_PREFIX_PATH", prefixes);
  add_folders("COLCON_PREFIX_PATH", prefixes);
  for (const auto& prefix : prefixes) {
    // colcon installs each package into its own prefix, unless merged.
    for (const auto& share : {prefix / "share" / package, prefix / package / "share" / package}) {
      std::error_code ignored;
      if (std::filesystem::is_directory(share, ignored)) {
        return share.string();
      }
    }
  }
  throw SubstitutionError(
      "no share folder of package " + package +
      " in AMENT_PREFIX_PATH or COLCON_PREFIX_PATH; build it and source the workspace's setup file");
}

std::string evaluate(std::string_view expression, const Scope& scope) {
  const auto [command, arguments] = split_first(trim(expression));
  if (command == "dirname") {
    // Absolute, as values may be used with another working directory.
    return std::filesystem::absolute(scope.file).lexically_normal().parent_path().string();
  }
  const bool known = command == "var" || command == "env" || command == "find-pkg-share";
  if (!known) {
    throw SubstitutionError("there is no substitution $(" + std::string(command) + ")" +
                            suggestion(command, {"dirname", "env", "find-pkg-share", "var"}));
  }
  if (arguments.empty()) {
    throw SubstitutionError("$(" + std::string(command) + ") needs a name");
  }
  if (command == "var") {
    return variable(unquoted(arguments), scope);
  }
  return command == "env" ? environment(arguments) : package_share(unquoted(arguments));
}

}  // namespace

std::string substitute(std::string_view text, const Scope& scope) {
  std::string out;
  while (true) {
    const auto begin = text.find("$(");
    out += text.substr(0, begin);
    if (begin == std::string_view::npos) {
      return out;
    }
    std::size_t end = begin + 2;
    for (int depth = 1; depth > 0; ++end) {
      if (end == text.size()) {
        throw SubstitutionError("\"" + std::string(text.substr(begin)) + "\" lacks its closing parenthesis");
      }
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    }
    out += evaluate(substitute(text.substr(begin + 2, end - begin - 3), scope), scope);
    text.remove_prefix(end);
  }
}

std::filesystem::path beside(const std::filesystem::path& file, const std::filesystem::path& path) {
  return (file.parent_path() / path).lexically_normal();
}

}  // namespace panvo::runtime
