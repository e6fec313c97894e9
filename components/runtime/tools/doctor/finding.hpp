// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace panvo::runtime::doctor {

enum class Severity : std::uint8_t {
  kOk,
  kWarning,  ///< works, but slower, less reliably or not everywhere
  kProblem   ///< something does not work
};

struct Finding {
  Severity severity = Severity::kOk;
  std::string subject;  ///< "socket buffers"
  std::string text;
  std::string remedy{};  ///< empty if ok
};

using Findings = std::vector<Finding>;

}  // namespace panvo::runtime::doctor
