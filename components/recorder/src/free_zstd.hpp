// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zstd.h>

namespace panvo::recorder {

struct FreeZstd {
  void operator()(ZSTD_DCtx* context) const noexcept { ZSTD_freeDCtx(context); }
};

}  // namespace panvo::recorder
