// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/structure_factor.hpp>

#include "geometry/reduced_diagram.hpp"
#include "pair_histogram.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <numbers>

namespace coagula::characterize {

namespace {

constexpr double pi = std::numbers::pi;

/// A wave vector as multiples of the three vectors of the reciprocal lattice.
using Multiples = Eigen::Array3i;

struct Shells {
    Eigen::Matrix3d reciprocal;                   ///< its columns: 2 pi over the lengths of a rectangular box
    std::vector<std::vector<Multiples>> vectors;  ///< of shell k: about (k + 1) mean spacings
    Eigen::Array3i most;                          ///< largest multiples
};

/// Calls `visit` with half of all multiples up to `most` along each axis: of q and -q one.
template <class Visit>
void for_half_of(const Multiples& most, const Visit& visit) {
    for (int x = 0; x <= most[0]; ++x) {
        for (int y = x == 0 ? 0 : -most[1]; y <= most[1]; ++y) {
            for (int z = x == 0 && y == 0 ? 1 : -most[2]; z <= most[2]; ++z) {
                visit(x, y, z);
            }
        }
    }
}

/// Leaves every so many, evenly.
void thin(std::vector<Multiples>& shell, Index limit) {
    const std::size_t all = shell.size();
    const std::size_t used = std::min(all, static_cast<std::size_t>(limit));
    for (std::size_t k = 0; k < used; ++k) {
        shell[k] = shell[(2 * k + 1) * all / (2 * used)];
    }
    shell.resize(used);
}

/// Half of all wave vectors (q and -q scatter alike) up to `largest`, thinned evenly to `limit` in a shell.
Shells collect_shells(const Cell& lattice, double largest, Index limit) {
    Shells shells;
    const Eigen::Array3d spacing = 2 * pi / lattice.edge_lengths().array();
    shells.reciprocal = spacing.matrix().asDiagonal();
    if (!lattice.is_rectangular()) {
        shells.reciprocal = 2 * pi * lattice.edges().inverse().transpose();
    }
    const double mean_spacing = std::cbrt(std::abs(shells.reciprocal.determinant()));
    const auto count = static_cast<std::size_t>(std::max(1.0, std::floor(largest / mean_spacing)));
    shells.vectors.resize(count);
    std::vector<Index> met(count, 0);
    shells.most = (largest / spacing).ceil().cast<int>();  // of a component along an edge
    for_half_of(shells.most, [&](int x, int y, int z) {
        const double length = (shells.reciprocal * Eigen::Vector3d(x, y, z)).norm();
        const double place = length / mean_spacing - 0.5;
        if (place >= 0 && place < static_cast<double>(count)) {
            const auto shell = static_cast<std::size_t>(place);
            const auto expected = 2 * pi * (place + 1) * (place + 1);
            const auto stride = std::max<Index>(1, static_cast<Index>(expected / (2 * static_cast<double>(limit))));
            if (met[shell]++ % stride == 0) {  // of millions in a shell, a few times as many as are used
                shells.vectors[shell].emplace_back(x, y, z);
            }
        }
    });
    for (auto& shell : shells.vectors) {
        thin(shell, limit);
    }
    std::erase_if(shells.vectors, [](const auto& shell) { return shell.empty(); });
    return shells;
}

/// Weights of the particles and the amplitude that the window itself scatters.
struct Taper {
    Eigen::VectorXd weights;
    double density = 0;  ///< 0 if periodic: the wave vectors of the box do not see the box
    double radius = 0;

    double own_amplitude(double q) const {
        if (density == 0) {
            return 0;
        }
        const double k = pi / radius;
        const auto half = [&](double p) { return std::abs(p) * radius < 1e-8 ? radius / 2 : std::sin(p * radius) / (2 * p); };
        return density * 4 * pi / q * (half(k - q) - half(k + q));
    }
};

Taper make_taper(const Packing& packing, const SampleWindow& window) {
    if (packing.cell.is_periodic()) {
        return {Eigen::VectorXd::Ones(packing.size()), 0, 0};
    }
    Taper taper{Eigen::VectorXd::Zero(packing.size()), window.density, window.ball_radius};
    for (Index i = 0; i < packing.size(); ++i) {
        const double r = packing.cell.minimum_image(packing.positions.col(i) - window.centre).norm();
        if (r < taper.radius) {
            taper.weights[i] = r > 0 ? std::sin(pi * r / taper.radius) / r : pi / taper.radius;
        }
    }
    return taper;
}

/// exp(i q_axis x) for multiples -most .. most of a batch of particles: real and imaginary parts, particles down, multiples across.
struct Phases {
    Eigen::ArrayXXd real, imaginary;

    void fill(const Eigen::ArrayXd& angle, int most) {
        real.resize(angle.size(), 2 * most + 1);
        imaginary.resize(angle.size(), 2 * most + 1);
        for (int multiple = 0; multiple <= most; ++multiple) {
            real.col(most + multiple) = (multiple * angle).cos();
            imaginary.col(most + multiple) = (multiple * angle).sin();
            real.col(most - multiple) = real.col(most + multiple);
            imaginary.col(most - multiple) = -imaginary.col(most + multiple);
        }
    }
};

/// sum_j w_j exp(i q x_j) of one batch for all vectors, added to the amplitudes.
void add_batch(const Packing& packing, const Taper& taper, const SampleWindow& window, const Shells& shells, Index begin,
               Index count, std::vector<std::complex<double>>& amplitudes) {
    Eigen::Matrix3Xd place = packing.positions.middleCols(begin, count).colwise() - window.centre;
    if (!packing.cell.is_periodic()) {
        for (auto separation : place.colwise()) {
            separation = packing.cell.minimum_image(separation);
        }
    }
    std::array<Phases, 3> phases;
    for (int axis = 0; axis < 3; ++axis) {
        phases[static_cast<std::size_t>(axis)].fill(place.transpose() * shells.reciprocal.col(axis), shells.most[axis]);
    }
    const Eigen::ArrayXd weights = taper.weights.segment(begin, count);
    Eigen::ArrayXd real(count), imaginary(count);
    Eigen::Array2i kept(-shells.most[0] - 1, 0);  // x and y of the product that real and imaginary hold
    std::size_t vector = 0;
    for (const auto& shell : shells.vectors) {
        for (const Multiples& multiples : shell) {
            if (kept[0] != multiples[0] || kept[1] != multiples[1]) {
                const auto xr = phases[0].real.col(shells.most[0] + multiples[0]);
                const auto xi = phases[0].imaginary.col(shells.most[0] + multiples[0]);
                const auto yr = phases[1].real.col(shells.most[1] + multiples[1]);
                const auto yi = phases[1].imaginary.col(shells.most[1] + multiples[1]);
                real = weights * (xr * yr - xi * yi);
                imaginary = weights * (xr * yi + xi * yr);
                kept = multiples.head<2>();
            }
            const auto zr = phases[2].real.col(shells.most[2] + multiples[2]);
            const auto zi = phases[2].imaginary.col(shells.most[2] + multiples[2]);
            amplitudes[vector++] += std::complex<double>((real * zr - imaginary * zi).sum(), (real * zi + imaginary * zr).sum());
        }
    }
}

std::vector<std::complex<double>> scatter(const Packing& packing, const Taper& taper, const SampleWindow& window,
                                          const Shells& shells) {
    constexpr Index batch = 256;  // its phases stay in the cache
    std::size_t vectors = 0;
    for (const auto& shell : shells.vectors) {
        vectors += shell.size();
    }
    const Index batches = (packing.size() + batch - 1) / batch;
    constexpr Index parts = 16;  // summed in order: the result does not depend on the number of threads
    std::vector<std::vector<std::complex<double>>> partial(parts, std::vector<std::complex<double>>(vectors));
#pragma omp parallel for schedule(dynamic)
    for (Index part = 0; part < parts; ++part) {
        for (Index k = batches * part / parts; k < batches * (part + 1) / parts; ++k) {
            const Index begin = k * batch;
            add_batch(packing, taper, window, shells, begin, std::min(batch, packing.size() - begin),
                      partial[static_cast<std::size_t>(part)]);
        }
    }
    std::vector<std::complex<double>> total(vectors);
    for (const auto& part : partial) {
        for (std::size_t k = 0; k < vectors; ++k) {
            total[k] += part[k];
        }
    }
    return total;
}

void add_direct(const Packing& packing, const SampleWindow& window, const Shells& shells, StructureFactor& result) {
    const Taper taper = make_taper(packing, window);
    const std::vector<std::complex<double>> amplitudes = scatter(packing, taper, window, shells);
    const double norm = taper.weights.squaredNorm();
    require(norm > 0, "the packing is too small for a structure factor: no particle lies deep enough in it");
    const auto count = static_cast<Index>(shells.vectors.size());
    result.wave_number.resize(count);
    result.direct.resize(count);
    result.direct_stderr.resize(count);
    result.vectors.resize(count);
    std::size_t vector = 0;
    for (Index k = 0; k < count; ++k) {
        const auto& shell = shells.vectors[static_cast<std::size_t>(k)];
        const auto n = static_cast<double>(shell.size());
        double wave_number = 0, sum = 0, squares = 0;
        for (const Multiples& multiples : shell) {
            const double q = (shells.reciprocal * multiples.cast<double>().matrix()).norm();
            const double intensity = std::norm(amplitudes[vector++] - taper.own_amplitude(q)) / norm;
            wave_number += q / n;
            sum += intensity;
            squares += intensity * intensity;
        }
        const double mean = sum / n;
        constexpr double few = 8;
        const double variance = n < few ? mean * mean : std::max(0.0, squares - n * mean * mean) / (n - 1);
        result.wave_number[k] = wave_number;
        result.direct[k] = mean;
        result.direct_stderr[k] = std::sqrt(variance / n);
        result.vectors[k] = static_cast<int>(shell.size());
    }
}

double sinc(double x) {
    return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x;
}

/// Excess of neighbours in fine shells, windowed and transformed.
void add_transformed(const Packing& packing, const SampleWindow& window, StructureFactor& result) {
    constexpr double width = 0.002;
    constexpr double most = 12;
    const double range = std::min(largest_pair_distance(packing, window), most);
    const Index shells = result.wave_number.size();
    result.transformed = result.transformed_error = Eigen::VectorXd::Constant(shells, unset);
    const auto bins = static_cast<Index>(range / width);
    if (bins < 2) {
        return;
    }
    const double reach = width * static_cast<double>(bins);
    const PairHistogram histogram = count_pairs(packing, window, reach, bins, PairDistance::by_mean_diameter);
    const Eigen::VectorXd excess =
        (histogram.pairs.rowwise().sum() - histogram.expected.rowwise().sum()).array() / histogram.centres.array().max(1.0);
    Eigen::VectorXd radius(bins), window_excess(bins), correction(bins);
    for (Index bin = 0; bin < bins; ++bin) {
        radius[bin] = width * (static_cast<double>(bin) + 0.5);
        const double x = pi * radius[bin] / reach;
        window_excess[bin] = 0.5 * (1 + std::cos(x)) * excess[bin];
        correction[bin] = x * x / 4 * window_excess[bin];
    }
    const auto transform = [&](const Eigen::VectorXd& of, double q) {
        double sum = 0;
        for (Index bin = 0; bin < bins; ++bin) {
            sum += of[bin] * sinc(q * radius[bin]);
        }
        return sum;
    };
#pragma omp parallel for schedule(static)
    for (Index k = 0; k < shells; ++k) {
        const double q = result.wave_number[k];
        // What the second factor of the window adds is the first term of the bias that the first factor alone would have.
        const double corrected = transform(correction, q);
        const double here = 1 + transform(window_excess, q) + corrected;
        // The squared window has the transform of a shell pi / (R mean(w^2)) wide; its modes are V q^2 / (4 pi^2) times that, q and
        // -q counted once.
        constexpr double mean_square_window = 0.5614;
        const double counting = here * here * 4 * pi * reach * mean_square_window / (window.volume * q * q);
        result.transformed[k] = here;
        result.transformed_error[k] = std::sqrt(corrected * corrected + counting);
    }
}

/// S = S(0) + b q^2 + c q^4 through the given number of shells; returns chi^2 per degree of freedom.
double fit_at_zero(Index shells, StructureFactor& result) {
    const Eigen::ArrayXd squares = result.wave_number.head(shells).array().square();
    const Eigen::VectorXd direct = result.direct.head(shells);
    Eigen::MatrixX3d powers(shells, 3);
    powers << Eigen::VectorXd::Ones(shells), squares.matrix(), squares.square().matrix();
    const double floor = 0.05 * direct.maxCoeff();
    Eigen::ArrayXd model = direct;
    Eigen::Vector3d coefficients;
    Eigen::Matrix3d normal;
    Eigen::VectorXd weight;
    for (int pass = 0; pass < 20; ++pass) {  // the standard deviation of an intensity is its mean
        weight = result.vectors.head(shells).cast<double>().array() / model.max(floor).square();
        normal = powers.transpose() * weight.asDiagonal() * powers;
        coefficients = normal.ldlt().solve(powers.transpose() * weight.cwiseProduct(direct));
        model = powers * coefficients;
    }
    result.at_zero = std::max(coefficients[0], 0.0);  // the parabola through scattered values may end below
    result.at_zero_stderr = std::sqrt(normal.inverse()(0, 0));
    return (weight.array() * (direct.array() - model).square()).sum() / std::max(1.0, static_cast<double>(shells) - 3);
}

/// The highest shells are left out while the parabola does not describe them.
void extrapolate(double range, StructureFactor& result) {
    constexpr double good = 1.5;  // of chi^2 per degree of freedom
    const double* const end =
        std::upper_bound(result.wave_number.data(), result.wave_number.data() + result.wave_number.size(), range);
    for (Index shells = end - result.wave_number.data(); shells >= 4; --shells) {
        const double misfit = fit_at_zero(shells, result);
        if (misfit <= good) {
            return;
        }
        result.at_zero_stderr *= std::sqrt(misfit);
    }
}

/// Half the range of the shells around the largest that differ from it by less than two standard errors; a shell at least. A shell
/// alone says nothing.
double peak_width(const StructureFactor& found, Index largest) {
    if (found.direct.size() < 2) {
        return unset;
    }
    const auto is_as_large = [&](Index shell) {
        return found.direct[largest] - found.direct[shell] <
               2 * std::hypot(found.direct_stderr[largest], found.direct_stderr[shell]);
    };
    Index first = largest;
    Index last = largest;
    while (first > 0 && is_as_large(first - 1)) {
        --first;
    }
    while (last + 1 < found.direct.size() && is_as_large(last + 1)) {
        ++last;
    }
    const double spacing = found.wave_number[1] - found.wave_number[0];
    return std::max(0.5 * (found.wave_number[last] - found.wave_number[first]), spacing / std::sqrt(12.0));
}

}  // namespace

StructureFactor measure_structure_factor(const Packing& packing, const StructureFactorOptions& options) {
    check(packing);
    require_positive(options.largest, "the largest wave number of the structure factor", "mean diameters^-1");
    require(options.vectors >= 1, "the structure factor needs at least one wave vector in a shell");
    const double diameter = 2 * mean_radius(packing);
    const Packing reduced = in_units_of(diameter, packing);
    const SampleWindow window = sample_window(reduced);
    const Cell lattice =
        packing.cell.is_periodic() ? reduced.cell : Cell::periodic(Eigen::Vector3d::Constant(2 * window.ball_radius));
    constexpr double most_terms = 2e8;
    const double shells = std::max(1.0, options.largest * std::cbrt(lattice.volume()) / (2 * pi));
    const auto affordable = static_cast<Index>(most_terms / (shells * static_cast<double>(packing.size())));
    const Index limit = std::clamp<Index>(affordable, std::min<Index>(10, options.vectors), options.vectors);
    StructureFactor result;
    add_direct(reduced, window, collect_shells(lattice, options.largest, limit), result);
    add_transformed(reduced, window, result);
    extrapolate(options.extrapolation_range, result);
    Index largest = 0;
    result.peak = result.direct.maxCoeff(&largest);
    result.wave_number /= diameter;
    result.peak_wave_number = result.wave_number[largest];
    result.peak_stderr = result.direct_stderr[largest];
    result.peak_wave_number_stderr = peak_width(result, largest);
    return result;
}

}  // namespace coagula::characterize
