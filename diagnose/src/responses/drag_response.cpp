// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_response.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/frequency.hpp>

#include "contact_losses.hpp"
#include "drag_scatter.hpp"
#include "interpolation.hpp"
#include "linear_modulus.hpp"
#include "prestress_response.hpp"

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
constexpr NodeAxis drag_axis{1e-7, 100, 19};

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

/// G* of one structure [Pa], at all nodes of the axis, for a normal stiffness of 1 N/m.
const std::vector<double>& drag_nodes(Simulator& simulator, std::size_t structure) {
    return simulator.simulated({"drag", structure}, 2 * static_cast<std::size_t>(drag_axis.count), [&](const Packing& packing) {
        simulator.progress().update("simulating", 0.0, "drag of the solvent");
        Settings settings;
        settings.normal_stiffness = 1;
        settings.felt_viscosity = 1;
        std::vector<double> frequencies;
        for (int node = 0; node < drag_axis.count; ++node) {
            frequencies.push_back(drag_axis.node(node) / (2 * pi * translation_drag(simulator.radius())));
        }
        const auto response =
            mechanics::solve_frequency_sweep(packing, find_contacts(packing, settings.bond_tolerance),
                                             dragged_model(settings, simulator.radius()), frequencies, {}, simulator.progress());
        std::vector<double> values;
        for (const mechanics::FrequencyPoint& point : response.points) {
            values.insert(values.end(), {point.mean_shear_modulus().real(), point.mean_shear_modulus().imag()});
        }
        return values;
    });
}

/// Logarithm of the reduced viscosity at the nodes, of the mean over a group.
const std::vector<Complex>& drag_curve(Simulator& simulator, std::size_t group) {
    return simulator.remembered({"drag", group}, [&] {
        Settings unit;
        unit.normal_stiffness = 1;
        const std::vector<std::size_t> structures = simulator.members(group);
        const double linear = exact_linear_modulus(simulator, unit, group) * static_cast<double>(structures.size());
        std::vector<Complex> curve;
        for (std::size_t node = 0; node < static_cast<std::size_t>(drag_axis.count); ++node) {
            Complex sum = 0;
            for (const std::size_t k : structures) {
                const std::vector<double>& moduli = drag_nodes(simulator, k);
                sum += Complex(moduli[2 * node], moduli[2 * node + 1]);
            }
            curve.push_back(std::log(reduced_viscosity(sum / linear, drag_axis.node(static_cast<int>(node)))));
        }
        return curve;
    });
}

/// Real part of the same of one structure, over the linear modulus of the first of all.
Eigen::VectorXd own_drag_curve(Simulator& simulator, std::size_t structure) {
    const double own = moduli_of_structure(simulator, structure, {}).front() / unit_stiffness;
    const double unit = moduli_of_structure(simulator, 0, {}).front() / unit_stiffness;
    const std::vector<double>& moduli = drag_nodes(simulator, structure);
    Eigen::VectorXd curve(drag_axis.count);
    for (int node = 0; node < drag_axis.count; ++node) {
        const auto place = 2 * static_cast<std::size_t>(node);
        const Complex lost = (Complex(moduli[place], moduli[place + 1]) - own) / unit;
        curve[node] = std::log(lost / Complex(0, drag_axis.node(node))).real();
    }
    return curve;
}

/// Drag on a particle over its stiffness, times the angular frequency.
double reduced_drag(const Simulator& simulator, const Settings& settings, double angular_frequency) {
    const Complex springs = 1.0 + contact_losses(settings, angular_frequency);
    return translation_drag(simulator.radius()) * settings.felt_viscosity * angular_frequency /
           (settings.normal_stiffness * std::abs(springs));
}

struct DragExcess {
    Eigen::MatrixXd nodes;  ///< nodes x (expected, independent standard errors)
    double degrees;
};

/// How much the logarithm of the drag exceeds that of the mean over a group, at the nodes.
const DragExcess& drag_excess_of(Simulator& simulator, std::size_t group) {
    return simulator.remembered({"scatter of drag", group}, [&]() -> DragExcess {
        Eigen::MatrixXd logarithms = Eigen::MatrixXd::Zero(drag_axis.count, static_cast<Eigen::Index>(simulator.structures()));
        for (const std::size_t each : simulator.groups()) {
            const std::vector<std::size_t> structures = simulator.members(each);
            Eigen::VectorXd sum = Eigen::VectorXd::Zero(drag_axis.count);
            for (const std::size_t k : structures) {
                auto column = logarithms.col(static_cast<Eigen::Index>(k));
                column = own_drag_curve(simulator, k);
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
            drag_scatter(drags, simulator.particles(group), logarithms, static_cast<Eigen::Index>(simulator.groups().size()),
                         static_cast<Eigen::Index>(simulator.members(group).size()));
        Eigen::MatrixXd nodes(drag_axis.count, 1 + scatter.errors.cols());
        nodes << scatter.excess, scatter.errors;
        return {std::move(nodes), scatter.degrees};
    });
}

}  // namespace

Complex drag_response(Simulator& simulator, const Settings& settings, double angular_frequency, std::size_t group) {
    if (settings.felt_viscosity <= 0) {
        return 1;
    }
    const double drag = reduced_drag(simulator, settings, angular_frequency);
    const std::vector<Complex>& curve = drag_curve(simulator, group);
    const Complex logarithm = interpolate_nodes(drag_axis, drag, [&](int node) { return curve[static_cast<std::size_t>(node)]; });
    return 1.0 + Complex(0, std::min(drag, drag_axis.high)) * std::exp(logarithm);
}

/// A change of the magnitude along the frequency turns the phase by pi/2 times its slope (Bode's relation, exact for power laws).
Eigen::RowVectorXcd drag_excess(Simulator& simulator, const Settings& settings, double angular_frequency, std::size_t group) {
    constexpr double step = 0.1;
    const Eigen::MatrixXd& nodes = drag_excess_of(simulator, group).nodes;
    const double drag = reduced_drag(simulator, settings, angular_frequency);
    const auto at = [&](double where) -> Eigen::RowVectorXd {
        const NearNodes near = near_nodes(drag_axis, where);
        return Eigen::RowVector4d(near.weight.data()) * nodes.middleRows<4>(near.first);
    };
    const Eigen::RowVectorXd slope = (at(drag * std::exp(step)) - at(drag * std::exp(-step))) / (2 * step);
    const Eigen::RowVectorXcd own = at(drag) + Complex(0, 0.5 * pi) * slope;
    const auto place = std::distance(simulator.groups().begin(), simulator.groups().find(group));
    const auto blocks =
        static_cast<Eigen::Index>(simulator.has_groups() ? simulator.groups().size() + 1 : 1);  // that of all comes last
    const Eigen::Index count = own.size() - 1;
    Eigen::RowVectorXcd excess = Eigen::RowVectorXcd::Zero(1 + blocks * count);
    excess[0] = own[0];
    excess.segment(1 + place * count, count) = own.tail(count);
    return excess;
}

double drag_degrees(Simulator& simulator) {
    return drag_excess_of(simulator, 0).degrees;
}

Complex exact_drag_response(Simulator& simulator, const Settings& settings, double angular_frequency, std::size_t group) {
    const ContactModel model = dragged_model(settings, simulator.radius());
    const double frequency = angular_frequency / (2 * pi);
    Complex sum = 0;
    const std::vector<std::size_t> structures = simulator.members(group);
    for (const std::size_t k : structures) {
        const ResultKey key{"drag at",
                            k,
                            {settings.normal_stiffness, settings.stiffness_ratio, settings.bending_ratio, settings.bond_tolerance,
                             settings.springpot_ratio, settings.springpot_exponent, settings.dashpot_time, settings.relaxing_ratio,
                             settings.relaxation_time, settings.tension, settings.felt_viscosity, angular_frequency}};
        const std::vector<double>& parts = simulator.simulated(key, 2, [&](const Packing& packing) -> std::vector<double> {
            simulator.progress().update("simulating", 0.0, "drag of the solvent");
            const ContactNetwork bonds = find_contacts(packing, settings.bond_tolerance);
            const auto response =
                mechanics::solve_frequency_sweep(packing, bonds, model, {&frequency, 1}, {}, simulator.progress());
            const Complex modulus = response.points.front().mean_shear_modulus();
            return {modulus.real(), modulus.imag()};
        });
        sum += Complex(parts[0], parts[1]);
    }
    const Complex springs = 1.0 + contact_losses(settings, angular_frequency);
    const double linear = exact_linear_modulus(simulator, settings, group) * prestress_response(simulator, settings, group, true);
    return sum / (static_cast<double>(structures.size()) * linear * springs);
}

Response drag_of_solvent() {
    return {.acts = [](const Settings& settings,
                       const Conditions& at) { return settings.felt_viscosity > 0 && std::isfinite(at.angular_frequency); },
            .factor =
                [](Simulator& simulator, const Settings& settings, const Conditions& at, bool exact) {
                    return exact ? exact_drag_response(simulator, settings, at.angular_frequency, at.group)
                                 : drag_response(simulator, settings, at.angular_frequency, at.group);
                },
            .scatter = [](Simulator& simulator, const Settings& settings, const Conditions& at) -> Scatter {
                const Eigen::RowVectorXcd excess = drag_excess(simulator, settings, at.angular_frequency, at.group);
                return {.logarithmic = excess.tail(excess.size() - 1), .expected = excess[0]};
            },
            .degrees = drag_degrees};
}

}  // namespace coagula::diagnose
