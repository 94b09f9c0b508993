// SPDX-License-Identifier: GPL-3.0-or-later
// What LAMMPS reads for a Brownian run.
#include <gtest/gtest.h>

#include "engine/lammps_brownian.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace coagula::stages {
namespace {

const LammpsBrownian run_in_folder{.folder = "/a folder", .mass = 2e-6, .time_step = 8e-7, .seed = 5, .rows = 11};

std::string line_with(const std::string& text, const std::string& word) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.find(word) != std::string::npos) {
            return line;
        }
    }
    return "";
}

TEST(LammpsBrownian, DampsAMassAtMobilityOneBeforeItIsMoved) {
    const std::string text = lammps_setup(run_in_folder);
    EXPECT_EQ(line_with(text, "mass 1"), "mass 1 2e-06");
    EXPECT_EQ(line_with(text, "langevin").substr(0, 37), "fix noise all langevin 1 1 2e-06 12 g");
    EXPECT_LT(text.find("gjf"), text.find("all nve"));
    EXPECT_EQ(line_with(text, "timestep"), "timestep 8e-07");
    EXPECT_EQ(line_with(text, "read_data"), "read_data \"/a folder/start.data\"");
    EXPECT_EQ(line_with(text, "pair_style"), "pair_style table linear 11");
}

TEST(LammpsBrownian, TakesSeedsThatLammpsTakes) {
    LammpsBrownian run = run_in_folder;
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{899'999'999}, std::numeric_limits<std::uint64_t>::max()}) {
        run.seed = seed;
        std::istringstream words(line_with(lammps_setup(run), "langevin"));
        std::vector<std::string> all;
        for (std::string word; words >> word;) {
            all.push_back(word);
        }
        const double taken = std::stod(all.at(7));
        EXPECT_GE(taken, 1);
        EXPECT_LE(taken, 900'000'000);
    }
}

TEST(LammpsBrownian, GoesOnWithoutASetUp) {
    EXPECT_EQ(line_with(lammps_piece(run_in_folder, 12, 0), "run"), "run 12 post no");
    const std::string later = lammps_piece(run_in_folder, 7, 3);
    EXPECT_EQ(line_with(later, "run"), "run 7 pre no post no");
    EXPECT_EQ(line_with(later, "shell"), "shell mv \"/a folder/frame.part\" \"/a folder/frame-3.dump\"");
    EXPECT_EQ(lammps_frame(run_in_folder, 3), "/a folder/frame-3.dump");
}

TEST(LammpsBrownian, StartsFromPositionsInRadiiInsideABoxAtZero) {
    Packing packing{Cell::of_edges({1, 2, 3}, Eigen::Vector3d(8, 6, 4).asDiagonal(), {true, true, true}), Eigen::Matrix3Xd(3, 2),
                    Eigen::Vector2d::Constant(0.5)};
    packing.positions.col(0) << 2, 2.5, 6;
    packing.positions.col(1) << 9.5, 2, 3;
    const std::string text = lammps_start(packing, 0.5);
    EXPECT_NE(text.find("2 atoms\n"), std::string::npos);
    EXPECT_NE(text.find("0 16 xlo xhi\n0 12 ylo yhi\n0 8 zlo zhi\n"), std::string::npos);
    EXPECT_NE(text.find("\n1 1 2 1 6\n2 1 1 0 0\n"), std::string::npos);
}

TEST(LammpsBrownian, TablesAForceWithItsEnergy) {
    constexpr double last = 1.6;
    constexpr double stiffness = 4e5;
    const auto force = [](double distance) { return stiffness * (last - distance); };
    std::istringstream lines(lammps_force_table(force, last));
    std::string line;
    while (std::getline(lines, line) && line != "PAIR") {
    }
    std::getline(lines, line);
    EXPECT_EQ(line, "N " + std::to_string(lammps_table_rows(last)) + " R 1.5 1.6");
    std::size_t rows = 0;
    double number = 0;
    double distance = 0;
    double energy = 0;
    double value = 0;
    while (lines >> number >> distance >> energy >> value) {
        ++rows;
        EXPECT_NEAR(value, force(distance), 1e-9);
        EXPECT_NEAR(energy, 0.5 * stiffness * std::pow(last - distance, 2), 1e-9);
    }
    EXPECT_EQ(rows, lammps_table_rows(last));
    EXPECT_EQ(distance, last);
    EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace coagula::stages
