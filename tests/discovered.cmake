# Run by ctest behind the list of tests of each program.
include("${CMAKE_CURRENT_LIST_DIR}/tiers.cmake")
coagula_set_tier(${coagula_discovered})
