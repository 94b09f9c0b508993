#!/bin/sh
# From a packing to its modulus; gel.html is the page to look at.
set -eu
coagula generate vem --particles 1000 --voids 500 --volume-fraction 0.4 --radius 0.25um --quiet -o gel.h5
coagula characterize gel.h5 --quiet
coagula shear gel.h5 --normal-stiffness 100N/m --shear-stiffness 10N/m --quiet
coagula info gel.h5
coagula report gel.h5 --quiet -o gel.html
