// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_solution.hpp"

#include "linear_problem_file.hpp"
#include "solvers/block_factor.hpp"
#include "solvers/conjugate_gradients.hpp"
#include "solvers/schwarz.hpp"

#include <coagula/common/blas_threads.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace coagula::mechanics {

namespace {

constexpr double floppy_threshold = 1e-6;   // pivots below this, in contact stiffnesses, have no stiffness
constexpr double large_factor = 3e8;        // bytes; the threads of BLAS only wait for each other in smaller ones
constexpr int most_direct_iterations = 60;  // a good shift needs fewer than ten
constexpr int most_schwarz_iterations = 2000;

/// K, its loads and what solves it.
struct Problem {
    BlockMatrix full;
    BlockMatrix upper;  ///< with the free spins stiffened, for the preconditioner
    Loads loads;
    Block affine;
    Index spins = 0;
};

Problem build_problem(const LinearNetwork& network) {
    Problem problem;
    problem.upper = network.stiffness();
    problem.full = both_triangles(problem.upper);
    problem.spins = network.stiffen_spins(problem.upper);
    problem.loads = network.loads();
    problem.affine = network.affine_energy();
    return problem;
}

/// Conjugate gradients preconditioned by the factor of K + shift I stop at a residual that they carry along; the tolerance holds
/// for the true one. Where rounding errors win, the shift is larger.
std::optional<Solution> solve_until(double stop, const Problem& problem, const EliminationOrder& order,
                                    const LinearOptions& options, const Progress& progress, Index& floppy_modes) {
    const StopRule rule{.residual = stop, .energy = 0, .most_iterations = most_direct_iterations};
    for (double shift = options.shift; shift <= 1e-5; shift *= 100) {
        progress.update("factorising", 0.1);
        const CholeskyFactor factor(shifted(problem.upper, shift), order);
        if (floppy_modes < 0) {
            floppy_modes = problem.spins + factor.pivots_below(floppy_threshold);
        }
        Solution solution = conjugate_gradients(
            problem.full, problem.loads, problem.affine.diagonal(), [&](const Loads& r, Loads& z) { z = factor.solve(r); }, rule,
            progress);
        if (solution.residual <= 2 * options.tolerance) {
            return solution;
        }
    }
    return std::nullopt;
}

/// Near the tolerance modes with hardly any stiffness may move far for rounding errors alone, so that one iteration more loses what
/// the ones before have reached: then the solver stops sooner. Nothing where that is not enough either.
std::optional<Solution> solve_directly(const Problem& problem, const EliminationOrder& order, const LinearOptions& options,
                                       const Progress& progress, Index& floppy_modes) {
    const BlasThreads threads(order.predicted_memory() > large_factor ? 2 : 1);  // the bits of the factor depend on their number
    for (const double sooner : {1.0, 10.0}) {
        if (auto solution = solve_until(sooner * options.tolerance, problem, order, options, progress, floppy_modes)) {
            return solution;
        }
    }
    return std::nullopt;
}

/// Positions of the load-bearing particles in the cell, each coordinate in [0, 1).
Eigen::Matrix3Xd fractions(const Packing& packing, const LoadBearing& kept) {
    Eigen::Matrix3Xd fraction(3, static_cast<Index>(kept.particle.size()));
    for (Index place = 0; place < fraction.cols(); ++place) {
        const Eigen::Vector3d position = packing.cell.wrap(packing.positions.col(kept.particle[static_cast<std::size_t>(place)]));
        fraction.col(place) = packing.cell.fraction(position);
    }
    return fraction;
}

/// Gives the memory of `upper` back, which is not needed any more once the boxes are factorised.
Solution solve_iteratively(Problem& problem, const Packing& packing, const LoadBearing& kept, const LinearOptions& options,
                           const Progress& progress) {
    const BlasThreads threads(1);  // the boxes run in parallel, not the kernels
    const Eigen::Matrix3Xd fraction = fractions(packing, kept);
    const SchwarzPreconditioner schwarz(problem.upper, problem.full, fraction, packing.cell.edge_lengths(), SchwarzOptions{},
                                        progress);
    problem.upper = {};
    const StopRule rule{
        .residual = options.tolerance, .energy = options.modulus_tolerance, .most_iterations = most_schwarz_iterations};
    const auto precondition = [&](const Loads& r, Loads& z) { schwarz.solve(r, z); };
    const Eigen::Matrix<double, 6, 1> affine = problem.affine.diagonal();
    Solution solution = block_conjugate_gradients(problem.full, problem.loads, affine, precondition, rule, progress);
    if (!solution.converged) {
        solution = conjugate_gradients(problem.full, problem.loads, affine, precondition, rule, progress);
    }
    if (!solution.converged) {
        throw std::runtime_error("the iterative solver did not converge in " + std::to_string(solution.iterations) +
                                 " iterations; the network is too close to losing its stiffness");
    }
    return solution;
}

/// Lets another program solve the problem, which it reads from a file and answers by one.
SolvedNetwork solve_elsewhere(const LinearNetwork& network, const Packing& packing, const LoadBearing& kept,
                              const LinearOptions& options) {
    const std::filesystem::path problem = options.folder / "problem";
    const std::filesystem::path solution = options.folder / "solution";
    write_problem(problem,
                  {.fraction = fractions(packing, kept),
                   .lengths = packing.cell.edge_lengths(),
                   .affine_energy = network.affine_energy().diagonal(),
                   .modulus_tolerance = options.modulus_tolerance,
                   .most_iterations = most_schwarz_iterations},
                  network.bonds());
    options.call(problem, solution);
    return read_solution(solution, network.particles());
}

}  // namespace

SolvedNetwork solve_network(const LinearNetwork& network, const Packing& packing, const LoadBearing& kept,
                            const LinearOptions& options, const Progress& progress) {
    if (options.call) {
        return solve_elsewhere(network, packing, kept, options);
    }
    Problem problem = build_problem(network);
    const EliminationOrder order = elimination_order(problem.upper, Ordering::nested_dissection);
    SolvedNetwork solved;
    solved.predicted_memory = order.predicted_memory();
    const bool wants_direct = options.solver == LinearSolver::direct ||
                              (options.solver == LinearSolver::automatic && order.predicted_memory() <= options.memory_limit);
    std::optional<Solution> solution;
    if (wants_direct) {
        solution = solve_directly(problem, order, options, progress, solved.floppy_modes);
    }
    const bool direct = solution.has_value();
    if (!direct && options.solver == LinearSolver::direct) {
        throw std::runtime_error("the direct solver did not reach the residual " + to_text(options.tolerance) +
                                 "; the network is too close to losing its stiffness, or the tolerance is too small");
    }
    if (!direct) {  // of motions with hardly any stiffness it leaves what adds no energy
        solution = solve_iteratively(problem, packing, kept, options, progress);
    }
    solved.solver = direct ? LinearSolver::direct : LinearSolver::iterative;
    solved.motion = std::move(solution->motion);
    solved.iterations = solution->iterations;
    solved.residual = solution->residual;
    solved.modulus_error = direct ? 0.0 : solution->energy_error;
    return solved;
}

}  // namespace coagula::mechanics
