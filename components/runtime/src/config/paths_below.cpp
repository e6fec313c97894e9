// SPDX-License-Identifier: Apache-2.0
#include "paths_below.hpp"

#include <algorithm>
#include <system_error>

namespace panvo::runtime {
namespace fs = std::filesystem;

std::optional<std::string> path_problem(const std::string& path, const fs::path& folder) {
  if (path.empty()) return std::nullopt;
  if (folder.empty()) {
    return "names a file or folder, which service requests must not do; set it in the system file, or allow a folder "
           "there with files_below";
  }
  const std::string outside = "is not below " + folder.string() + " (files_below in the system file)";
  // A zero byte would end the path for the system, but not here.
  if (path.find('\0') != std::string::npos) return outside;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return "is refused: " + folder.string() + " (files_below in the system file) does not exist";
  fs::path meant = fs::weakly_canonical(fs::absolute(path), error);
  if (error) return outside;
  if (!meant.has_filename()) meant = meant.parent_path();  // "folder/"
  auto [in_root, in_meant] = std::mismatch(root.begin(), root.end(), meant.begin(), meant.end());
  if (in_root != root.end() || in_meant == meant.end()) return outside;
  // A remaining link is dangling; writing to it would create its target outside the folder.
  for (fs::path part = root; in_meant != meant.end(); ++in_meant) {
    part /= *in_meant;
    if (fs::is_symlink(fs::symlink_status(part, error))) return outside;
  }
  return std::nullopt;
}

}  // namespace panvo::runtime
