// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "panvo/runner/run_files.hpp"

namespace panvo::runner {

inline constexpr const char* kTimingFile = "timing.json";
inline constexpr const char* kSummaryFile = "summary.json";

using Json = nlohmann::ordered_json;

/// {"components": {NAME: {"stages": {STAGE: {"count": n, "wall_ms": {"mean", "median", "p95", "p99", "max"},
/// "cpu_ms": the same}}}}}
Json timing_json(const runtime::ComponentTimes& times_by_component);

Json summary_json(const RunSummary& summary);

/// Throws nlohmann::json::exception if a key is missing or has another type.
RunSummary summary_from(const Json& json);

/// Indented, with a final newline. Invalid UTF-8 bytes are replaced.
std::string to_text(const Json& json);

}  // namespace panvo::runner
