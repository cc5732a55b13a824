# Installed packages only. Natively from Debian's -dev packages; for WebAssembly the header-only ones are linked in
# alone, because the include folder they live in holds the host's C library too.
if(EMSCRIPTEN)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/hosted)
  file(CREATE_LINK /usr/include/nlohmann ${CMAKE_BINARY_DIR}/hosted/nlohmann SYMBOLIC)
  add_library(pleat_json INTERFACE)
  target_include_directories(pleat_json SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/hosted)
  file(CREATE_LINK /usr/include/Spectra ${CMAKE_BINARY_DIR}/hosted/Spectra SYMBOLIC)
  add_library(pleat_spectra INTERFACE)
  target_include_directories(pleat_spectra SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/hosted)

  # scripts/fetch-suitesparse.sh puts the source there. Its GPL parts are neither fetched nor compiled.
  set(PLEAT_SUITESPARSE ${CMAKE_SOURCE_DIR}/third_party/suitesparse/src CACHE PATH "unpacked SuiteSparse")
  if(EXISTS ${PLEAT_SUITESPARSE}/CHOLMOD/Core/cholmod_common.c)
    set(S ${PLEAT_SUITESPARSE})
    file(GLOB PLEAT_SUITESPARSE_FILES CONFIGURE_DEPENDS
         ${S}/SuiteSparse_config/SuiteSparse_config.c ${S}/AMD/Source/amd_*.c ${S}/COLAMD/Source/colamd.c
         ${S}/CHOLMOD/Core/cholmod_*.c ${S}/CHOLMOD/Check/cholmod_check.c ${S}/CHOLMOD/Cholesky/cholmod_*.c)
    add_library(pleat_cholmod STATIC ${PLEAT_SUITESPARSE_FILES})
    target_include_directories(pleat_cholmod SYSTEM PUBLIC ${S}/SuiteSparse_config ${S}/AMD/Include
                                                           ${S}/COLAMD/Include ${S}/CHOLMOD/Include)
    target_compile_definitions(pleat_cholmod PUBLIC NPARTITION NCAMD NSUPERNODAL NMODIFY NMATRIXOPS NTIMER
                                             PRIVATE NPRINT)
    # A solve is as fast as with -O3 or -Os, and a page's modules 16 kB smaller.
    target_compile_options(pleat_cholmod PRIVATE -w -Oz -msimd128)
    set_target_properties(pleat_cholmod PROPERTIES UNITY_BUILD OFF)
  endif()
else()
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(nlohmann_json REQUIRED)
  add_library(pleat_json INTERFACE)
  target_link_libraries(pleat_json INTERFACE nlohmann_json::nlohmann_json)
  find_path(SPECTRA_INCLUDE_DIR Spectra/SymEigsShiftSolver.h REQUIRED)
  add_library(pleat_spectra INTERFACE)
  target_include_directories(pleat_spectra SYSTEM INTERFACE ${SPECTRA_INCLUDE_DIR})
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  add_library(pleat_cholmod INTERFACE)
  target_include_directories(pleat_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(pleat_cholmod INTERFACE ${CHOLMOD_LIBRARY})
endif()
