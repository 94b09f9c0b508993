// SPDX-License-Identifier: GPL-3.0-or-later
// What LAMMPS reads for a network of rigid bodies: the springs of the file have the energy of the bonds.
#include <gtest/gtest.h>

#include "engine/lammps_bodies.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace coagula::stages {
namespace {

struct Atom {
    int body;
    int type;
    Eigen::Vector3d place;
};

struct Spring {
    double stiffness;  // K of K (r - r0)^2
    double rest;
    std::size_t first;
    std::size_t second;
};

/// The file as LAMMPS understands it.
struct Held {
    std::vector<Atom> atoms;
    std::vector<Spring> springs;
    std::map<int, double> mass;  // of a type

    explicit Held(const std::string& text) {
        Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
        std::map<int, std::pair<double, double>> coefficients;
        std::string section;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::vector<double> numbers;
            for (double number = 0; words >> number;) {
                numbers.push_back(number);
            }
            if (line.find("xlo") != std::string::npos) {
                edges(0, 0) = numbers.at(1);
            } else if (line.find("ylo") != std::string::npos) {
                edges(1, 1) = numbers.at(1);
            } else if (line.find("zlo") != std::string::npos) {
                edges(2, 2) = numbers.at(1);
            } else if (line.find("xy xz yz") != std::string::npos) {
                edges(0, 1) = numbers.at(0);
                edges(0, 2) = numbers.at(1);
                edges(1, 2) = numbers.at(2);
            } else if (numbers.empty()) {
                section = line.empty() ? section : line;
            } else if (section == "Masses") {
                mass[static_cast<int>(numbers[0])] = numbers.at(1);
            } else if (section == "Bond Coeffs") {
                coefficients[static_cast<int>(numbers[0])] = {numbers.at(1), numbers.at(2)};
            } else if (section.starts_with("Atoms")) {
                const Eigen::Vector3d image(numbers.at(6), numbers.at(7), numbers.at(8));
                atoms.push_back({static_cast<int>(numbers.at(1)), static_cast<int>(numbers.at(2)),
                                 Eigen::Vector3d(numbers.at(3), numbers.at(4), numbers.at(5)) + edges * image});
            } else if (section == "Bonds") {
                const auto [stiffness, rest] = coefficients.at(static_cast<int>(numbers.at(1)));
                springs.push_back(
                    {stiffness, rest, static_cast<std::size_t>(numbers.at(2)) - 1, static_cast<std::size_t>(numbers.at(3)) - 1});
            }
        }
    }

    double energy() const {
        double sum = 0;
        for (const Spring& spring : springs) {
            const double stretch = (atoms.at(spring.second).place - atoms.at(spring.first).place).norm() - spring.rest;
            sum += spring.stiffness * stretch * stretch;
        }
        return sum;
    }

    void move(int body, const Eigen::Vector3d& centre, const Eigen::Vector3d& by, const Eigen::Vector3d& turn) {
        for (Atom& atom : atoms) {
            if (atom.body == body) {
                atom.place += by + turn.cross(atom.place - centre);
            }
        }
    }
};

/// Two spheres of radii 0.8 and 1.2 of the mean, away from the faces of the cell, and a rattler.
struct Pair {
    Packing packing;
    ContactNetwork bonds;

    Pair() {
        packing.cell = Cell::periodic({2e-5, 2e-5, 2e-5});
        packing.radii = Eigen::Vector3d(0.8e-6, 1.2e-6, 1e-6);
        packing.positions.resize(3, 3);
        packing.positions.col(0) = Eigen::Vector3d(5e-6, 5e-6, 5e-6);
        packing.positions.col(1) = packing.positions.col(0) + 1.99e-6 * Eigen::Vector3d(1, 2, 2) / 3;
        packing.positions.col(2) = Eigen::Vector3d(15e-6, 15e-6, 15e-6);
        bonds = find_contacts(packing, 0.01);
    }

    /// In mean radii.
    Eigen::Vector3d place(Index particle) const { return packing.positions.col(particle) / mean_radius(packing); }
};

constexpr std::array<ContactRatios, 6> kinds = {{{.shear = 0.1},
                                                 {.shear = 0},
                                                 {.shear = 1.5},
                                                 {.shear = 0.1, .bending = 0.3},
                                                 {.shear = 0.1, .bending = 0.05, .twisting = 0.4},
                                                 {.shear = 0, .bending = 0.2, .twisting = 0.1}}};

TEST(LammpsBodies, HaveTheEnergyOfABond) {
    const Pair pair;
    const Eigen::Vector3d first = pair.place(0);
    const Eigen::Vector3d second = pair.place(1);
    const Eigen::Vector3d normal = (second - first).normalized();
    const double distance = (second - first).norm();
    const Eigen::Vector3d by = 1e-6 * Eigen::Vector3d(0.3, -0.7, 0.9);
    const Eigen::Vector3d turn = 1e-6 * Eigen::Vector3d(-0.4, 0.2, 0.6);
    const Eigen::Vector3d other_turn = 1e-6 * Eigen::Vector3d(0.8, 0.1, -0.5);
    for (const ContactRatios& ratios : kinds) {
        Held held(lammps_bodies(pair.packing, pair.bonds, ratios, Eigen::Matrix3d::Identity()).data);
        EXPECT_NEAR(held.energy(), 0, 1e-25);
        held.move(1, first, Eigen::Vector3d::Zero(), turn);
        held.move(2, second, by, other_turn);
        const Eigen::Vector3d at_contact = by - (0.4 * turn + 0.6 * other_turn).cross(distance * normal);
        const Eigen::Vector3d across = at_contact - at_contact.dot(normal) * normal;
        const Eigen::Vector3d bend = other_turn - turn;
        const double twist = bend.dot(normal);
        const double expected = 0.5 * (std::pow(at_contact.dot(normal), 2) + ratios.shear * across.squaredNorm() +
                                       ratios.bending * (bend.squaredNorm() - twist * twist) + ratios.twisting * twist * twist);
        EXPECT_NEAR(held.energy() / expected, 1, 1e-5) << ratios.shear << ' ' << ratios.bending << ' ' << ratios.twisting;
    }
}

TEST(LammpsBodies, HaveNoModeFasterThanTheTimeStepAllows) {
    const Pair pair;
    for (const ContactRatios& ratios : kinds) {
        const LammpsBodies bodies = lammps_bodies(pair.packing, pair.bonds, ratios, Eigen::Matrix3d::Identity());
        const Held held(bodies.data);
        std::vector<double> springs(held.atoms.size(), 0);  // that end at an atom
        for (const Spring& spring : held.springs) {
            springs.at(spring.first) += 2 * std::abs(spring.stiffness);
            springs.at(spring.second) += 2 * std::abs(spring.stiffness);
        }
        for (std::size_t atom = 0; atom < springs.size(); ++atom) {
            EXPECT_GE(held.mass.at(held.atoms[atom].type), springs[atom] * (1 - 1e-12));
            EXPECT_EQ(held.mass.at(held.atoms[atom].type), bodies.masses.at(static_cast<std::size_t>(held.atoms[atom].type) - 1));
        }
        EXPECT_LT(lammps_settling_step * std::sqrt(2.0), 2);
    }
}

TEST(LammpsBodies, LeaveOutWhatHasNoBond) {
    const Pair pair;
    const LammpsBodies bodies = lammps_bodies(pair.packing, pair.bonds, {.shear = 0.1}, Eigen::Matrix3d::Identity());
    EXPECT_EQ(Held(bodies.data).atoms.size(), 4U);
    EXPECT_TRUE(bodies.turn);
    EXPECT_FALSE(lammps_bodies(pair.packing, pair.bonds, {.shear = 0}, Eigen::Matrix3d::Identity()).turn);
}

TEST(LammpsBodies, AreDraggedInProportionToTheirMass) {
    const Pair pair;
    const LammpsBodies bodies = lammps_bodies(pair.packing, pair.bonds, {.shear = 0.25}, Eigen::Matrix3d::Identity());
    const std::string commands = lammps_settle(bodies, 0.1, 30, "/a folder/rest");
    EXPECT_NE(commands.find("fix drag all viscous 0.1 scale 1 0.75 scale 2 0.25"), std::string::npos) << commands;
    EXPECT_NE(commands.find("run 30 "), std::string::npos);
    EXPECT_NE(commands.find("\"/a folder/rest\""), std::string::npos);
}

}  // namespace
}  // namespace coagula::stages
