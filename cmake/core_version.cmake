# cmake -DFOLDER=core -DOUTPUT=core_version.cpp -P core_version.cmake
# Writes core_version(): the SHA-256 over name and content of every source file of the core.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*.h ${FOLDER}/*.cpp)
list(SORT files)
set(hashes "")
foreach(file IN LISTS files)
  file(SHA256 ${FOLDER}/${file} hash)
  string(APPEND hashes "${file} ${hash}\n")
endforeach()
string(SHA256 version "${hashes}")
string(SUBSTRING ${version} 0 16 version)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "core/base/core_version.h"

namespace pleat {

const char* core_version() { return "core-@version@"; }

}  // namespace pleat
]] @ONLY)
