// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/position_noise.hpp>

#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace coagula::characterize {

namespace {

const std::string root = "/characterization/";

/// The scalars that are measured, by name below the root: neither errors nor facts about the packing.
std::map<std::string, const Dataset*> scalars_of(const MeasureResult& result) {
    std::map<std::string, const Dataset*> scalars;
    for (const Dataset& dataset : result.datasets) {
        const std::string name = dataset.path.substr(root.size());
        const bool is_error = name.starts_with("uncertainty/") || name.find("stderr") != std::string::npos;
        if (dataset.shape.empty() && std::holds_alternative<std::vector<double>>(dataset.values) && !is_error) {
            scalars.emplace(name, &dataset);
        }
    }
    return scalars;
}

double value_of(const Dataset& dataset) {
    return std::get<std::vector<double>>(dataset.values).front();
}

struct Shift {
    std::string name, unit;
    double value = 0, mean = 0, error = 0;
};

Shift shift_of(const std::string& name, const Dataset& dataset, const std::vector<double>& noisy) {
    const auto count = static_cast<double>(noisy.size());
    const Eigen::Map<const Eigen::ArrayXd> values(noisy.data(), std::ssize(noisy));
    const double mean = values.mean();
    return {name, dataset.unit, value_of(dataset), mean - value_of(dataset),
            std::sqrt((values - mean).square().sum() / (count * (count - 1)))};
}

/// The scalars that move most, relative to their value, for people.
void add_lines(std::vector<Shift> shifts, MeasureResult& result) {
    constexpr std::size_t most = 12;
    constexpr double noticeable = 0.001;
    const auto relative = [](const Shift& shift) { return shift.value != 0 ? std::abs(shift.mean / shift.value) : 0.0; };
    std::erase_if(shifts,
                  [&](const Shift& shift) { return relative(shift) < noticeable || std::abs(shift.mean) < 2 * shift.error; });
    std::stable_sort(shifts.begin(), shifts.end(),
                     [&](const Shift& one, const Shift& other) { return relative(one) > relative(other); });
    shifts.resize(std::min(shifts.size(), most));
    for (const Shift& shift : shifts) {
        result.add_line("noise moves " + shift.name,
                        with_unit(shift.mean, shift.unit) + ", " + with_unit(100 * shift.mean / shift.value, "%"));
    }
}

}  // namespace

Packing with_noise(const Packing& packing, const PositionNoise& noise, std::uint64_t seed, std::uint64_t replica) {
    require(noise.deviation.allFinite() && noise.deviation.minCoeff() >= 0,
            "the noise of the positions must be finite and not negative along each axis");
    Packing noisy = packing;
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d normal = random_normal(seed, RandomPurpose::position_noise, replica, static_cast<std::uint64_t>(i));
        noisy.positions.col(i) = packing.cell.wrap(packing.positions.col(i) + noise.deviation.cwiseProduct(normal));
    }
    return noisy;
}

MeasureResult measure_noise_shifts(const Packing& packing, const MeasureResult& measured, const PositionNoise& noise,
                                   const std::map<std::string, double>& options, const std::vector<std::string>& only,
                                   std::uint64_t seed, const Progress& progress) {
    require(noise.replicas >= 2 && noise.replicas <= 1000,
            "the number of packings with noise is " + std::to_string(noise.replicas) + ", but must be 2 to 1000");
    std::map<std::string, std::vector<double>> values;
    for (Index replica = 0; replica < noise.replicas; ++replica) {
        progress.update("packings with noise", static_cast<double>(replica) / static_cast<double>(noise.replicas));
        const MeasureInput input(with_noise(packing, noise, seed, static_cast<std::uint64_t>(replica)), options, seed);
        const MeasureResult found = run_measures(input, only);
        for (const auto& [name, dataset] : scalars_of(found)) {
            values[name].push_back(value_of(*dataset));
        }
    }
    MeasureResult result;
    result.add_vector("noise/position", noise.deviation, "m", "standard deviation of the noise added to x, y, z");
    result.add_count("noise/replicas", noise.replicas, "packings with noise");
    std::vector<Shift> shifts;
    for (const auto& [name, dataset] : scalars_of(measured)) {
        const std::vector<double>& noisy = values[name];
        if (std::ssize(noisy) == noise.replicas && name != "mean_radius" && name != "contact_tolerance") {
            const Shift shift = shift_of(name, *dataset, noisy);
            result.add("noise/shift/" + name, shift.mean, shift.unit,
                       "change of " + name + " when noise is added to the positions");
            result.add("noise/shift_error/" + name, shift.error, shift.unit,
                       "standard error of the change over the packings with noise");
            shifts.push_back(shift);
        }
    }
    add_lines(shifts, result);
    return result;
}

}  // namespace coagula::characterize
