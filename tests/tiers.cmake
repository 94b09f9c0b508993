# The tiers of the tests, which are ctest labels: fast, slow (explicit runs, hidden effects, other programs) and rates (counted rates).
# A test is fast unless its name stands here. ./check runs fast, ./check --slow also slow, ./check --rates also rates.
# CMake includes this file for tests it adds itself, ctest for the cases that it finds in GoogleTest programs.
set(coagula_slow_tests
)
set(coagula_rates_tests
)

set(coagula_fast_limit 5) # seconds of processor time that a fast test may take

# coagula_set_tier(<test>...): label, limit and, unless the test is about threads, one thread for each.
function(coagula_set_tier)
  foreach(test IN LISTS ARGN)
    set(tier fast)
    foreach(candidate IN ITEMS slow rates)
      foreach(pattern IN LISTS coagula_${candidate}_tests)
        if(test MATCHES "^${pattern}$")
          set(tier ${candidate})
        endif()
      endforeach()
    endforeach()
    set(limit 0)
    if(tier STREQUAL fast)
      set(limit ${coagula_fast_limit})
    endif()
    set_tests_properties("${test}" PROPERTIES LABELS ${tier} ENVIRONMENT_MODIFICATION
      "COAGULA_PROCESSOR_LIMIT=set:${limit};OMP_NUM_THREADS=set:1;OPENBLAS_NUM_THREADS=set:1;GOMP_SPINCOUNT=set:3000")
  endforeach()
endfunction()
