#include "smooth_material.hpp"

#include "data/median.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

constexpr double elements_per_decade = 3;
constexpr int bumps = 7;            ///< along strain, or age
constexpr double wide = 3;           ///< of a coefficient over what the data have there
constexpr double relative = 0.01;  ///< error of the data for the first estimate

/// A coordinate at every observation; where it is not known, its smallest value.
struct Places {
    Eigen::ArrayXd at;
    bool vary = false;
};

Places places_of(const std::vector<Observation>& observations, double Observation::*coordinate) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const Observation& one : observations) {
        const double value = one.*coordinate;
        low = value > 0 ? std::min(low, value) : low;
        high = value > 0 ? std::max(high, value) : high;
    }
    Places places{Eigen::ArrayXd::Constant(static_cast<Index>(observations.size()), low), high > 1.05 * low};
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double value = observations[k].*coordinate;
        places.at[static_cast<Index>(k)] = value > 0 ? value : low;
    }
    return places;
}

/// Columns of functions of unit coefficients.
class Functions {
public:
    explicit Functions(const std::vector<Observation>& observations) {
        values_.resize(static_cast<Index>(observations.size()));
        for (Index k = 0; k < values_.size(); ++k) {
            values_[k] = observations[static_cast<std::size_t>(k)].value;
        }
        sizes_ = complex_moduli(observations, values_);
        middle_ = median({sizes_.begin(), sizes_.end()});
    }

    /// @param frequencies angular ones.
    void add_relaxation(const Eigen::ArrayXd& frequencies) {
        const double low = frequencies.minCoeff();
        const double high = frequencies.maxCoeff();
        const int elements = 1 + static_cast<int>(std::lround(elements_per_decade * std::log10(high / low)));
        double size = size_at(frequencies, low);  // does not fall with the frequency, whatever an instrument shows
        add(Eigen::ArrayXcd::Constant(frequencies.size(), size));
        for (int k = 0; k < elements; ++k) {
            const double place = low * std::pow(high / low, static_cast<double>(k) / std::max(1, elements - 1));
            const Eigen::ArrayXcd product = Complex(0, 1) * frequencies / place;
            size = std::max(size, size_at(frequencies, place));
            add(size * product / (1 + product));
        }
        add(Complex(0, size / high) * frequencies);
    }

    /// Two moduli that depend on nothing.
    void add_constants() {
        add(Eigen::ArrayXcd::Constant(sizes_.size(), middle_));
        add(Eigen::ArrayXcd::Constant(sizes_.size(), Complex(0, middle_)));
    }

    void add_bumps(const Eigen::ArrayXd& places) {
        const Eigen::ArrayXd along = (places / places.minCoeff()).log() / std::log(places.maxCoeff() / places.minCoeff()) * (bumps - 1);
        for (int k = 0; k < bumps; ++k) {
            const Eigen::ArrayXd bump = middle_ * (-0.5 * (along - k).square()).exp();
            add(bump.cast<Complex>());
            add(Complex(0, 1) * bump);
        }
    }

    const Eigen::MatrixXcd& columns() const { return columns_; }
    const Eigen::VectorXd& values() const { return values_; }
    /// |G*| at each.
    const Eigen::ArrayXd& sizes() const { return sizes_; }

private:
    void add(const Eigen::ArrayXcd& column) {
        columns_.conservativeResize(sizes_.size(), columns_.cols() + 1);
        columns_.rightCols(1) = wide * column.matrix();
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

    Eigen::VectorXd values_;
    Eigen::ArrayXd sizes_;
    double middle_ = 1;
    Eigen::MatrixXcd columns_;
};

}  // namespace

SmoothMaterial::SmoothMaterial(const std::vector<Observation>& observations, bool ages) {
    Functions functions(observations);
    if (const Places frequency = places_of(observations, &Observation::angular_frequency); frequency.vary) {
        functions.add_relaxation(frequency.at);
    } else {
        functions.add_constants();
    }
    if (const Places strain = places_of(observations, &Observation::strain); strain.vary) {
        functions.add_bumps(strain.at);
    }
    if (const Places age = places_of(observations, &Observation::time); ages && age.vary) {
        functions.add_bumps(age.at);
    }
    functions_ = functions.columns();
    values_ = functions.values();
    weights_ = (relative * functions.sizes()).inverse();
    Eigen::MatrixXd seen(functions_.rows(), functions_.cols());
    for (Index row = 0; row < seen.rows(); ++row) {
        const bool loss = observations[static_cast<std::size_t>(row)].loss;
        seen.row(row) = ((loss ? Complex(0, -1) : Complex(1)) * functions_.row(row)).real();
    }
    start_ = best(Eigen::VectorXd::Zero(seen.cols()), Eigen::VectorXd::Zero(seen.rows()), seen);
}

Eigen::MatrixXcd SmoothMaterial::moduli(const Eigen::VectorXd& coefficients) const {
    Eigen::MatrixXcd all(functions_.rows(), functions_.cols() + 1);
    all.col(0) = functions_ * coefficients;
    all.rightCols(functions_.cols()) = functions_.colwise() + all.col(0);
    return all;
}

Eigen::VectorXd SmoothMaterial::best(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& seen,
                                     const Eigen::MatrixXd& changes) const {
    const Eigen::MatrixXd white = weights_.asDiagonal() * changes;
    const Eigen::VectorXd rest = weights_.cwiseProduct(values_ - seen + changes * coefficients);
    const Eigen::MatrixXd normal = white.transpose() * white + Eigen::MatrixXd::Identity(white.cols(), white.cols());
    return normal.llt().solve(white.transpose() * rest);
}

}  // namespace coagula::diagnose
