# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by CPack: coagula (program), libcoagula-dev (libraries) and python3-coagula (Python module). packaging/build-packages
# makes them from a tree that is configured for /usr.
set(COAGULA_PACKAGE_CONTACT "coagula developers <coagula@users.noreply.github.com>" CACHE STRING
  "Maintainer that the Debian packages name: whoever publishes them")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME coagula)
set(CPACK_PACKAGE_CONTACT "${COAGULA_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "random sphere packings and colloidal gels")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # as Debian wants them, whatever the umask
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/packaging/compress_manual.cmake")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME coagula)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "coagula generates random sphere packings and coagulated particle gels,
measures how heterogeneous they are, shears them and tells why a simulation
differs from measured moduli.")

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libcoagula-dev)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS libceres-dev libcgal-dev libeigen3-dev libexpat1-dev libfreexl-dev libhdf5-dev
  libminizip-dev libmumps-seq-dev libopenblas-dev librandom123-dev libssl-dev libsuitesparse-dev libtomlplusplus-dev libudunits2-dev
  nlohmann-json3-dev zlib1g-dev)
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Static libraries, headers and the CMake package coagula: generators of
random sphere packings and colloidal gels, measures of their structure,
their mechanics, and the diagnosis of measured moduli.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-coagula)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR coagula_next_minor "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${coagula_next_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, python3-h5py")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The module coagula generates, measures, shears and diagnoses random
sphere packings and colloidal gels, with numpy arrays in and out.")

# Only where PETSc was found: coagula-petsc runs on many processors.
set(CPACK_DEBIAN_PETSC_PACKAGE_NAME coagula-petsc)
set(CPACK_DEBIAN_PETSC_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PETSC_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PETSC_PACKAGE_DEPENDS "coagula (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_COMPONENT_PETSC_DESCRIPTION "The solver of coagula shear --engine petsc, for packings that one machine
takes long for.")

# Each package has its copyright and its changes beside it.
set(coagula_changes "${PROJECT_BINARY_DIR}/changelog")
string(TIMESTAMP coagula_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${coagula_changes}" "coagula (${PROJECT_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md of the source.

 -- ${COAGULA_PACKAGE_CONTACT}  ${coagula_date}
")
execute_process(COMMAND gzip -9nf "${coagula_changes}" COMMAND_ERROR_IS_FATAL ANY)
set(coagula_packages coagula libcoagula-dev python3-coagula)
set(coagula_components tools common python)
if(TARGET coagula-petsc)
  list(APPEND coagula_packages coagula-petsc)
  list(APPEND coagula_components petsc)
endif()
foreach(package component IN ZIP_LISTS coagula_packages coagula_components)
  install(FILES packaging/copyright "${coagula_changes}.gz" DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()

# The manual and the examples, which help texts and messages name by their paths.
install(DIRECTORY docs examples DESTINATION share/doc/coagula COMPONENT tools
  PATTERN conf.py EXCLUDE PATTERN Doxyfile EXCLUDE PATTERN static EXCLUDE PATTERN __pycache__ EXCLUDE)
install(FILES README.md DESTINATION share/doc/coagula COMPONENT tools)

include(CPack)
cpack_add_component_group(program)
cpack_add_component_group(libraries)
cpack_add_component_group(python)
cpack_add_component(tools GROUP program)
cpack_add_component(python GROUP python)
if(TARGET coagula-petsc)
  cpack_add_component_group(petsc)
  cpack_add_component(petsc GROUP petsc)
endif()
foreach(component IN LISTS COAGULA_COMPONENTS)
  cpack_add_component(${component} GROUP libraries)
endforeach()
