// UDUNITS-2 leaks the identifiers of a text that it refuses.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libudunits2\n";
}
