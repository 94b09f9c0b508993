// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth_material.hpp"

#include "data/median.hpp"
#include "observables/coordinate.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double degrees_of_material = 4;  ///< of freedom of the size of the coefficients
using Complex = std::complex<double>;
using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr double elements_per_decade = 3;
constexpr int fewest_bumps = 4;    ///< along strain, age or shear rate
constexpr double wide = 3;         ///< of a coefficient over what the data have there
constexpr double smallest = 1e-6;  ///< |G*| over the largest, from which on down all errors are the same
constexpr double relative = 0.01;  ///< error of the data for the first estimate

/// A coordinate at every observation; where it is not known, its smallest value.
struct Places {
    Eigen::ArrayXd at;
    bool vary = false;
};

Places places_of(const std::vector<Observation>& observations, Coordinate coordinate) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const Observation& one : observations) {
        const double value = coordinate_of(one, coordinate);
        low = value > 0 ? std::min(low, value) : low;
        high = value > 0 ? std::max(high, value) : high;
    }
    Places places{Eigen::ArrayXd::Constant(static_cast<Index>(observations.size()), low), high > 1.05 * low};
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double value = coordinate_of(observations[k], coordinate);
        places.at[static_cast<Index>(k)] = value > 0 ? value : low;
    }
    return places;
}

/// Columns of functions of unit coefficients.
class Functions {
public:
    explicit Functions(const std::vector<Observation>& observations) {
        Eigen::VectorXd values(static_cast<Index>(observations.size()));
        for (Index k = 0; k < values.size(); ++k) {
            // No material stores or loses less than nothing: what is below zero is the tool's, whose size is not the material's.
            values[k] = std::max(0.0, observations[static_cast<std::size_t>(k)].value);
        }
        sizes_ = complex_moduli(observations, values);
        middle_ = median({sizes_.begin(), sizes_.end()});
    }

    /// Elements that relax slower than the lowest frequency and faster than the highest show there, too.
    /// @param frequencies angular ones.
    void add_relaxation(const Eigen::ArrayXd& frequencies) {
        constexpr int beyond = 4;                // elements at either end
        constexpr double beyond_per_decade = 6;  // the closer, because they do not take off from each other
        const double low = frequencies.minCoeff();
        const double high = frequencies.maxCoeff();
        const int elements = 1 + static_cast<int>(std::lround(elements_per_decade * std::log10(high / low)));
        double size = size_at(frequencies, low);  // does not fall with the frequency, whatever an instrument shows
        add(Eigen::ArrayXcd::Constant(frequencies.size(), size));
        const auto add_element = [&](double place, bool not_negative) {
            const Eigen::ArrayXcd product = Complex(0, 1) * frequencies / place;
            size = std::max(size, size_at(frequencies, place));
            add(size * product / (1 + product), not_negative);
        };
        for (int k = beyond; k > 0; --k) {
            add_element(low * std::pow(10, -k / beyond_per_decade), true);
        }
        for (int k = 0; k < elements; ++k) {
            add_element(low * std::pow(high / low, static_cast<double>(k) / std::max(1, elements - 1)), false);
        }
        for (int k = 1; k <= beyond; ++k) {
            add_element(high * std::pow(10, k / beyond_per_decade), true);
        }
        add(Complex(0, size / high) * frequencies);
    }

    /// The viscosity along the shear rate, as large as it is there.
    void add_flow(const Eigen::ArrayXd& rates) {
        for (const auto& [place, bump] : bumps_along(rates)) {
            add(Complex(0, size_at(rates, place)) * bump);
        }
    }

    /// Two moduli that depend on nothing.
    void add_constants() {
        add(Eigen::ArrayXcd::Constant(sizes_.size(), middle_));
        add(Eigen::ArrayXcd::Constant(sizes_.size(), Complex(0, middle_)));
    }

    void add_bumps(const Eigen::ArrayXd& places) {
        for (const auto& [place, bump] : bumps_along(places)) {
            add(middle_ * bump.cast<Complex>());
            add(Complex(0, middle_) * bump);
        }
    }

    const Eigen::MatrixXcd& columns() const { return columns_; }
    const Flags& not_negative() const { return not_negative_; }

private:
    /// Where they are, and what they are at every observation: as wide as they are apart.
    static std::vector<std::pair<double, Eigen::ArrayXd>> bumps_along(const Eigen::ArrayXd& at) {
        const double low = at.minCoeff();
        const double range = std::log(at.maxCoeff() / low);
        const int count =
            std::max(fewest_bumps, 1 + static_cast<int>(std::lround(elements_per_decade * range / std::numbers::ln10)));
        const double apart = range / (count - 1);
        std::vector<std::pair<double, Eigen::ArrayXd>> bumps;
        bumps.reserve(static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k) {
            bumps.emplace_back(low * std::exp(k * apart), (-0.5 * ((at / low).log() / apart - k).square()).exp());
        }
        return bumps;
    }

    void add(const Eigen::ArrayXcd& column, bool not_negative = false) {
        columns_.conservativeResize(sizes_.size(), columns_.cols() + 1);
        columns_.rightCols(1) = wide * column.matrix();
        not_negative_.conservativeResize(columns_.cols());
        not_negative_.tail(1) = not_negative;
    }

    /// Middle |G*| of the nearest tenth of the data.
    double size_at(const Eigen::ArrayXd& frequencies, double place) const {
        std::vector<std::pair<double, double>> near;
        for (Index k = 0; k < frequencies.size(); ++k) {
            near.emplace_back(std::abs(std::log(frequencies[k] / place)), sizes_[k]);
        }
        std::sort(near.begin(), near.end());
        std::vector<double> some;
        for (std::size_t k = 0; k < std::max<std::size_t>(2, near.size() / 10); ++k) {
            some.push_back(near[std::min(k, near.size() - 1)].second);
        }
        return median(std::move(some));
    }

    Eigen::ArrayXd sizes_;
    double middle_ = 1;
    Eigen::MatrixXcd columns_;
    Flags not_negative_;
};

/// Functions that describe observations of oscillations, or of steady flow.
Functions functions_of(const std::vector<Observation>& observations, bool ages) {
    Functions functions(observations);
    const Places frequency = places_of(observations, Coordinate::angular_frequency);
    const Places rate = places_of(observations, Coordinate::shear_rate);
    if (is<Viscosity>(observations.front()) && rate.vary) {
        functions.add_flow(rate.at);
    } else if (!is<Viscosity>(observations.front()) && frequency.vary) {
        functions.add_relaxation(frequency.at);
    } else {
        functions.add_constants();
    }
    if (const Places strain = places_of(observations, Coordinate::strain); strain.vary) {
        functions.add_bumps(strain.at);
    }
    if (const Places age = places_of(observations, Coordinate::time); ages && age.vary) {
        functions.add_bumps(age.at);
    }
    return functions;
}

/// The x that minimises x^T normal x / 2 - right^T x, of which some are not negative (Lawson and Hanson, Solving Least Squares
/// Problems (1974), ch. 23). @param x where to start: what is zero there may stay so.
Eigen::VectorXd minimum(const Eigen::MatrixXd& normal, const Eigen::VectorXd& right, const Flags& not_negative, Eigen::VectorXd x) {
    const double noticeable = 1e-10 * right.cwiseAbs().maxCoeff();
    Flags free = !not_negative || x.array() > 0;
    for (Index round = 0; round < 5 * x.size(); ++round) {
        // The coefficients that are not free stay at zero.
        const Eigen::VectorXd chosen = free.cast<double>();
        Eigen::MatrixXd of_free = chosen.asDiagonal() * normal * chosen.asDiagonal();
        of_free.diagonal() += Eigen::VectorXd::Ones(x.size()) - chosen;
        const Eigen::VectorXd next = of_free.llt().solve(chosen.cwiseProduct(right));
        const Flags leaves = free && not_negative && next.array() <= 0;
        if (leaves.any()) {
            const Eigen::ArrayXd ways = leaves.select(x.array() / (x - next).array(), 1.0);
            Index first = 0;
            const double way = ways.minCoeff(&first);
            x += way * (next - x);
            x[first] = 0;
            free[first] = false;
            continue;
        }
        x = next;
        const Eigen::ArrayXd slope = free.select(0.0, (right - normal * x).array());
        Index steepest = 0;
        if (!(slope.maxCoeff(&steepest) > noticeable)) {
            break;
        }
        free[steepest] = true;
    }
    return x;
}

}  // namespace

SmoothMaterial::SmoothMaterial(const std::vector<Observation>& observations, bool ages) {
    const auto size = static_cast<Index>(observations.size());
    values_.resize(size);
    Eigen::ArrayXd stated(size);
    std::array<std::vector<Index>, 2> rows;  // of oscillations and of steady flow
    std::array<std::vector<Observation>, 2> parts;
    for (Index k = 0; k < size; ++k) {
        const Observation& one = observations[static_cast<std::size_t>(k)];
        values_[k] = one.value;
        stated[k] = std::isfinite(one.standard_error) ? one.standard_error : 0;
        rows.at(is<Viscosity>(one) ? 1 : 0).push_back(k);
        parts.at(is<Viscosity>(one) ? 1 : 0).push_back(one);
    }
    const Eigen::ArrayXd sizes = complex_moduli(observations, values_);
    weights_ = (relative * sizes.max(smallest * sizes.maxCoeff())).max(stated).inverse();
    functions_ = Eigen::MatrixXcd::Zero(size, 0);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        if (!parts.at(part).empty()) {
            const Functions functions = functions_of(parts.at(part), ages);
            const Eigen::MatrixXcd& columns = functions.columns();
            not_negative_.conservativeResize(functions_.cols() + columns.cols());
            not_negative_.tail(columns.cols()) = functions.not_negative();
            functions_.conservativeResize(Eigen::NoChange, functions_.cols() + columns.cols());
            functions_.rightCols(columns.cols()).setZero();
            functions_(rows.at(part), Eigen::lastN(columns.cols())) = columns;
        }
    }
    Eigen::MatrixXd seen(size, functions_.cols());
    for (Index row = 0; row < size; ++row) {
        const bool loss = is_loss(observations[static_cast<std::size_t>(row)]);
        seen.row(row) = ((loss ? Complex(0, -1) : Complex(1)) * functions_.row(row)).real();
    }
    start_ = best(Eigen::VectorXd::Zero(seen.cols()), Eigen::VectorXd::Zero(size), seen);
}

Eigen::VectorXd SmoothMaterial::best(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& seen,
                                     const Eigen::MatrixXd& changes) const {
    const Eigen::MatrixXd white = weights_.asDiagonal() * changes;
    const Eigen::VectorXd rest = weights_.cwiseProduct(values_ - seen + changes * coefficients);
    const Eigen::MatrixXd normal = white.transpose() * white + Eigen::MatrixXd::Identity(white.cols(), white.cols());
    return minimum(normal, white.transpose() * rest, not_negative_, coefficients);
}

std::vector<Index> SmoothMaterial::at_end(const Eigen::VectorXd& coefficients) const {
    std::vector<Index> all;
    for (Index k = 0; k < coefficients.size(); ++k) {
        if (not_negative_[k] && coefficients[k] <= 0) {
            all.push_back(k);
        }
    }
    return all;
}

UncertainModuli SmoothMaterial::moduli() const {
    UncertainModuli moduli(Eigen::VectorXcd::Zero(functions_.rows()), functions_);
    moduli.degrees = degrees_of_material;
    return moduli;
}

}  // namespace coagula::diagnose
