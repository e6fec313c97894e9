// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::recorder {

/// The name of a SQLite file layer that shows a database as if it ended at its last whole page. Of a file that was
/// cut off SQLite itself would fill the last page up with zeros, and hand out messages that end in zeros as if they
/// had been recorded so. For reading only.
const char* whole_pages_vfs();

}  // namespace panvo::recorder
