// The table of measures. A measure is one file in measures/ and one line in each of the two lists here.
#include <coagula/characterize/measure.hpp>

namespace coagula::characterize {

Measure coordination_measure();
Measure doh_measure();
Measure pores_measure();
Measure overlap_measure();
Measure fabric_measure();
Measure rigidity_central_measure();
Measure rigidity_measure();
Measure rings_measure();
Measure sampled_check_measure();
Measure topology_measure();

const std::vector<Measure>& measures() {
    static const std::vector<Measure> table = {
        coordination_measure(),
        doh_measure(),
        pores_measure(),
        overlap_measure(),
        topology_measure(),
        rings_measure(),
        fabric_measure(),
        rigidity_measure(),
        rigidity_central_measure(),
        sampled_check_measure(),
    };
    return table;
}

}  // namespace coagula::characterize
