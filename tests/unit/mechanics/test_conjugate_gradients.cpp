// SPDX-License-Identifier: GPL-3.0-or-later
#include "solvers/conjugate_gradients.hpp"
#include "solvers/energy_error.hpp"
#include "solvers/six_column_kernels.hpp"
#include "solvers/stiffness.hpp"

#include "networks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::mechanics {
namespace {

using coagula::testing::alike;
using coagula::testing::random_spheres;
using Tensor = Eigen::Matrix<double, 6, 1>;

/// A dense network without any mode of zero stiffness but those of the rigid motion.
struct Network {
    Packing packing = random_spheres(120, 7.6, 1e-6, 3);
    ContactNetwork bonds = find_contacts(packing, 0.1);
    LinearNetwork linear = {packing, bonds, find_load_bearing(bonds), alike(bonds, {.normal = 50, .shear = 20}), 50};
    BlockMatrix full = both_triangles(linear.stiffness());
    Loads loads = linear.loads();
    Tensor affine = linear.affine_energy().diagonal();

    Solution solve(const Loads& f, const Tensor& energy, const StopRule& rule) const {
        const auto by_diagonal = [&](const Loads& r, Loads& z) {
            z.resize(r.rows(), 6);
            for (Index row = 0; row < full.rows(); ++row) {
                z.middleRows<6>(6 * row) = r.middleRows<6>(6 * row) / diagonal(row);
            }
        };
        return block_conjugate_gradients(full, f, energy, by_diagonal, rule, {});
    }
    double diagonal(Index row) const {
        for (Index k = full.start[static_cast<std::size_t>(row)]; k < full.start[static_cast<std::size_t>(row) + 1]; ++k) {
            if (full.column[static_cast<std::size_t>(k)] == row) {
                return full.block[static_cast<std::size_t>(k)].trace() / 6;
            }
        }
        return 1;
    }
};

Tensor energies(const Loads& f, const Loads& motion) {
    return f.cwiseProduct(motion).colwise().sum();
}

TEST(ConjugateGradients, SixLoadsAtOnceNeedFewerStepsThanOneByOne) {
    const Network network;
    const StopRule rule{.residual = 1e-8, .energy = 0, .most_iterations = 1000};
    const Solution together = network.solve(network.loads, network.affine, rule);
    ASSERT_TRUE(together.converged);
    for (Index column = 0; column < 6; ++column) {
        Loads one = Loads::Zero(network.loads.rows(), 6);
        one.col(column) = network.loads.col(column);
        const Solution alone = network.solve(one, network.affine, rule);
        ASSERT_TRUE(alone.converged);
        EXPECT_LT(together.iterations, 0.9 * alone.iterations);
        EXPECT_NEAR(energies(network.loads, together.motion)[column] / energies(one, alone.motion)[column], 1, 1e-10);
        EXPECT_EQ(alone.motion.col((column + 1) % 6).norm(), 0) << "a column without load moves";
    }
}

TEST(ConjugateGradients, LoadsMayDependOnEachOther) {
    const Network network;
    const StopRule rule{.residual = 1e-8, .energy = 0, .most_iterations = 1000};
    const Solution plain = network.solve(network.loads, network.affine, rule);
    Loads dependent = network.loads;
    dependent.col(1) = dependent.col(0);
    dependent.col(2) = 1e6 * dependent.col(3) - 1e6 * dependent.col(0);
    dependent.col(4).setZero();
    const Solution solution = network.solve(dependent, network.affine, rule);
    ASSERT_TRUE(solution.converged);
    EXPECT_LT(solution.residual, 2e-8);
    EXPECT_LT((solution.motion.col(1) - plain.motion.col(0)).norm(), 1e-5 * plain.motion.col(0).norm());
    EXPECT_LT((solution.motion.col(2) - 1e6 * (plain.motion.col(3) - plain.motion.col(0))).norm(),
              1e-5 * solution.motion.col(2).norm());
    EXPECT_EQ(solution.motion.col(4).norm(), 0);
}

TEST(ConjugateGradients, TheErrorOfTheEnergyIsBelowItsEstimate) {
    const Network network;
    const Tensor exact =
        energies(network.loads, network.solve(network.loads, network.affine, {.residual = 1e-11, .most_iterations = 2000}).motion);
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        const Solution solution =
            network.solve(network.loads, network.affine, {.residual = 1e-14, .energy = tolerance, .most_iterations = 2000});
        ASSERT_TRUE(solution.converged);
        const Tensor left = network.affine - exact;
        const Tensor missing = exact - energies(network.loads, solution.motion);
        EXPECT_LE(missing.cwiseQuotient(left).maxCoeff(), tolerance);
        EXPECT_LE(solution.energy_error, tolerance);
    }
}

TEST(ConjugateGradients, AnIndefiniteMatrixIsNotSolved) {
    Network network;
    network.full.block[0] -= 3 * network.diagonal(0) * Block::Identity();
    const Solution solution =
        network.solve(network.loads, network.affine, {.residual = 1e-8, .energy = 1e-6, .most_iterations = 500});
    EXPECT_FALSE(solution.converged && solution.residual > 1e-3) << "taken for solved with a residual of " << solution.residual;
}

TEST(ConjugateGradients, ANegativeMatrixHasNoLeastEnergy) {
    Network network;
    for (Block& block : network.full.block) {
        block = -block;
    }
    const Solution solution =
        network.solve(network.loads, network.affine, {.residual = 1e-8, .energy = 1e-6, .most_iterations = 500});
    EXPECT_FALSE(solution.converged) << "after " << solution.iterations << " iterations, residual " << solution.residual;
    EXPECT_EQ(solution.motion.norm(), 0);
}

/// The largest quotient of the true error over its estimate while the gains of a column fall by a factor each time.
double most_underestimated(double factor) {
    const double all = 1 / (1 - factor);
    EnergyError error(EnergyError::Row::Constant(all + 1));  // one is left at the end
    double worst = 0;
    double gained = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double gain = std::pow(factor, iteration);
        gained += gain;
        error.add(EnergyError::Row::Constant(gain), EnergyError::Columns::Constant(true));
        if (std::isfinite(error.estimate()[0]) && iteration > 20) {
            worst = std::max(worst, (all - gained) / (all - gained + 1) / error.estimate()[0]);
        }
    }
    return worst;
}

TEST(EnergyError, IsNotUnderestimatedWhereGainsFallSlowly) {
    EXPECT_LT(most_underestimated(0.5), 0.01) << "the estimate is that of ten iterations ago";
    EXPECT_LE(most_underestimated(0.9), 1.0);
    EXPECT_LE(most_underestimated(0.97), 1 + 1e-9);
    EXPECT_LE(most_underestimated(0.99), 1 + 1e-9);
}

TEST(SixColumnKernels, ARowOfBlocksTimesColumnsOfSix) {
    const Eigen::MatrixXd blocks = Eigen::MatrixXd::Random(6, 18);
    const Loads x = Loads::Random(6 * 5, 6);
    const std::array<std::ptrdiff_t, 3> column = {4, 0, 3};
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> sum;
    multiply_row(blocks.data(), column.data(), 3, x.data(), sum.data());
    Block expected = Block::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        expected += blocks.middleCols<6>(6 * static_cast<Index>(k)) * x.middleRows<6>(6 * column.at(k));
    }
    EXPECT_LT((sum - expected).norm(), 1e-14 * expected.norm());
}

/// Sizes that are no multiples of the six rows or columns which the kernels take at once.
TEST(SixColumnKernels, ASupernodeSolvesWithItsRowsOfTheFactor) {
    for (const auto& [columns, rows] : {std::pair(1, 0), std::pair(6, 13), std::pair(14, 5), std::pair(20, 24)}) {
        SCOPED_TRACE(std::to_string(columns) + " columns, " + std::to_string(rows) + " rows");
        using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        RowMajor lower = RowMajor::Random(columns + rows, columns);
        lower.diagonal().array() = lower.diagonal().array().abs() + 4;
        RowMajor stored = lower;
        stored.diagonal() = lower.diagonal().cwiseInverse();
        std::vector<int> row(static_cast<std::size_t>(rows));
        for (int k = 0; k < rows; ++k) {
            row[static_cast<std::size_t>(k)] = columns + 2 * k;
        }
        const SupernodeValues node{.diagonal = stored.data(),
                                   .below = stored.data() + stored.cols() * columns,
                                   .columns = columns,
                                   .rows = rows,
                                   .row = row.data()};
        std::vector<PaddedRow> all(static_cast<std::size_t>(columns + 2 * rows + 1));
        const Eigen::MatrixXf start = Eigen::MatrixXf::Random(static_cast<Index>(all.size()), 8);
        const auto reset = [&] {
            for (std::size_t k = 0; k < all.size(); ++k) {
                Eigen::Map<Eigen::Matrix<float, 8, 1>>(all[k].value.data()) = start.row(static_cast<Index>(k)).transpose();
            }
        };
        const auto at = [&](Index k) {
            return Eigen::Map<const Eigen::Matrix<float, 8, 1>>(all[static_cast<std::size_t>(k)].value.data());
        };

        const Eigen::MatrixXf square = lower.topRows(columns).triangularView<Eigen::Lower>();
        const Eigen::MatrixXf below = lower.bottomRows(rows);
        reset();
        solve_forward(node, all.data(), all.data());
        const Eigen::MatrixXf own = square.triangularView<Eigen::Lower>().solve(start.topRows(columns));
        for (Index k = 0; k < columns; ++k) {
            EXPECT_LT((at(k) - own.row(k).transpose()).norm(), 1e-5);
        }
        for (Index k = 0; k < rows; ++k) {
            EXPECT_LT((at(row[static_cast<std::size_t>(k)]).transpose() - start.row(columns + 2 * k) + below.row(k) * own).norm(),
                      1e-4);
        }

        reset();
        solve_backward(node, all.data(), all.data());
        Eigen::MatrixXf right = start.topRows(columns);
        for (Index k = 0; k < rows; ++k) {
            right -= below.row(k).transpose() * start.row(columns + 2 * k);
        }
        const Eigen::MatrixXf back = square.transpose().triangularView<Eigen::Upper>().solve(right);
        for (Index k = 0; k < columns; ++k) {
            EXPECT_LT((at(k) - back.row(k).transpose()).norm(), 1e-4);
        }
    }
}

}  // namespace
}  // namespace coagula::mechanics
