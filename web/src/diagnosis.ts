// The page of coagula diagnose.
