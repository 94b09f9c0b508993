// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a network that processes solve together, and the files by which they get it. No MPI takes part.
#include "bricks.hpp"
#include "part.hpp"

#include "networks.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>

namespace coagula::mechanics {
namespace {

using coagula::testing::alike;
using coagula::testing::random_spheres;

constexpr int overlap = 2;

/// A network whose problem lies in a file.
struct Written {
    Packing packing = random_spheres(150, 7.6, 1e-6, 3);
    ContactNetwork bonds = find_contacts(packing, 0.1);
    LoadBearing kept = find_load_bearing(bonds);
    LinearNetwork network = {packing, bonds, kept, alike(bonds, {.normal = 50, .shear = 20}), 50};
    std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "parts.problem";

    Written() {
        LinearProblem problem{.fraction = Eigen::Matrix3Xd(3, network.particles()),
                              .lengths = packing.cell.edge_lengths(),
                              .affine_energy = network.affine_energy().diagonal(),
                              .modulus_tolerance = 1e-6};
        for (Index place = 0; place < network.particles(); ++place) {
            const Eigen::Vector3d at = packing.positions.col(kept.particle[static_cast<std::size_t>(place)]);
            problem.fraction.col(place) = packing.cell.fraction(packing.cell.wrap(at));
        }
        write_problem(path, problem, network.bonds());
    }
    Written(const Written&) = delete;
    Written& operator=(const Written&) = delete;
    ~Written() { std::filesystem::remove(path); }
};

TEST(Parts, EachParticleBelongsToOneProcess) {
    const Written written;
    const ProblemFile problem(written.path);
    for (const int processes : {1, 2, 3, 8}) {
        std::vector<Index> numbers(static_cast<std::size_t>(problem.particles()), -1);
        Index next = 0;
        std::vector<Part> parts;
        for (int process = 0; process < processes; ++process) {
            parts.push_back(part_of(problem, process, processes, overlap));
            for (Index place = 0; place < parts.back().own; ++place) {
                Index& number = numbers[static_cast<std::size_t>(parts.back().particle[static_cast<std::size_t>(place)])];
                EXPECT_EQ(number, -1) << "owned twice";
                number = next++;
            }
        }
        EXPECT_EQ(next, problem.particles());
        for (const Part& part : parts) {
            for (std::size_t k = 0; k < part.neighbour.size(); ++k) {
                const Index particle = part.particle[static_cast<std::size_t>(part.own) + k];
                EXPECT_EQ(part.neighbour[k], numbers[static_cast<std::size_t>(particle)]) << processes << " processes";
            }
        }
    }
}

TEST(Parts, HaveTheEquationsOfTheirParticles) {
    const Written written;
    const ProblemFile problem(written.path);
    const Loads x = Loads::Random(6 * problem.particles(), 6);
    Loads expected;
    multiply(both_triangles(written.network.stiffness()), x, expected);
    const Loads loads = written.network.loads();
    for (const int processes : {1, 3, 8}) {
        for (int process = 0; process < processes; ++process) {
            const Part part = part_of(problem, process, processes, overlap);
            const auto all = static_cast<Index>(part.particle.size());
            const LinearNetwork network(all, part.bonds);
            Loads local(6 * all, 6);
            for (Index place = 0; place < all; ++place) {
                local.middleRows<6>(6 * place) = x.middleRows<6>(6 * part.particle[static_cast<std::size_t>(place)]);
            }
            Loads product;
            multiply(both_triangles(network.stiffness()), local, product);
            const Loads own_loads = network.loads();
            for (Index place = 0; place < part.own; ++place) {
                const Index row = 6 * part.particle[static_cast<std::size_t>(place)];
                EXPECT_LT((product.middleRows<6>(6 * place) - expected.middleRows<6>(row)).norm(), 1e-12);
                EXPECT_LT((own_loads.middleRows<6>(6 * place) - loads.middleRows<6>(row)).norm(), 1e-12);
            }
        }
    }
}

TEST(Parts, BricksHaveSmallFaces) {
    EXPECT_EQ(Bricks({1, 1, 1}, 8).count(), (std::array<int, 3>{2, 2, 2}));
    EXPECT_EQ(Bricks({1, 1, 10}, 4).count(), (std::array<int, 3>{1, 1, 4}));
    const Bricks bricks({1, 2, 3}, 12);
    std::vector<int> owned(12, 0);
    for (int place = 0; place < 1000; ++place) {
        ++owned.at(static_cast<std::size_t>(bricks.owner(0.5 * (Eigen::Vector3d::Random().array() + 1))));
    }
    EXPECT_GT(*std::min_element(owned.begin(), owned.end()), 40);
}

TEST(ProblemFile, IsReadAsItWasWritten) {
    const Written written;
    const ProblemFile problem(written.path);
    ASSERT_EQ(problem.particles(), written.network.particles());
    ASSERT_EQ(problem.ends().size(), written.network.bonds().size());
    EXPECT_EQ(problem.modulus_tolerance(), 1e-6);
    EXPECT_EQ(problem.affine_energy(), Eigen::VectorXd(written.network.affine_energy().diagonal()));
    for (std::size_t k = 0; k < problem.ends().size(); ++k) {
        const LinearBond& bond = written.network.bonds()[k];
        const LinearBond read = problem.bond(k);
        EXPECT_EQ(read.first, bond.first);
        EXPECT_EQ(read.second, bond.second);
        EXPECT_EQ(read.normal, bond.normal);
        EXPECT_EQ(read.branch, bond.branch);
        EXPECT_EQ(read.second_arm, bond.second_arm);
        EXPECT_EQ(read.tangent.shear, bond.tangent.shear);
        EXPECT_EQ(read.tangent.tension, bond.tangent.tension);
    }
    std::filesystem::resize_file(written.path, std::filesystem::file_size(written.path) - 8);
    EXPECT_THROW(ProblemFile(written.path), std::runtime_error);
    EXPECT_THROW(ProblemFile(written.path / "none"), std::runtime_error);
}

TEST(SolutionFile, IsPutTogetherFromRowsOfAllProcesses) {
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "parts.solution";
    const Loads motion = Loads::Random(30, 6);
    create_solution(path, 5);
    const std::vector<std::vector<Index>> rows = {{1, 2, 4}, {0, 3}};
    for (const std::vector<Index>& own : rows) {
        Loads part(6 * static_cast<Index>(own.size()), 6);
        for (std::size_t k = 0; k < own.size(); ++k) {
            part.middleRows<6>(6 * static_cast<Index>(k)) = motion.middleRows<6>(6 * own[k]);
        }
        write_motion(path, own, part);
    }
    EXPECT_THROW(read_solution(path, 5), std::runtime_error) << "without a summary it is incomplete";
    write_summary(path, {.iterations = 7, .residual = 0.5, .modulus_error = 0.25});
    const SolvedNetwork solved = read_solution(path, 5);
    EXPECT_EQ(solved.motion, motion);
    EXPECT_EQ(solved.iterations, 7);
    EXPECT_EQ(solved.modulus_error, 0.25);
    EXPECT_THROW(read_solution(path, 6), std::runtime_error);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace coagula::mechanics
