// SPDX-License-Identifier: Apache-2.0
#include "save_service.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "panvo/interfaces/service.hpp"
#include "panvo/landmarks/store_error.hpp"
#include "saved_copy.hpp"
#include "std_srvs/srv/Trigger.h"

namespace panvo::landmarks {
namespace {

using std_srvs::srv::Trigger_Request;
using std_srvs::srv::Trigger_Response;

constexpr interfaces::Service<Trigger_Request, Trigger_Response> kSave{"~/save"};

/// Returns what to tell; throws StoreError with what to do.
std::string save(const runtime::Context& context, const StoreLocation& location, std::optional<std::size_t> waiting) {
  if (location.text().empty()) throw StoreError("nothing is stored: set landmark_store.file");
  if (location.is_server()) {
    throw StoreError(fmt::format("the map is in a database: run panvo landmarks copy {} FILE", location.shown()));
  }
  if (!waiting) throw StoreError("the store is not open yet: save again in a few seconds");
  const std::filesystem::path file = location.text();
  if (!std::filesystem::exists(file)) throw StoreError("no landmarks are stored yet: drive on, then save again");
  const auto copy = save_beside(file, context.host_ns().value_or(context.passing_ns()));
  const auto told = fmt::format("{} landmarks saved as {}", copy.landmarks, copy.file.filename().string());
  if (*waiting == 0) return told;
  return fmt::format("{}, without {} changes that wait until another process has read the store", told, *waiting);
}

}  // namespace

void offer_saving(runtime::Context& context, const StoreLocation& location,
                  std::function<std::optional<std::size_t>()> waiting) {
  context.serve(kSave, [&context, location, waiting = std::move(waiting)](const Trigger_Request&) {
    Trigger_Response response;
    try {
      response.message(save(context, location, waiting()));
      response.success(true);
      context.log().info("{}", response.message());
    } catch (const std::exception& error) {
      response.message(error.what());
      context.log().warn("the map was not saved: {}", error.what());
    }
    return response;
  });
}

}  // namespace panvo::landmarks
