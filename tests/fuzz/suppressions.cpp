// SPDX-License-Identifier: GPL-3.0-or-later
// UDUNITS-2 leaks the identifiers of a text that it refuses, HDF5 parts of a file that it cannot read.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libudunits2\nleak:libhdf5\n";
}
