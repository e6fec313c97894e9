// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::runtime {

/// A component that plays recorded data. Live, the runtime calls it on its own thread, paced by the stamps (at the
/// recorded rate, scaled, or as fast as the consumers allow). In replay, the source with the earliest stamp steps when
/// all queues are empty. Calls never overlap.
class Source {
 public:
  virtual ~Source() = default;

  /// Stamp of the next emit(), ns, never decreasing; nullopt at the end.
  virtual std::optional<std::int64_t> next_stamp_ns() = 0;

  /// Publishes all messages of that stamp. Unreadable data is logged and skipped, or ends the run with a
  /// std::runtime_error that names the file.
  virtual void emit() = 0;

  /// Steps for the progress display; total 0: unknown.
  struct Progress {
    std::uint64_t done = 0, total = 0;
  };
  virtual Progress progress() const = 0;
};

}  // namespace panvo::runtime
