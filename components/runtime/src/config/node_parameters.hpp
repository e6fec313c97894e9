// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "panvo/interfaces/qos.hpp"
#include "panvo/runtime/parameters.hpp"

namespace panvo::runtime {

/// Parameters that every node has, as in ROS 2: use_sim_time, and
/// qos_overrides./TOPIC.{publisher,subscription}.{reliability,durability,depth,history} of each topic that it opens, by
/// the resolved name of the topic. The latter are read-only. Thread-safe.
class NodeParameters {
 public:
  static constexpr std::string_view kUseSimTime = "use_sim_time";
  enum class Side : std::uint8_t { kPublisher, kSubscription };

  /// Uses the values for these parameters in `written`. `owner` names the node in messages.
  NodeParameters(std::string owner, const WrittenValues& written);

  /// The values for other parameters.
  static WrittenValues others(const WrittenValues& written);

  bool uses_sim_time() const;
  void use_sim_time(bool use);
  /// use_sim_time in `wanted`; monostate: absent; text: the problem with it.
  std::variant<std::monostate, bool, std::string> wanted_sim_time(const WrittenValues& wanted) const;

  /// Declares the parameters for a topic whose quality of service is `qos` by default. Returns the overriding one;
  /// nullopt if there is none.
  std::optional<interfaces::Qos> overriding(const std::string& topic, Side side, const interfaces::Qos& qos);

  std::vector<ParameterDescription> declared() const;
  /// Invalid values, and overrides for topics that the node does not open.
  std::vector<std::string> problems() const;

 private:
  const std::string owner_;
  mutable std::mutex mutex_;
  ParameterReader reader_;
  bool uses_sim_time_ = false;
};

}  // namespace panvo::runtime
