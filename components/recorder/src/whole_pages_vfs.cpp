// SPDX-License-Identifier: Apache-2.0
#include "whole_pages_vfs.hpp"

#include <sqlite3.h>

#include <array>
#include <cstdint>

namespace panvo::recorder {
namespace {

/// An open file; the file object of the underlying VFS follows it in memory.
struct File {
  sqlite3_file base;
  sqlite3_int64 page_size;  // 0: not a database
};

sqlite3_file* below(sqlite3_file* file) { return reinterpret_cast<sqlite3_file*>(reinterpret_cast<File*>(file) + 1); }

sqlite3_int64 page_size_of(sqlite3_file* file) {
  std::array<std::uint8_t, 18> header{};
  if (file->pMethods->xRead(file, header.data(), header.size(), 0) != SQLITE_OK) {
    return 0;
  }
  const sqlite3_int64 written = header[16] << 8 | header[17];
  return written == 1 ? 65536 : written;
}

int close(sqlite3_file* file) { return below(file)->pMethods->xClose(below(file)); }
int read(sqlite3_file* file, void* out, int bytes, sqlite3_int64 at) {
  return below(file)->pMethods->xRead(below(file), out, bytes, at);
}
int write(sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; }
int truncate(sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; }
int sync(sqlite3_file*, int) { return SQLITE_OK; }
int lock(sqlite3_file* file, int level) { return below(file)->pMethods->xLock(below(file), level); }
int unlock(sqlite3_file* file, int level) { return below(file)->pMethods->xUnlock(below(file), level); }
int check_reserved_lock(sqlite3_file* file, int* out) {
  return below(file)->pMethods->xCheckReservedLock(below(file), out);
}
int control(sqlite3_file* file, int what, void* argument) {
  return below(file)->pMethods->xFileControl(below(file), what, argument);
}
int sector_size(sqlite3_file* file) { return below(file)->pMethods->xSectorSize(below(file)); }
int characteristics(sqlite3_file* file) { return below(file)->pMethods->xDeviceCharacteristics(below(file)); }

int size(sqlite3_file* file, sqlite3_int64* bytes) {
  const int result = below(file)->pMethods->xFileSize(below(file), bytes);
  if (const auto page_size = reinterpret_cast<File*>(file)->page_size; result == SQLITE_OK && page_size > 0) {
    *bytes -= *bytes % page_size;
  }
  return result;
}

constexpr sqlite3_io_methods kMethods{.iVersion = 1,  // no shared memory, no memory mapping
                                      .xClose = close,
                                      .xRead = read,
                                      .xWrite = write,
                                      .xTruncate = truncate,
                                      .xSync = sync,
                                      .xFileSize = size,
                                      .xLock = lock,
                                      .xUnlock = unlock,
                                      .xCheckReservedLock = check_reserved_lock,
                                      .xFileControl = control,
                                      .xSectorSize = sector_size,
                                      .xDeviceCharacteristics = characteristics,
                                      .xShmMap = nullptr,
                                      .xShmLock = nullptr,
                                      .xShmBarrier = nullptr,
                                      .xShmUnmap = nullptr,
                                      .xFetch = nullptr,
                                      .xUnfetch = nullptr};

int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  auto* system = static_cast<sqlite3_vfs*>(vfs->pAppData);
  file->pMethods = nullptr;  // SQLite calls xClose only if this is set
  const int result = system->xOpen(system, name, below(file), flags, out_flags);
  if (result == SQLITE_OK) {
    reinterpret_cast<File*>(file)->page_size = flags & SQLITE_OPEN_MAIN_DB ? page_size_of(below(file)) : 0;
    file->pMethods = &kMethods;
  }
  return result;
}

}  // namespace

const char* whole_pages_vfs() {
  static sqlite3_vfs vfs = [] {
    sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
    sqlite3_vfs ours = *system;  // inherits all functions that do not concern open files
    ours.zName = "panvo_whole_pages";
    ours.szOsFile = static_cast<int>(sizeof(File)) + system->szOsFile;
    ours.pNext = nullptr;
    ours.pAppData = system;
    ours.xOpen = open;
    return ours;
  }();
  static const int registered = sqlite3_vfs_register(&vfs, 0);
  return registered == SQLITE_OK ? vfs.zName : nullptr;
}

}  // namespace panvo::recorder
