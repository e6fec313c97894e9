// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::runtime {

/// First and last stamp of recorded data, ns.
struct StampRange {
  std::int64_t first_ns, last_ns;
};

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

  /// Whether, live, the source waits at its end until it is moved back, see seek(). Otherwise the run ends.
  virtual bool waits_at_end() const { return false; }

  /// What seek() accepts; nullopt: the source cannot be moved.
  virtual std::optional<StampRange> range() const { return std::nullopt; }

  /// Live: the next step is the first one not stamped before `stamp_ns`. Called from any thread.
  virtual void seek(std::int64_t stamp_ns) { static_cast<void>(stamp_ns); }
};

/// How the sources of this process are played, live. Changes have no effect in replay. Thread-safe.
class Playback {
 public:
  virtual ~Playback() = default;
  virtual void pause() = 0;
  virtual void resume() = 0;
  virtual bool is_paused() const = 0;
  /// Relative to the recorded speed; 0: as fast as possible.
  virtual double rate() const = 0;
  /// Stamp of the newest step, also in replay; nullopt: nothing is played.
  virtual std::optional<std::int64_t> stamp_ns() const = 0;
  /// Whether all sources have reached their end, live.
  virtual bool is_at_end() const = 0;
  /// False if the present rate or `rate` is 0.
  virtual bool set_rate(double rate) = 0;
  /// Of all sources that can be moved; nullopt in replay, or if none can.
  virtual std::optional<StampRange> range() const = 0;
  /// Moves these sources to a stamp, limited to range(), which is due now. False if there is none.
  virtual bool seek(std::int64_t stamp_ns) = 0;
};

}  // namespace panvo::runtime
