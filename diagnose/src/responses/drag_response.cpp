// Response of a network whose particles the solvent drags on: the frequency solver at the nodes of a grid of reduced frequencies.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/frequency.hpp>

#include "cache_key.hpp"
#include "contact_losses.hpp"
#include "drag_scatter.hpp"
#include "interpolation.hpp"
#include "unit_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Drag on a particle over its normal stiffness, times angular frequency.
constexpr Axis drag_axis{1e-7, 100, 19};

/// Springs, their losses and drag alone: what acts at vanishing strain and age.
ContactModel dragged_model(const Settings& settings, double radius) {
    Settings part;
    part.normal_stiffness = settings.normal_stiffness;
    part.stiffness_ratio = settings.stiffness_ratio;
    part.bending_ratio = settings.bending_ratio;
    part.springpot_ratio = settings.springpot_ratio;
    part.springpot_exponent = settings.springpot_exponent;
    part.dashpot_time = settings.dashpot_time;
    part.relaxing_ratio = settings.relaxing_ratio;
    part.relaxation_time = settings.relaxation_time;
    part.tension = settings.tension;
    part.felt_viscosity = settings.felt_viscosity;
    return contact_model_of(part, radius);
}

/// (G* / G - 1) over i times the reduced frequency: constant at low frequency.
Complex reduced_viscosity(Complex response, double drag) {
    return (response - 1.0) / Complex(0, drag);
}

}  // namespace

/// G* of one structure [Pa], at all nodes of the axis, for a normal stiffness of 1 N/m.
const std::vector<double>& Simulator::drag_nodes(std::size_t structure) {
    const std::string key = "drag " + names_[structure];
    auto found = find_result(cache_, key, 2 * static_cast<std::size_t>(drag_axis.count));
    if (found == cache_.end()) {
        progress_.update("simulating", 0.0, "drag of the solvent");
        Settings settings;
        settings.normal_stiffness = 1;
        settings.felt_viscosity = 1;
        std::vector<double> frequencies;
        for (int node = 0; node < drag_axis.count; ++node) {
            frequencies.push_back(drag_axis.node(node) / (2 * pi * translation_drag(radius_)));
        }
        const auto response =
            mechanics::solve_frequency_sweep(structures_[structure], find_contacts(structures_[structure], settings.bond_tolerance),
                                             dragged_model(settings, radius_), frequencies, {}, progress_);
        std::vector<double> values;
        for (const mechanics::FrequencyPoint& point : response.points) {
            values.insert(values.end(), {point.mean_shear_modulus().real(), point.mean_shear_modulus().imag()});
        }
        found = cache_.insert_or_assign(key, std::move(values)).first;
    }
    return found->second;
}

/// Logarithm of the reduced viscosity at the nodes, of the mean over a group.
const std::vector<Complex>& Simulator::drag_curve(std::size_t group) {
    std::vector<Complex>& curve = drag_curves_[group];
    if (!curve.empty()) {
        return curve;
    }
    Settings unit;
    unit.normal_stiffness = 1;
    const std::vector<std::size_t> structures = members(group);
    const double linear = exact_linear_modulus(unit, group) * static_cast<double>(structures.size());
    for (std::size_t node = 0; node < static_cast<std::size_t>(drag_axis.count); ++node) {
        Complex sum = 0;
        for (const std::size_t k : structures) {
            const std::vector<double>& moduli = drag_nodes(k);
            sum += Complex(moduli[2 * node], moduli[2 * node + 1]);
        }
        curve.push_back(std::log(reduced_viscosity(sum / linear, drag_axis.node(static_cast<int>(node)))));
    }
    return curve;
}

/// The same of one structure, over the linear modulus of the first of all.
const std::vector<Complex>& Simulator::own_drag_curve(std::size_t structure) {
    std::vector<Complex>& curve = own_drag_curves_[structure];
    if (curve.empty()) {
        const Settings base;
        const double own = linear_moduli(structure, base.stiffness_ratio, 0, base.bond_tolerance).front() / unit_stiffness;
        const double unit = linear_moduli(0, base.stiffness_ratio, 0, base.bond_tolerance).front() / unit_stiffness;
        const std::vector<double>& moduli = drag_nodes(structure);
        for (std::size_t node = 0; node < static_cast<std::size_t>(drag_axis.count); ++node) {
            const Complex lost = (Complex(moduli[2 * node], moduli[2 * node + 1]) - own) / unit;
            curve.push_back(std::log(lost / Complex(0, drag_axis.node(static_cast<int>(node)))));
        }
    }
    return curve;
}

/// Drag on a particle over its stiffness, times the angular frequency.
double Simulator::reduced_drag(const Settings& settings, double angular_frequency) const {
    const Complex springs = 1.0 + contact_losses(settings, angular_frequency);
    return translation_drag(radius_) * settings.felt_viscosity * angular_frequency /
           (settings.normal_stiffness * std::abs(springs));
}

Complex Simulator::drag_response(const Settings& settings, double angular_frequency, std::size_t group) {
    if (settings.felt_viscosity <= 0) {
        return 1;
    }
    const double drag = reduced_drag(settings, angular_frequency);
    const std::vector<Complex>& curve = drag_curve(group);
    const Complex logarithm = interpolate_nodes(drag_axis, drag, [&](int node) { return curve[static_cast<std::size_t>(node)]; });
    return 1.0 + Complex(0, std::min(drag, drag_axis.high)) * std::exp(logarithm);
}

/// By how much the logarithm of the drag exceeds that of the mean over a group, at the nodes: expected, then independent standard
/// errors.
const Eigen::MatrixXd& Simulator::drag_excess_of(std::size_t group) {
    const auto found = drag_excesses_.find(group);
    if (found != drag_excesses_.end()) {
        return found->second;
    }
    const auto count = static_cast<Eigen::Index>(structures_.size());
    Eigen::MatrixXd logarithms = Eigen::MatrixXd::Zero(drag_axis.count, count);
    for (const std::size_t each : distinct_groups_) {
        const std::vector<std::size_t> structures = members(each);
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(drag_axis.count);
        for (const std::size_t k : structures) {
            const std::vector<Complex>& curve = own_drag_curve(k);
            auto column = logarithms.col(static_cast<Eigen::Index>(k));
            std::transform(curve.begin(), curve.end(), column.begin(), [](Complex logarithm) { return logarithm.real(); });
            sum += column;
        }
        for (const std::size_t k : structures) {
            logarithms.col(static_cast<Eigen::Index>(k)) -= sum / static_cast<double>(structures.size());
        }
    }
    Eigen::ArrayXd drags(drag_axis.count);
    for (int node = 0; node < drag_axis.count; ++node) {
        drags[node] = drag_axis.node(node);
    }
    const DragScatter scatter =
        drag_scatter(drags, particles(group), logarithms, static_cast<Eigen::Index>(distinct_groups_.size()),
                     static_cast<Eigen::Index>(members(group).size()));
    drag_degrees_ = scatter.degrees;
    Eigen::MatrixXd excess(drag_axis.count, 1 + scatter.errors.cols());
    excess << scatter.excess, scatter.errors;
    return drag_excesses_.emplace(group, std::move(excess)).first->second;
}

/// A change of the magnitude along the frequency turns the phase by pi/2 times its slope (Bode's relation, exact for power laws).
Eigen::RowVectorXcd Simulator::drag_excess(const Settings& settings, double angular_frequency, std::size_t group) {
    constexpr double step = 0.1;
    const Eigen::MatrixXd& nodes = drag_excess_of(group);
    const double drag = reduced_drag(settings, angular_frequency);
    const auto at = [&](double where) -> Eigen::RowVectorXd {
        const NearNodes near = near_nodes(drag_axis, where);
        return Eigen::RowVector4d(near.weight.data()) * nodes.middleRows<4>(near.first);
    };
    const Eigen::RowVectorXd slope = (at(drag * std::exp(step)) - at(drag * std::exp(-step))) / (2 * step);
    const Eigen::RowVectorXcd own = at(drag) + Complex(0, 0.5 * pi) * slope;
    const auto place = std::distance(distinct_groups_.begin(), distinct_groups_.find(group));
    const auto blocks = static_cast<Eigen::Index>(groups_.empty() ? 1 : distinct_groups_.size() + 1);  // that of all comes last
    const Eigen::Index count = own.size() - 1;
    Eigen::RowVectorXcd excess = Eigen::RowVectorXcd::Zero(1 + blocks * count);
    excess[0] = own[0];
    excess.segment(1 + place * count, count) = own.tail(count);
    return excess;
}

double Simulator::drag_degrees() {
    drag_excess_of(0);
    return drag_degrees_;
}

Complex Simulator::exact_drag_response(const Settings& settings, double angular_frequency, std::size_t group) {
    const ContactModel model = dragged_model(settings, radius_);
    const double frequency = angular_frequency / (2 * pi);
    Complex sum = 0;
    const std::vector<std::size_t> structures = members(group);
    for (const std::size_t k : structures) {
        const std::string key =
            key_of("drag at " + names_[k],
                   {settings.normal_stiffness, settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance,
                    settings.springpot_ratio, settings.springpot_exponent, settings.dashpot_time, settings.relaxing_ratio,
                    settings.relaxation_time, settings.tension, settings.felt_viscosity, angular_frequency});
        auto found = find_result(cache_, key, 2);
        if (found == cache_.end()) {
            progress_.update("simulating", 0.0, "drag of the solvent");
            const ContactNetwork bonds = find_contacts(structures_[k], settings.bond_tolerance);
            const auto response = mechanics::solve_frequency_sweep(structures_[k], bonds, model, {&frequency, 1}, {}, progress_);
            const Complex modulus = response.points.front().mean_shear_modulus();
            found = cache_.insert_or_assign(key, std::vector<double>{modulus.real(), modulus.imag()}).first;
        }
        sum += Complex(found->second[0], found->second[1]);
    }
    const Complex springs = 1.0 + contact_losses(settings, angular_frequency);
    const double linear = exact_linear_modulus(settings, group) * exact_prestress_response(settings, group);
    return sum / (static_cast<double>(structures.size()) * linear * springs);
}

}  // namespace coagula::diagnose
