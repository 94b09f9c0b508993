// SPDX-License-Identifier: GPL-3.0-or-later
#include "frequency_results.hpp"

#include <coagula/io/contact_model_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace coagula::stages {

namespace {

using mechanics::FrequencyPoint;
using mechanics::FrequencyResponse;
using Complex = std::complex<double>;

const std::string frequency_group = "/mechanics/frequency/";

struct PlaneOfShear {
    const char* name;
    int normal;
    int direction;
};
constexpr std::array<PlaneOfShear, 6> orientations{
    {{"xy", 0, 1}, {"xz", 0, 2}, {"yx", 1, 0}, {"yz", 1, 2}, {"zx", 2, 0}, {"zy", 2, 1}}};

double real_part(const Complex& value) {
    return value.real();
}
double imaginary_part(const Complex& value) {
    return value.imag();
}

/// A vector with one number for each point of the sweep.
template <class Value>
Eigen::VectorXd over_points(const FrequencyResponse& response, const Value& value) {
    Eigen::VectorXd values(static_cast<Index>(response.points.size()));
    std::transform(response.points.begin(), response.points.end(), values.begin(), value);
    return values;
}

/// A 6 x 6 tensor of each point: [points][6][6].
io::Dataset tensors(const std::string& name, const FrequencyResponse& response, double (*part)(const Complex&),
                    const std::string& description) {
    std::vector<double> values;
    for (const FrequencyPoint& point : response.points) {
        for (int row = 0; row < 6; ++row) {
            for (int column = 0; column < 6; ++column) {
                values.push_back(part(point.modulus(row, column)));
            }
        }
    }
    return {frequency_group + name, {response.points.size(), 6, 6}, std::move(values), "Pa", description};
}

void append_network(Results& results, const FrequencyResponse& response, double bond_tolerance, const ContactModel& model) {
    results.push_back(io::text(frequency_group + "method", "frequency", "harmonic response of the bonded network with losses"));
    results.push_back(io::integer(frequency_group + "contacts", response.contacts, "number of bonds"));
    results.push_back(io::integer(frequency_group + "rattlers", response.rattlers, "particles that carry no load"));
    results.push_back(io::scalar(frequency_group + "bond_tolerance", bond_tolerance, "1",
                                 "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(io::text(frequency_group + "model", io::contact_model_text(model), "the contact model, as a TOML file"));
    results.push_back(io::scalar(frequency_group + "contact_stiffness/normal", model.normal_stiffness / 2, "N/m",
                                 "stiffness of the normal spring of a contact"));
    results.push_back(io::scalar(frequency_group + "contact_stiffness/shear", model.shear_stiffness / 2, "N/m",
                                 "stiffness of the shear spring of a contact"));
    results.push_back(io::vector(frequency_group + "frequency", over_points(response, [](const auto& p) { return p.frequency; }),
                                 "Hz", "frequency of the strain"));
}

/// Mean, standard deviation and the six orientations of one part of G*.
void append_modulus(Results& results, const FrequencyResponse& response, const std::string& name, double (*part)(const Complex&)) {
    const auto add = [&](const std::string& key, const auto& value, const std::string& description) {
        results.push_back(io::vector(frequency_group + name + "/" + key, over_points(response, value), "Pa", description));
    };
    const auto mean = [part](const FrequencyPoint& p) { return part(p.mean_shear_modulus()); };
    add("mean", mean, "mean of the six orientations");
    add(
        "std",
        [&](const FrequencyPoint& p) {
            double sum = 0;
            for (const PlaneOfShear& o : orientations) {
                sum += std::pow(part(p.shear_modulus(o.normal, o.direction)) - mean(p), 2);
            }
            return std::sqrt(sum / 6);
        },
        "standard deviation over the orientations of this one structure");
    for (const PlaneOfShear& o : orientations) {
        add(
            o.name, [&](const FrequencyPoint& p) { return part(p.shear_modulus(o.normal, o.direction)); },
            std::string("plate normal and shear direction ") + o.name);
    }
}

void append_derivatives(Results& results, const FrequencyResponse& response) {
    for (std::size_t k = 0; k < response.parameters.size(); ++k) {
        const ContactParameter& parameter = response.parameters[k];
        const std::string unit = parameter.unit == "1" ? "Pa" : "Pa/(" + parameter.unit + ")";
        const std::string path = frequency_group + "derivative/" + parameter.name + "/";
        const std::string of = " modulus, mean of the orientations, by " + parameter.name;
        results.push_back(io::vector(path + "storage_modulus",
                                     over_points(response, [k](const auto& p) { return p.mean_derivative(k).real(); }), unit,
                                     "derivative of the storage" + of));
        results.push_back(io::vector(path + "loss_modulus",
                                     over_points(response, [k](const auto& p) { return p.mean_derivative(k).imag(); }), unit,
                                     "derivative of the loss" + of));
    }
}

void append_stiffness(Results& results, const FrequencyResponse& response) {
    const auto add = [&](const std::string& name, const auto& value, const std::string& description) {
        results.push_back(
            io::vector(frequency_group + "complex_contact_stiffness/" + name, over_points(response, value), "N/m", description));
    };
    add(
        "normal_storage", [](const auto& p) { return p.contact_stiffness.normal.real(); }, "real part of k* of a contact");
    add(
        "normal_loss", [](const auto& p) { return p.contact_stiffness.normal.imag(); }, "imaginary part of k* of a contact");
    add(
        "shear_storage", [](const auto& p) { return p.contact_stiffness.shear.real(); }, "real part of k* of a contact");
    add(
        "shear_loss", [](const auto& p) { return p.contact_stiffness.shear.imag(); }, "imaginary part of k* of a contact");
}

void append_solution(Results& results, const FrequencyResponse& response) {
    Eigen::VectorXi iterations(static_cast<Index>(response.points.size()));
    std::transform(response.points.begin(), response.points.end(), iterations.begin(), [](const auto& p) { return p.iterations; });
    results.push_back(
        io::integers(frequency_group + "iterations", iterations, "iterations of the solver, largest number over the strains"));
    results.push_back(io::vector(frequency_group + "residual", over_points(response, [](const auto& p) { return p.residual; }), "1",
                                 "|f - K u| / |f|, largest over the strains"));
    Eigen::MatrixXd dissipation(static_cast<Index>(response.points.size()), 6);
    for (std::size_t k = 0; k < response.points.size(); ++k) {
        dissipation.row(static_cast<Index>(k)) = response.points[k].dissipation.transpose();
    }
    results.push_back(io::matrix(frequency_group + "dissipation", dissipation, "Pa",
                                 "energy lost in bonds and solvent per cycle, volume and squared strain amplitude, Voigt order"));
}

std::string moduli_text(const Complex& modulus) {
    return "G' " + with_unit(modulus.real(), "Pa") + ", G'' " + with_unit(modulus.imag(), "Pa") + ", phase " +
           with_unit(std::arg(modulus), "rad");
}

}  // namespace

Results datasets_of(const FrequencyResponse& response, double bond_tolerance, const ContactModel& model) {
    Results results;
    append_network(results, response, bond_tolerance, model);
    append_modulus(results, response, "storage_modulus", real_part);
    append_modulus(results, response, "loss_modulus", imaginary_part);
    results.push_back(io::vector(frequency_group + "phase",
                                 over_points(response, [](const auto& p) { return std::arg(p.mean_shear_modulus()); }), "rad",
                                 "phase of the mean modulus, by which the stress leads the strain"));
    results.push_back(tensors("storage_tensor", response, real_part, "G' for all strains, Voigt order xx yy zz yz xz xy"));
    results.push_back(tensors("loss_tensor", response, imaginary_part, "G'' for all strains, Voigt order xx yy zz yz xz xy"));
    append_derivatives(results, response);
    append_stiffness(results, response);
    append_solution(results, response);
    return results;
}

Table table_of(const FrequencyResponse& response) {
    Table table{{"bonds", std::to_string(response.contacts)}, {"rattlers", std::to_string(response.rattlers)}};
    double residual = 0;
    for (const FrequencyPoint& point : response.points) {
        table.emplace_back(with_unit(point.frequency, "Hz"), moduli_text(point.mean_shear_modulus()));
        residual = std::max(residual, point.residual);
    }
    table.emplace_back("residual", with_unit(residual, "1"));
    return table;
}

}  // namespace coagula::stages
