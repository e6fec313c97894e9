# SPDX-License-Identifier: Apache-2.0
# cmake -DMACRO=NAME -DHEADERS="a.hpp;b.hpp" -DOUTPUT=file.hpp -P panvo_fingerprint.cmake: a header that defines NAME as a digest of those
# headers, names and contents. One that would stay the same keeps its time, so that nothing is compiled again for it.
set(all "")
foreach(header IN LISTS HEADERS)
  file(SHA256 ${header} digest)
  cmake_path(GET header FILENAME name)
  string(APPEND all "${digest} ${name}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 12 digest)
set(text "// SPDX-License-Identifier: Apache-2.0\n#pragma once\n\n/// Of the public headers: what was compiled with others does not fit.\n#define ${MACRO} \"${digest}\"\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
