# Run by ctest behind the list of tests of each program.
include("${CMAKE_CURRENT_LIST_DIR}/tiers.cmake")
coagula_set_tier(${coagula_discovered})

# Where a program has simulations that its tests share, they are made first; what that takes does not count against a test.
foreach(test IN LISTS coagula_discovered)
  if(test MATCHES "^StoredSimulations[.]")
    set_tests_properties(${coagula_discovered} PROPERTIES FIXTURES_REQUIRED simulations)
    set_tests_properties("${test}" PROPERTIES FIXTURES_REQUIRED "" FIXTURES_SETUP simulations
      ENVIRONMENT_MODIFICATION "COAGULA_PROCESSOR_LIMIT=set:0;GOMP_SPINCOUNT=set:3000")
  endif()
endforeach()
