# SPDX-License-Identifier: GPL-3.0-or-later
# Sequential MUMPS in complex double precision (zmumps; Debian's has the dummy MPI inside). Defines MUMPS::ZMUMPS.
find_path(MUMPS_INCLUDE_DIR zmumps_c.h)
find_library(MUMPS_ZMUMPS_LIBRARY zmumps_seq)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MUMPS REQUIRED_VARS MUMPS_ZMUMPS_LIBRARY MUMPS_INCLUDE_DIR)
if(MUMPS_FOUND AND NOT TARGET MUMPS::ZMUMPS)
  add_library(MUMPS::ZMUMPS UNKNOWN IMPORTED)
  set_target_properties(MUMPS::ZMUMPS PROPERTIES
    IMPORTED_LOCATION "${MUMPS_ZMUMPS_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}")
endif()
