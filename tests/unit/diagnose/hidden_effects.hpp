// SPDX-License-Identifier: GPL-3.0-or-later
// Structures, tables and noise for tests that hide an effect: what the diagnosis is given and what it is not.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/logarithmic_steps.hpp>
#include <coagula/common/random.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/generators/void_expansion.hpp>

#include "stored_simulations.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A periodic packing as numbers: edges, radii, centres.
inline std::vector<double> numbers_of(const Packing& packing) {
    const Eigen::Vector3d edges = packing.cell.lengths();
    std::vector<double> numbers{edges[0], edges[1], edges[2]};
    numbers.insert(numbers.end(), packing.radii.begin(), packing.radii.end());
    numbers.insert(numbers.end(), packing.positions.data(), packing.positions.data() + packing.positions.size());
    return numbers;
}

inline Packing packing_of(const std::vector<double>& numbers) {
    Packing packing;
    packing.cell = Cell::periodic({numbers[0], numbers[1], numbers[2]});
    const auto particles = static_cast<Index>((numbers.size() - 3) / 4);
    packing.radii = Eigen::Map<const Eigen::VectorXd>(numbers.data() + 3, particles);
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(numbers.data() + 3 + particles, 3, particles);
    return packing;
}

/// The structure of this kind and these parameters, made where no test of this build has made it before.
inline Packing stored_structure(const std::string& kind, std::initializer_list<double> parameters,
                                const std::function<Packing()>& make) {
    static StoredSimulations structures("structures");
    std::string key = kind;
    for (const double parameter : parameters) {
        key += ' ' + to_text(parameter);
    }
    return packing_of(structures.result(key, [&] { return numbers_of(make()); }));
}

inline Packing made_structure(Index particles, std::uint64_t seed, double target_coordination, double volume_fraction) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 2;
    options.volume_fraction = volume_fraction;
    options.radii = Eigen::VectorXd::Constant(particles, 0.25e-6);
    options.seed = seed;
    if (std::isfinite(target_coordination)) {
        options.target_coordination = target_coordination;
    }
    return generators::expand_voids(options).packing;
}

/// By void expansion, with half as many voids as particles.
inline Packing structure(Index particles, std::uint64_t seed, double target_coordination = unset, double volume_fraction = 0.4) {
    return stored_structure("void expansion",
                            {static_cast<double>(particles), static_cast<double>(seed), target_coordination, volume_fraction},
                            [&] { return made_structure(particles, seed, target_coordination, volume_fraction); });
}

/// Two structures that the diagnosis knows, and what it has simulated of them.
inline Simulator& simulator() {
    static StoredSimulations stored("two_structures");
    static Simulator made({structure(200, 1), structure(200, 2)}, {"first", "second"}, stored.results());
    return made;
}

inline double drawn_normal(std::uint64_t seed, std::uint64_t number, std::uint64_t step = 3) {
    const auto u = random_uniform(seed, RandomPurpose::test, step, number);
    return std::sqrt(-2 * std::log(1 - u[0])) * std::cos(2 * std::numbers::pi * u[1]);
}

/// Columns of moduli with a relative error of |G*|.
inline void add_moduli(Measurement& table, const std::vector<std::complex<double>>& moduli, double error, std::uint64_t seed,
                       bool with_loss = true) {
    Column storage{"storage_modulus", "Pa", {}};
    Column loss{"loss_modulus", "Pa", {}};
    for (std::size_t k = 0; k < moduli.size(); ++k) {
        const double deviation = error * std::abs(moduli[k]);
        storage.values.push_back(moduli[k].real() + deviation * drawn_normal(seed, 2 * k));
        loss.values.push_back(moduli[k].imag() + deviation * drawn_normal(seed, 2 * k + 1));
        storage.standard_errors.push_back(deviation);
        loss.standard_errors.push_back(deviation);
    }
    table.columns.push_back(storage);
    if (with_loss) {
        table.columns.push_back(loss);
    }
}

/// Centres as a microscope finds them: errors, some particles missed, no periodic box.
inline Measurement seen_by_microscope(const Packing& hidden, double sigma_plane, double sigma_axis, double missed,
                                      std::uint64_t seed) {
    Measurement table{.kind = MeasurementKind::coordinates,
                      .label = "hidden",
                      .sample = "sample",
                      .columns = {{"x", "m", {}}, {"y", "m", {}}, {"z", "m", {}}},
                      .left_out = {}};
    for (Index particle = 0; particle < hidden.size(); ++particle) {
        const auto number = 4 * static_cast<std::uint64_t>(particle);
        if (random_uniform(seed, RandomPurpose::test, 4, number)[0] < missed) {
            continue;
        }
        for (Index axis = 0; axis < 3; ++axis) {
            const double error =
                (axis < 2 ? sigma_plane : sigma_axis) * drawn_normal(seed, number + static_cast<std::uint64_t>(axis));
            table.columns[static_cast<std::size_t>(axis)].values.push_back(hidden.positions(axis, particle) + error);
        }
    }
    return table;
}

/// Images of the same particles as one table.
inline Measurement repeated(const std::vector<Measurement>& images) {
    Measurement all = images.front();
    Column frame{"frame", "1", {}};
    for (Column& column : all.columns) {
        column.values.clear();
    }
    for (std::size_t image = 0; image < images.size(); ++image) {
        for (std::size_t axis = 0; axis < all.columns.size(); ++axis) {
            const std::vector<double>& values = images[image].columns[axis].values;
            all.columns[axis].values.insert(all.columns[axis].values.end(), values.begin(), values.end());
        }
        frame.values.resize(all.rows(), static_cast<double>(image));
    }
    all.columns.push_back(frame);
    return all;
}

/// Standard deviations [m] and shares of particles that are missed and of centres that are none.
inline Settings image_errors(double plane, double axis, double missed, double wrong) {
    Settings settings;
    settings.localisation_plane = plane;
    settings.localisation_axis = axis;
    settings.missed_share = missed;
    settings.false_share = wrong;
    return settings;
}

/// Adds centres where no particle is, none nearer than half a diameter to another, until they are this share of all.
inline void add_false_centres(Measurement& table, double share, double diameter, std::uint64_t seed) {
    const std::size_t particles = table.rows();
    const auto centre = [&](std::size_t row) {
        return Eigen::Vector3d(table.columns[0].values[row], table.columns[1].values[row], table.columns[2].values[row]);
    };
    Eigen::Array3d high = centre(0);
    for (std::size_t row = 0; row < particles; ++row) {
        high = high.max(centre(row).array());
    }
    const auto wanted = static_cast<std::size_t>(std::lround(share / (1 - share) * static_cast<double>(particles)));
    for (std::uint64_t number = 0; table.rows() < particles + wanted; ++number) {
        const auto u = random_uniform(seed, RandomPurpose::test, 5, number);
        const Eigen::Vector3d place = (high * Eigen::Array3d(u[0], u[1], u[2])).matrix();
        bool taken = false;
        for (std::size_t row = 0; row < table.rows() && !taken; ++row) {
            taken = (centre(row) - place).norm() < 0.5 * diameter;
        }
        for (std::size_t axis = 0; axis < 3 && !taken; ++axis) {
            table.columns[axis].values.push_back(place[static_cast<Index>(axis)]);
        }
    }
}

/// By the structures of simulator().
inline Diagnosis diagnosis_with(int bootstrap, const Experiment& experiment) {
    DiagnosisOptions options;
    options.bootstrap = bootstrap;
    return diagnose(experiment, simulator(), options);
}

}  // namespace coagula::diagnose
