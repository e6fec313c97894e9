// SPDX-License-Identifier: Apache-2.0
#include "store_copy.hpp"

#include "panvo/landmarks/landmark_store.hpp"
#include "unfinished_file.hpp"

namespace panvo::landmarks {

std::size_t copy_store(const StoreLocation& from, const StoreLocation& to, bool replace,
                       const std::function<void(const std::string&)>& report) {
  const LandmarkStore source(from);
  if (to.is_server()) return LandmarkStore(to, source.settings()).become_copy_of(source, replace, report);
  const std::filesystem::path file = to.text();
  if (std::filesystem::exists(file)) {
    if (!replace) throw StoreError(to.shown() + ": already exists; name a new file or pass --overwrite");
    LandmarkStore(file).size();  // throws if it is not a store: only stores are replaced
  }
  UnfinishedFile unfinished(file);
  const auto count = LandmarkStore(unfinished.path(), source.settings()).become_copy_of(source, false, report);
  unfinished.finish();
  return count;
}

}  // namespace panvo::landmarks
