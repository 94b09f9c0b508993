# SPDX-License-Identifier: GPL-3.0-or-later
# What every library of coagula has in common: alias, include folder, warnings, installation of headers and an export set of its own.

set(COAGULA_COMPONENTS "" CACHE INTERNAL "libraries that are installed")

function(coagula_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wmisleading-indentation)
  # GCC 12 sees overlapping, endless and stray copies in std::string that are not there (GCC bugs 105651 and 105329).
  target_compile_options(${target} PRIVATE
    "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>")
  if(COAGULA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(COAGULA_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(COAGULA_FUZZ)
    target_compile_options(${target} PUBLIC
      -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  endif()
  if((COAGULA_SANITIZE OR COAGULA_FUZZ) AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitizer-ignorelist.txt)
  endif()
endfunction()

# coagula_unity(<target>): with COAGULA_UNITY its sources are compiled in batches. Names in their unnamed namespaces must then differ from
# each other and from names outside, which they would hide in the whole batch. Sources with the same names by design say
# SKIP_UNITY_BUILD_INCLUSION.
function(coagula_unity target)
  if(COAGULA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # Names of one source shadow nothing in the next one, and a source is no header.
    target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wshadow=local;-Wno-subobject-linkage>")
  endif()
endfunction()

# coagula_precompile(<target> [LIKE <other>] [<header>...]): what nearly every source of the target includes is parsed once, for all targets
# that are compiled alike. Sources with compile options of their own say SKIP_PRECOMPILE_HEADERS.
function(coagula_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 COMPILED "" "LIKE" "")
  if(COMPILED_LIKE)
    target_precompile_headers(${target} REUSE_FROM ${COMPILED_LIKE})
  else()
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <algorithm> <cmath> <functional> <optional> <stdexcept> <string> <vector>
      ${COMPILED_UNPARSED_ARGUMENTS})
  endif()
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# coagula_glue(<target>): reads, writes and arranges, and computes little itself. It is optimised only so far as costs the compiler little,
# with sanitizers not at all.
function(coagula_glue target)
  if(COAGULA_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# coagula_library(<name> [GLUE] [LIKE <other>] [<header>...]): finishes the target coagula_<name> made by the caller; GLUE: coagula_glue,
# the others: coagula_precompile.
function(coagula_library name)
  cmake_parse_arguments(PARSE_ARGV 1 LIBRARY "GLUE" "" "")
  set(target coagula_${name})
  add_library(coagula::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
    DEFINE_SYMBOL "") # a macro of its own would keep a shared library from taking the precompiled headers of another
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  coagula_warnings(${target})
  coagula_unity(${target})
  if(LIBRARY_GLUE)
    coagula_glue(${target})
  endif()
  coagula_precompile(${target} ${LIBRARY_UNPARSED_ARGUMENTS})
  install(TARGETS ${target} EXPORT coagula_${name}_targets COMPONENT ${name})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${name})
  install(EXPORT coagula_${name}_targets NAMESPACE coagula:: FILE coagula-${name}-targets.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/coagula COMPONENT ${name})
  set(COAGULA_COMPONENTS ${COAGULA_COMPONENTS} ${name} CACHE INTERNAL "libraries that are installed")
endfunction()

# coagula_install_package(): find_package(coagula COMPONENTS ...) for the installed libraries.
function(coagula_install_package)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/coagula)
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/coagulaConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/coagulaConfig.cmake" INSTALL_DESTINATION ${folder})
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/coagulaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/coagulaConfig.cmake" "${PROJECT_BINARY_DIR}/coagulaConfigVersion.cmake"
    "${PROJECT_SOURCE_DIR}/cmake/FindRandom123.cmake" "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake"
    "${PROJECT_SOURCE_DIR}/cmake/FindFreeXL.cmake" "${PROJECT_SOURCE_DIR}/cmake/FindMinizip.cmake" "${PROJECT_SOURCE_DIR}/cmake/FindMUMPS.cmake"
    "${PROJECT_SOURCE_DIR}/cmake/FindUDUNITS2.cmake"
    DESTINATION ${folder} COMPONENT common)
endfunction()
