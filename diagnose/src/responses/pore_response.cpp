// Pore curves of the structures, as they are and as measured coordinates would show them.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <utility>

namespace coagula::diagnose {

const PoreCurve& Simulator::pore_curve(std::size_t structure) {
    if (const auto known = pore_curves_.find(structure); known != pore_curves_.end()) {
        return known->second;
    }
    const std::string key = "pores " + names_[structure];
    auto found = cache_.find(key);
    if (found == cache_.end() || found->second.size() < 3) {
        progress_.update("simulating", 0.0, "pores");
        const PoreCurve measured = measured_pores(structures_[structure]);
        std::vector<double> values{measured.largest};
        values.insert(values.end(), measured.probability.begin(), measured.probability.end());
        found = cache_.insert_or_assign(key, std::move(values)).first;
    }
    const std::vector<double>& values = found->second;
    return pore_curves_[structure] = {values.front(), {values.begin() + 1, values.end()}};
}

PoreCurve Simulator::measured_pores(const Packing& packing) const {
    require(static_cast<bool>(stages_.measure_pores), "nothing measures the pores of the structures");
    return stages_.measure_pores(packing);
}

double Simulator::mean_exclusion_probability(double pore_radius) {
    double sum = 0;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        sum += pore_curve(k).at(pore_radius);
    }
    return sum / static_cast<double>(structures_.size());
}

double Simulator::exclusion_probability(const Settings& settings, double pore_radius, bool exact) {
    const double changed =
        over_changes(change_of(settings), [&](Simulator& other) { return other.mean_exclusion_probability(pore_radius); });
    const double images = change_in_images(settings, pore_radius, mean_exclusion_probability(pore_radius), exact);
    return std::clamp(changed + images, 0.0, 1.0);
}

}  // namespace coagula::diagnose
