// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::runtime {

/// A component that plays something recorded: the runtime decides when, the source what. Live, the runtime calls it on a thread of its own,
/// paced by the stamps (at the recorded rate, scaled, or as fast as the consumers take it); in replay, whenever all else is quiet, the source
/// with the earliest stamp first. Calls never overlap.
class Source {
 public:
  virtual ~Source() = default;

  /// Stamp of what emit() would publish next, ns, never decreasing; nullopt at the end.
  virtual std::optional<std::int64_t> next_stamp_ns() = 0;

  /// Publishes everything of that one stamp. Data that cannot be read are reported to the log and skipped, or end the run by throwing
  /// std::runtime_error that names the file.
  virtual void emit() = 0;

  /// Steps done and in all, for the progress display; total 0: not known.
  struct Progress {
    std::uint64_t done = 0, total = 0;
  };
  virtual Progress progress() const = 0;
};

}  // namespace panvo::runtime
