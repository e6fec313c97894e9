# SPDX-License-Identifier: Apache-2.0
# cmake -DMACRO=NAME -DHEADERS="a.hpp;b.hpp" -DOUTPUT=file.hpp -P panvo_fingerprint.cmake: writes a header that defines NAME as a digest of
# the names and contents of these headers. If the text is unchanged, the file is not written, so nothing is recompiled.
set(all "")
foreach(header IN LISTS HEADERS)
  file(SHA256 ${header} digest)
  cmake_path(GET header FILENAME name)
  string(APPEND all "${digest} ${name}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 12 digest)
set(text "// SPDX-License-Identifier: Apache-2.0\n#pragma once\n\n/// Digest of the public headers; code compiled with other versions of them is incompatible.\n#define ${MACRO} \"${digest}\"\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
