// SPDX-License-Identifier: Apache-2.0
#include "store_merge.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <memory>

#include "panvo/landmarks/landmark_store.hpp"

namespace panvo::landmarks {
namespace {

namespace fs = std::filesystem;

/// A temporary file that is removed on destruction unless finish() renamed it.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const fs::path& named) : named_(named) {
    unfinished_ += ".unfinished";
    remove();  // left by a killed process
  }
  ~UnfinishedFile() { remove(); }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const fs::path& path() const noexcept { return unfinished_; }

  void finish() {
    std::error_code error;
    fs::rename(unfinished_, named_, error);
    if (error) throw StoreError(named_.string() + ": cannot be created (" + error.message() + "); nothing was changed");
    // Syncing the folder makes the rename durable.
    const auto folder = fs::absolute(named_).parent_path();
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
      ::fsync(descriptor);
      ::close(descriptor);
    }
  }

 private:
  void remove() const noexcept {
    std::error_code ignored;
    fs::remove(unfinished_, ignored);
    fs::path journal = unfinished_;
    fs::remove(journal += "-journal", ignored);
  }

  fs::path named_;
  fs::path unfinished_ = named_;
};

}  // namespace

std::vector<MergedPart> merge_stores(const std::vector<fs::path>& stores, const fs::path& out, bool replace) {
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
    for (const auto& source : sources) parts.push_back({source->file(), source->size(), merged.append(*source)});
  }
  file.finish();
  return parts;
}

}  // namespace panvo::landmarks
