#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism gap_error() {
    return {.name = "gap-error",
            .term = "the gap is larger than stated",
            .signature = "all moduli lower by one factor, more at small gaps, also in a Newtonian oil",
            .parameters = {{"gap_error", "m", 1e-5, 6e-5, true}},
            .effect = ChangesGeometry{[](std::complex<double> modulus, const Observation& row, Values values) {
                return std::isfinite(row.gap) ? modulus * row.gap / (row.gap + values[0]) : modulus;
            }},
            .applies = knows_gap};
}

}  // namespace coagula::diagnose::mechanisms
