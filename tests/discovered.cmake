# SPDX-License-Identifier: GPL-3.0-or-later
# Run by ctest behind the list of tests of each program.
include("${CMAKE_CURRENT_LIST_DIR}/tiers.cmake")
coagula_set_tier(${coagula_discovered})

# Where a program has simulations that its tests share, they are made first; what that takes does not count against a test.
set(coagula_first ${coagula_discovered})
list(FILTER coagula_first INCLUDE REGEX "^StoredSimulations[.]")
if(coagula_first)
  list(REMOVE_ITEM coagula_discovered ${coagula_first})
  set_tests_properties(${coagula_discovered} PROPERTIES FIXTURES_REQUIRED simulations)
  set_tests_properties(${coagula_first} PROPERTIES FIXTURES_SETUP simulations
    ENVIRONMENT_MODIFICATION
      "OMP_THREAD_LIMIT=set:1;OMP_NUM_THREADS=set:1;OPENBLAS_NUM_THREADS=set:1;COAGULA_PROCESSOR_LIMIT=set:0")
endif()
