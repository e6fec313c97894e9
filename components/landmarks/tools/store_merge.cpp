// SPDX-License-Identifier: Apache-2.0
#include "store_merge.hpp"

#include <memory>

#include "panvo/landmarks/landmark_store.hpp"
#include "unfinished_file.hpp"

namespace panvo::landmarks {
namespace fs = std::filesystem;

std::vector<MergedPart> merge_stores(const std::vector<std::string>& stores, const fs::path& out, bool replace) {
  if (const StoreLocation location(out); location.is_server()) {
    throw StoreError(location.shown() + ": stores are merged into a file; then use panvo landmarks copy");
  }
  if (fs::exists(out) && !replace) {
    throw StoreError(out.string() + ": already exists; name a new file or pass --overwrite");
  }
  if (fs::exists(out)) LandmarkStore(out).size();  // throws if it is not a store: only stores are replaced
  std::vector<std::unique_ptr<LandmarkStore>> sources;
  for (const auto& path : stores) {
    sources.push_back(std::make_unique<LandmarkStore>(path));
    sources.back()->require(sources.front()->settings());
  }
  std::vector<MergedPart> parts;
  UnfinishedFile file(out);
  {
    LandmarkStore merged(file.path(), sources.at(0)->settings());
    for (const auto& source : sources) parts.push_back({source->name(), source->size(), merged.append(*source)});
  }
  file.finish();
  return parts;
}

}  // namespace panvo::landmarks
