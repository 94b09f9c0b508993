# SPDX-License-Identifier: GPL-3.0-or-later
# The tiers of the tests, which are ctest labels: fast, slow (explicit runs, hidden effects, other programs) and rates (counted rates).
# A test is fast unless its name stands here. ./check runs fast, ./check --slow also slow, ./check --rates also rates.
# CMake includes this file for tests it adds itself, ctest for the cases that it finds in GoogleTest programs.
set(coagula_slow_tests
  # hidden effects: whole diagnoses, power and responses that need simulations of their own
  "AgeingAfterShear[.]IsFound.*"
  "BondStrength[.].*"
  "BreakingBonds[.].*"
  "ActivatedRupture[.].*"
  "ContactLosses[.](A|Low).*"
  "ContactNonlinearity[.].*"
  "Diagnosis[.](FindsNothing|FollowsTheScale|NamesTheStrength|SaysThatADeparture|SaysWhenNoCause).*"
  "Evidence[.]OfAPair.*"
  "HiddenEffects[.](ASampleThatLiesApart|ErrorsOf|FalseParticles|LookAlikes|ShearStiffness|TwoEffects).*"
  "IonicStrength[.](More|Hidden).*"
  "MissingContacts[.](A|Curve|Follow).*"
  "NormalLoad[.]IsNamed.*"
  "PlateStrainField[.].*"
  "PoroelasticBackflow[.]Is.*"
  "Polydispersity[.].*"
  "PoreCurves[.].*"
  "Power[.].*"
  "Prestress[.].*"
  "Discrepancy[.]AValueAtTheEnd.*"
  "StoredResults[.]AreMadeAgain.*"
  "StructureError[.].*"
  "StructureSeries[.].*"
  "Sedimentation[.].*"
  "SolventDrag[.](IsFound|IsNamed|TheStructuresLeaveAnErrorThatHolds).*"
  "StructureCauses[.].*"
  "StructureChanges[.](Between|Contacts|Pores).*"
  "SurfacePotential[.].*"
  "ThirdHarmonic[.](Of|Hertz).*"
  "Thixotropy[.].*"
  "VolumeFractionGradient[.].*"
  "Verdict[.](OneRowTenTimesTooLargeIsNoName|WhatNoCauseDoesIsSaidToFollowTheTime)"
  "cli[.]slurm[.].*"
  "web[.]set_page[.].*"
  "BrownianDepletion[.]PairsHaveTheirBoltzmannDistribution"
  "python[.]pip[.].*"
  "cli[.]diagnosis[.]Diagnosis[.](a_hidden_loss_is_found|nothing_of_the_folder_is_lost)"
  "cli[.](diagnosis_tables|raw_columns|setting_samples)[.].*"
  "cli[.]cement_paste[.]CementPaste[.].*"
  "cli[.]measured_data[.]ReferenceStructure[.].*"
  "cli[.]power[.].*"
  "cli[.]dataset[.]Runs[.].*"
  "cli[.]step_tests[.]Creep[.]of_an_oil.*"
  "cli[.]recipe[.].*"
  "cli[.]report[.].*"
  "facts[.]sample"
  # explicit runs, sampled physics, equal bits for any number of threads
  "BrownianBonds[.].*"
  "BrownianClusters[.].*"
  "BrownianFlow[.](Free|Bound|Pairs).*"
  "BrownianModulus[.].*"
  "BrownianContacts[.]PairThat.*"
  "BrownianDynamics[.](DoesNotDependOnTheNumberOfThreads|DoesNotDependOnTheNumberOfThreadsInAFlow|GoesOnToTheSameBitsInAFlow)"
  "BrownianPhysics[.](FreeParticles|SecondaryMinimum|StabilisedSuspension|Barrier).*"
  "ContactLaws[.].*"
  "Forces[.]AndStepsAreEqualBit.*"
  "FrequencyResponse[.]WithoutLosses.*"
  "GeneralContacts[.]BalanceTheEnergyOfACycle"
  "HardSphereFluid[.].*"
  "NetworkFailure[.](SnappingParts|RampGoesOn).*"
  "PoreSizes[.]InterpolationOfTheCurveOfUnequal.*"
  "PoreSizes[.]DoNotDependOnTheNumberOfThreads"
  "RandomPoints[.].*"
  "Relax[.]IsEqualBit.*"
  "Rheometer[.]HasTheComplexModulus.*"
  "SampledAgainstExact[.].*"
  "(VoidsOfThreeKinds/)?ThreeMethods[.].*"
  "VoidExpansion[.]IsEqualBit.*"
  "VoidExpansionTwin[.].*"
  "cli[.]bad_input[.]Generation[.]unreachable_coordination"
  "cli[.]bad_packings[.].*"
  "cli[.]brownian[.]Restart[.].*"
  "cli[.]lammps_engine[.](Runs|Statistics)[.].*"
  "cli[.]petsc[.].*"
  "cli[.]lammps_shear[.](Gels|Moduli[.](of_bonds|of_springs|of_unequal)).*"
  "cli[.]calibrate[.]Calibrate[.]methods_agree"
  "cli[.]determinism[.].*"
  "cli[.]rheometer[.]Rheometer[.]a_killed_run.*"
  # many programs, or Python with the packages of others, one after the other
  "cli[.]instrument_exports[.]NewExperiment[.](prints|the_page).*"
  "cli[.]plot[.]Plot[.](every_second|the_other|mean_and|font).*"
  "cli[.]rheometer[.]Rheometer[.](what_the_plates|plates_without).*"
  "cli[.]text_formats[.]RoundTrip[.].*"
  "cli[.]usage[.]Writing[.]whole_numbers.*"
  "python[.]arrays[.](Views[.].*|Values[.](results|quantities).*)"
  "python[.](examples|other_programs|over_files)[.].*"
  # the fuzz targets, which a test builds first
  "fuzz[.].*"
  # the pages in a browser
  "web[.].*"
  # damaged files, kills, installation, every option; other programs; the manual and the examples there and in README.md
  "DamagedFile[.]SingleBytes"
  "cli[.]broken_files[.].*"
  "cli[.]examples[.].*"
  "cli[.]install[.].*"
  "cli[.]kills[.].*"
  "cli[.]materials[.]SmoothMaterial[.]inertia_of_a_stiff_tool"
  "cli[.]materials[.]RealExports[.](wormlike_micelles|yielding_and_recovery).*"
  "cli[.]option_sweep"
  "cli[.]quickstart[.].*"
  "mechanics_validation[.].*"
  "python[.]package[.]Stubs[.]mypy.*"
  "examples[.].*"
  "manual[.].*"
)
set(coagula_rates_tests
  "DiagnosisRates[.].*"
  "UncertaintyRates[.].*"
  "Noise[.]IntervalsCover.*"
  "PowerLaw[.]IntervalsCover.*"
  "ErrorShape[.]FindsCorrelationByChance.*"
)

set(coagula_fast_limit 250) # processor time that a fast test may take, in turns of a loop: 5 s on a usual machine

# coagula_set_tier(<test>...): label, limit and one thread for each. Unless the test is about threads, one is also the most: CHOLMOD
# asks for four, which wake and wait more than they work (15 % of a diagnosis).
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
    set(most "OMP_THREAD_LIMIT=set:1;")
    if(test MATCHES "[Tt]hread|^RunTogether[.]")
      set(most "")
    endif()
    set(heap # as tools/cli/main.cpp has it
      glibc.malloc.hugetlb=1:glibc.malloc.mmap_max=0:glibc.malloc.top_pad=16777216:glibc.malloc.trim_threshold=1099511627776)
    set_tests_properties("${test}" PROPERTIES LABELS ${tier} ENVIRONMENT_MODIFICATION
      "${most}COAGULA_PROCESSOR_LIMIT=set:${limit};OMP_NUM_THREADS=set:1;OPENBLAS_NUM_THREADS=set:1;GOMP_SPINCOUNT=set:3000;GLIBC_TUNABLES=set:${heap}")
  endforeach()
endfunction()
