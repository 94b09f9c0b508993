# SPDX-License-Identifier: GPL-3.0-or-later
# Writes version.hpp with the git revision, "unknown" outside a git checkout.
# cmake -DSOURCE=... -DTEMPLATE=... -DHEADER=... -DCOAGULA_VERSION=... -P version.cmake
set(COAGULA_REVISION "unknown")
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND "${GIT_PROGRAM}" describe --always --dirty --abbrev=12 --exclude=*
    WORKING_DIRECTORY "${SOURCE}" RESULT_VARIABLE result OUTPUT_VARIABLE revision
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(result EQUAL 0)
    set(COAGULA_REVISION "${revision}")
  endif()
endif()
configure_file("${TEMPLATE}" "${HEADER}" @ONLY)
