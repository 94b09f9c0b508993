// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_forms.hpp"

#include "discrepancy.hpp"
#include "smooth.hpp"

#include <coagula/common/log_probability.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace coagula::diagnose {

namespace {

using Directions = std::vector<Eigen::MatrixXd>;  ///< of unit amplitude [unit of the numbers], equally probable

constexpr std::array<std::pair<Coordinate, Kind>, 11> factors_on_modulus{
    {{Coordinate::strain, {Link::material, Axis::strain}},
     {Coordinate::angular_frequency, {Link::material, Axis::frequency}},
     {Coordinate::shear_rate, {Link::material, Axis::shear_rate}},
     {Coordinate::time, {Link::history, Axis::time}},
     {Coordinate::gap, {Link::geometry, Axis::gap}},
     {Coordinate::plate_radius, {Link::geometry, Axis::radius}},
     {Coordinate::heterogeneity, {Link::structure, Axis::heterogeneity}},
     {Coordinate::coordination, {Link::structure, Axis::coordination}},
     {Coordinate::volume_fraction, {Link::structure, Axis::volume_fraction}},
     {Coordinate::distance, {Link::structure, Axis::distance}},
     {Coordinate::pore_radius, {Link::structure, Axis::pore_radius}}}};

void append(Directions more, Directions& all) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
}

bool is_known(double value) {
    return value > 0 && std::isfinite(value);
}

double geometric_mean(const Eigen::VectorXd& values) {
    double sum = 0;
    double count = 0;
    for (const double value : values) {
        sum += is_known(value) ? std::log(value) : 0;
        count += is_known(value) ? 1 : 0;
    }
    return count > 0 ? std::exp(sum / count) : 1;
}

/// The angle of the tool between plates or under a cone [rad]; another tool gives what is in proportion to it.
double angle_of(const Observation& one) {
    if (is_known(one.cone_angle)) {
        return one.strain * one.cone_angle;
    }
    return is_known(one.gap) && is_known(one.plate_radius) ? one.strain * one.gap / one.plate_radius : one.strain;
}

bool varies(const Eigen::VectorXd& scale) {
    return scale.maxCoeff() > 1.05 * scale.minCoeff();
}

/// G' loses what G'' gains when the phase grows; each other number stays.
Eigen::VectorXd turned(const DataSet& data, const Eigen::VectorXd& prediction) {
    const Eigen::ArrayXd level = complex_moduli(data.observations, prediction);
    Eigen::VectorXd change = (level.square() - prediction.array().square()).max(0).sqrt().matrix();
    for (Index row = 0; row < change.size(); ++row) {
        const Observation& one = data.observations[static_cast<std::size_t>(row)];
        change[row] *= !is<Modulus>(one) ? 0.0 : is_loss(one) ? 1.0 : -1.0;
    }
    return change;
}

/// Finds the directions of every kind.
class AllDirections {
public:
    /// @param prediction of the base model.
    AllDirections(const DataSet& data, const Eigen::VectorXd& prediction)
        : data_(data),
          prediction_(prediction),
          level_(complex_moduli(data.observations, prediction)),
          turned_(turned(data, prediction)) {}

    std::map<Kind, Directions> find() && {
        for (const auto& [coordinate, kind] : factors_on_modulus) {
            add_smooth(kind, level_, coordinate);
        }
        add_plates();
        add_fillings();
        add_tool();
        for (Index sample = 0; data_.samples() > 1 && sample < data_.samples(); ++sample) {
            add_sample(sample);
        }
        return std::move(found_);
    }

    Directions readings() const {
        Directions all = along_reading(rank_of_angle());
        append(along_reading(rank_of_torque()), all);
        return all;
    }

private:
    /// A quantity of each number over its geometric mean; 0 where it is not known.
    template <class Quantity>
    Eigen::VectorXd relative(const Quantity& quantity) const {
        Eigen::VectorXd values(level_.size());
        std::transform(data_.observations.begin(), data_.observations.end(), values.begin(), quantity);
        const double mean = geometric_mean(values);
        return values.unaryExpr([mean](double value) { return is_known(value) ? value / mean : 0.0; });
    }

    bool goes_along(Coordinate coordinate) const { return rank_along(data_.observations, coordinate).maxCoeff() > 0; }

    /// A departure of G', of G'' or of both apart. @param since_first from nothing in the earliest row on.
    Directions along(const Eigen::VectorXd& scale, const std::vector<Eigen::VectorXd>& ranks, double length,
                     bool since_first = false) const {
        Directions all;
        for (const Departing departing : {Departing::storage, Departing::loss, Departing::both}) {
            Eigen::MatrixXd factor = smooth_factor(data_.observations, departing, ranks, false, length);
            if (since_first) {
                subtract_earliest(ranks.front(), factor);
            }
            if (!factor.isZero(1e-6) && !scale.isZero(0)) {
                all.emplace_back(scale.asDiagonal() * factor);
            }
        }
        return all;
    }

    /// Takes off what each observable has in its earliest row.
    void subtract_earliest(const Eigen::VectorXd& rank, Eigen::MatrixXd& factor) const {
        std::map<const Observable*, std::vector<Index>> rows;
        for (Index row = 0; row < factor.rows(); ++row) {
            if (!factor.row(row).isZero(0)) {
                rows[&observable_of(data_.observations[static_cast<std::size_t>(row)])].push_back(row);
            }
        }
        for (const auto& [observable, own] : rows) {
            const Index earliest = *std::min_element(own.begin(), own.end(), [&](Index a, Index b) { return rank[a] < rank[b]; });
            const Eigen::RowVectorXd first = factor.row(earliest);
            factor(own, Eigen::all).rowwise() -= first;
        }
    }

    void add(Kind kind, Directions more) {
        if (!more.empty()) {
            append(std::move(more), found_[kind]);
        }
    }

    void add_smooth(Kind kind, const Eigen::VectorXd& scale, Coordinate coordinate, bool since_first = false) {
        const Eigen::VectorXd rank = rank_along(data_.observations, coordinate);
        for (const double length : smooth_lengths) {
            if (rank.maxCoeff() > 0) {
                add(kind, along(scale, {rank}, length, since_first));
            }
        }
    }

    /// A departure that is there from the beginning is no course in time.
    void add_course(Kind kind, const Eigen::VectorXd& scale) { add_smooth(kind, scale, Coordinate::time, true); }

    void add_constant(Kind kind, const Eigen::VectorXd& scale) { add(kind, along(scale, {}, 1)); }

    /// Plates that take a part of the strain, move, or let the rim dry: the more, the smaller they are or the closer.
    void add_plates() {
        for (const Eigen::VectorXd& part : {relative([](const Observation& one) { return 1 / one.gap; }),
                                            relative([](const Observation& one) { return 1 / one.plate_radius; })}) {
            if (varies(part)) {
                const Eigen::VectorXd scale = level_.cwiseProduct(part);
                add_smooth({Link::geometry, Axis::strain}, scale, Coordinate::strain);
                add_course({Link::geometry, Axis::time}, scale);
            }
        }
    }

    /// Samples that differ, or were filled otherwise, differ between plates where an oil does not.
    void add_fillings() {
        Eigen::VectorXd scale = level_;
        for (Index row = 0; row < scale.size(); ++row) {
            scale[row] *= is_fluid(data_.observations[static_cast<std::size_t>(row)]) ? 0.0 : 1.0;
        }
        if (scale != level_) {
            add_smooth({Link::history, Axis::gap}, scale, Coordinate::gap);
            add_smooth({Link::history, Axis::radius}, scale, Coordinate::plate_radius);
        }
    }

    /// A torque beside that of the sample, also one that does not grow with the angle; a tool that gives way; a torque or an angle
    /// that is not read in proportion; a phase that is off.
    void add_tool() {
        const double mean_level = geometric_mean(level_);
        const auto per_torque = [](const Observation& one) { return 1 / one.torque_per_modulus; };
        const Eigen::VectorXd torque = mean_level * relative(per_torque);
        const Eigen::VectorXd offset =
            mean_level * relative([&](const Observation& one) { return per_torque(one) / angle_of(one); });
        add_readings();
        add_smooth({Link::tool, Axis::frequency}, torque, Coordinate::angular_frequency);
        if (goes_along(Coordinate::strain)) {
            add_constant({Link::tool, Axis::strain}, offset);
            add_smooth({Link::tool, Axis::strain}, torque, Coordinate::strain);
            add_course({Link::tool, Axis::time}, offset);
        }
        if (varies(torque)) {
            const Kind still{Link::tool, goes_along(Coordinate::plate_radius) ? Axis::radius : Axis::gap};
            const Eigen::VectorXd given_way = relative([](const Observation& one) { return one.torque_per_modulus; });
            add_constant(still, torque);
            add_constant(still, level_.cwiseAbs2().cwiseProduct(given_way) / mean_level);
        }
        if (!turned_.isZero(0)) {
            found_[{Link::tool, Axis::level}].emplace_back(turned_);
            add_smooth({Link::tool, Axis::frequency}, turned_, Coordinate::angular_frequency);
        }
    }

    /// Tables of one strain each differ in more than their torque.
    bool strain_is_swept() const {
        std::map<std::size_t, double> first;
        return std::any_of(data_.observations.begin(), data_.observations.end(), [&](const Observation& one) {
            const double before = first.try_emplace(one.measurement, one.set_strain).first->second;
            return std::abs(one.set_strain / before - 1) > 0.05;
        });
    }

    void add_readings() {
        const Eigen::VectorXd strain = rank_along(data_.observations, Coordinate::strain);
        for (const Eigen::VectorXd& rank : {rank_of_angle(), rank_of_torque()}) {
            if (strain_is_swept() && !run_together(rank, strain)) {
                add({Link::tool, Axis::strain}, along_reading(rank));
            }
        }
    }

    Eigen::VectorXd rank_of_angle() const {
        return ranks_of_rows([](const Observation& one, double /*level*/) { return angle_of(one); });
    }
    Eigen::VectorXd rank_of_torque() const {
        return ranks_of_rows([](const Observation& one, double level) { return angle_of(one) * one.torque_per_modulus * level; });
    }

    template <class Quantity>
    Eigen::VectorXd ranks_of_rows(const Quantity& quantity) const {
        std::vector<double> values;
        for (Index row = 0; row < level_.size(); ++row) {
            const Observation& one = data_.observations[static_cast<std::size_t>(row)];
            values.push_back(is<Modulus>(one) ? quantity(one, level_[row]) : unset);
        }
        return ranks_of(values);
    }

    /// A reading that is not in proportion is so by a few hundredths, gently, and leaves the phase as it is.
    Directions along_reading(const Eigen::VectorXd& rank) const {
        constexpr double size_of_readings = 0.2;
        if (rank.maxCoeff() <= 0) {
            return {};
        }
        const Eigen::MatrixXd storage = smooth_factor(data_.observations, Departing::storage, {rank}, false, smooth_lengths.back());
        std::map<std::pair<std::size_t, std::size_t>, Index> known;
        Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(storage.rows(), storage.cols());
        for (const bool loss : {false, true}) {
            for (Index k = 0; k < factor.rows(); ++k) {
                const Observation& one = data_.observations[static_cast<std::size_t>(k)];
                if (is<Modulus>(one) && is_loss(one) == loss) {
                    factor.row(k) = storage.row(known.try_emplace({one.measurement, one.row}, k).first->second);
                }
            }
        }
        return {size_of_readings * (prediction_.asDiagonal() * factor)};
    }

    /// One sample that goes its own way, as a whole or along a coordinate.
    void add_sample(Index sample) {
        Eigen::VectorXd scale = level_;
        for (Index row = 0; row < scale.size(); ++row) {
            scale[row] *= data_.sample[static_cast<std::size_t>(row)] == sample ? 1.0 : 0.0;
        }
        const Kind kind{Link::errors, Axis::sample};
        add_constant(kind, scale);
        for (const Coordinate coordinate : {Coordinate::time, Coordinate::strain, Coordinate::angular_frequency}) {
            add_smooth(kind, scale, coordinate);
        }
    }

    const DataSet& data_;
    const Eigen::VectorXd& prediction_;
    Eigen::VectorXd level_;   ///< |G*| of each number
    Eigen::VectorXd turned_;  ///< what a small angle between stress and strain does to it
    std::map<Kind, Directions> found_;
};

}  // namespace

Coordinate coordinate_along(Axis axis) {
    const Axis shown = axis == Axis::age ? Axis::time : axis;
    const auto known = std::find_if(factors_on_modulus.begin(), factors_on_modulus.end(),
                                    [&](const auto& one) { return one.second.axis == shown; });
    return known == factors_on_modulus.end() ? Coordinate::none : known->first;
}

double log_factor_of_readings(const Inference& inference, const Fit& base) {
    const DataSet& data = inference.errors().data();
    const Directions directions = AllDirections(data, inference.fitted(inference.prediction(base.model))).readings();
    return directions.empty() ? -std::numeric_limits<double>::infinity() : departures_along(inference, base, directions).log_factor;
}

std::vector<FreeForm> free_forms(const Inference& inference, const Fit& base) {
    const DataSet& data = inference.errors().data();
    const Eigen::VectorXd prediction = inference.fitted(inference.prediction(base.model));
    std::vector<FreeForm> forms;
    for (const auto& [kind, directions] : AllDirections(data, prediction).find()) {
        const DeparturesAlong along = departures_along(inference, base, directions);
        forms.push_back({kind, along.log_factor, along.departure});
    }
    std::sort(forms.begin(), forms.end(), [](const FreeForm& a, const FreeForm& b) { return a.log_factor > b.log_factor; });
    return forms;
}

}  // namespace coagula::diagnose
