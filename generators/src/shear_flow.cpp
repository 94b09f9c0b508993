// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/shear_flow.hpp>

#include <coagula/common/statistics.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::generators {

namespace {

constexpr std::size_t blocks_of_samples = 8;

struct Estimate {
    double mean = unset;
    double error = unset;
};

Estimate estimate(const std::vector<double>& blocks) {
    if (blocks.empty()) {
        return {};
    }
    const MeanWithError found =
        mean_and_standard_error(Eigen::VectorXd::Map(blocks.data(), static_cast<Eigen::Index>(blocks.size())));
    return {found.mean, found.standard_error};
}

/// Samples of the blocks, consecutive and as long as each other: `begin` is the first sample, `count` the number in a block.
std::vector<double> block_means(const std::vector<double>& values, std::size_t begin, std::size_t count) {
    std::vector<double> means;
    for (std::size_t first = begin; first + count <= values.size(); first += count) {
        double sum = 0;
        for (std::size_t k = first; k < first + count; ++k) {
            sum += values[k];
        }
        means.push_back(sum / static_cast<double>(count));
    }
    return means;
}

/// Moduli of one cycle by least squares: stress = mean + storage x strain + loss x rate of strain over 2 pi frequency, each
/// averaged over the interval before a sample as the stress is.
Eigen::Vector2d moduli(const ShearFlow& flow, const std::vector<double>& time, const std::vector<double>& stress, std::size_t begin,
                       std::size_t end) {
    const double angular = 2 * std::numbers::pi * flow.frequency;
    const auto rows = static_cast<Eigen::Index>(end - begin);
    Eigen::MatrixX3d basis(rows, 3);
    Eigen::VectorXd values(rows);
    for (std::size_t k = begin; k < end; ++k) {
        const double half = 0.5 * angular * (time[k] - time[k - 1]);
        const double middle = angular * time[k] - half;
        const double averaged = std::sin(half) / half * flow.amplitude;
        const auto row = static_cast<Eigen::Index>(k - begin);
        basis.row(row) << 1, averaged * std::sin(middle), averaged * std::cos(middle);
        values[row] = stress[k];
    }
    return basis.colPivHouseholderQr().solve(values).tail<2>();
}

/// The whole cycles of the second half of the run.
void fit_cycles(const ShearFlow& flow, const std::vector<double>& time, const StressSeries& stress, FlowResponse& response) {
    constexpr std::size_t fewest = 8;  // samples in a cycle
    const double period = 1 / flow.frequency;
    const auto cycles = static_cast<std::int64_t>(std::floor(time.back() / period + 1e-6));
    std::vector<double> storage;
    std::vector<double> loss;
    for (std::int64_t cycle = cycles / 2; cycle < cycles; ++cycle) {
        const auto within = [&](double at) { return at > (static_cast<double>(cycle) + 1e-6) * period; };
        const auto after = [&](double at) { return at > (static_cast<double>(cycle) + 1 + 1e-6) * period; };
        const auto begin = static_cast<std::size_t>(std::find_if(time.begin() + 1, time.end(), within) - time.begin());
        const auto end = static_cast<std::size_t>(std::find_if(time.begin() + 1, time.end(), after) - time.begin());
        if (end >= begin + fewest) {
            const Eigen::Vector2d found = moduli(flow, time, stress.shear_stress, begin, end);
            storage.push_back(found[0]);
            loss.push_back(found[1]);
        }
    }
    response.blocks = static_cast<Eigen::Index>(storage.size());
    response.storage_modulus = estimate(storage).mean;
    response.storage_modulus_error = estimate(storage).error;
    response.loss_modulus = estimate(loss).mean;
    response.loss_modulus_error = estimate(loss).error;
}

}  // namespace

double ShearFlow::strain(double time) const {
    if (oscillates()) {
        return amplitude * std::sin(2 * std::numbers::pi * frequency * time);
    }
    return given() ? rate * time : 0.0;
}

double ShearFlow::largest_rate() const {
    return oscillates() ? 2 * std::numbers::pi * frequency * amplitude : (given() ? std::abs(rate) : 0.0);
}

void check(const ShearFlow& flow) {
    require(std::isnan(flow.rate) || !flow.oscillates(), "a flow has a constant rate of strain or an amplitude, not both");
    require(flow.oscillates() == !std::isnan(flow.frequency), "an amplitude of strain and a frequency need each other");
    if (flow.oscillates()) {
        require_positive(flow.amplitude, "the amplitude of the strain");
        require_positive(flow.frequency, "the frequency", "Hz");
    }
    require(std::isnan(flow.rate) || std::isfinite(flow.rate), "the rate of strain must be a finite number");
}

FlowResponse flow_response(const ShearFlow& flow, const std::vector<double>& time, const StressSeries& stress) {
    FlowResponse response;
    if (flow.oscillates()) {
        fit_cycles(flow, time, stress, response);
        return response;
    }
    const std::size_t samples = stress.shear_stress.size();
    const std::size_t late = samples / 2;
    const std::size_t count = std::max<std::size_t>(1, late / blocks_of_samples);
    const std::size_t blocks = late / count;
    const std::size_t begin = samples - blocks * count;
    if (late == 0) {
        return response;
    }
    std::vector<double> difference;
    for (std::size_t k = 0; k < samples; ++k) {
        difference.push_back(stress.normal_stress_x[k] - stress.normal_stress_z[k]);
    }
    const Estimate shear = estimate(block_means(stress.shear_stress, begin, count));
    const Estimate normal = estimate(block_means(difference, begin, count));
    response.blocks = static_cast<Eigen::Index>(blocks);
    response.shear_stress = shear.mean;
    response.shear_stress_error = shear.error;
    response.first_normal_difference = normal.mean;
    response.first_normal_difference_error = normal.error;
    if (flow.rate != 0) {
        response.particle_viscosity = shear.mean / flow.rate;
        response.particle_viscosity_error = shear.error / std::abs(flow.rate);
    }
    return response;
}

}  // namespace coagula::generators
