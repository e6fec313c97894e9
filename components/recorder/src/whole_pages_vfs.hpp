// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::recorder {

/// Name of a read-only SQLite VFS that presents a database as if it ended at its last complete page. Otherwise SQLite
/// fills the last page of a truncated file with zeros and returns messages that end in these zeros.
const char* whole_pages_vfs();

}  // namespace panvo::recorder
