// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve.hpp"

#include "shared_vector.hpp"
#include "solvers/energy_error.hpp"
#include "solvers/schwarz.hpp"

#include <petscksp.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

using Row = EnergyError::Row;

/// Column by column over all processes.
Row dot_over_processes(const Loads& a, const Loads& b, Index own) {
    Row sum = (a.topRows(6 * own).array() * b.topRows(6 * own).array()).colwise().sum();
    sum_over_processes(sum.data(), 6);
    return sum;
}

/// The equations K x = f of six loads as PETSc calls for them.
class Equations {
public:
    Equations(const ProblemFile& problem, const Part& part)
        : own_(part.own), vectors_(part), affine_(problem.affine_energy().transpose()), error_(affine_) {
        const LinearNetwork network(static_cast<Index>(part.particle.size()), part.bonds);
        BlockMatrix upper = network.stiffness();
        rows_ = both_triangles(upper);
        network.stiffen_spins(upper);
        const SchwarzOptions options;
        schwarz_ =
            std::make_unique<SchwarzPreconditioner>(upper, rows_, part.fraction, problem.lengths(), options, Progress{},
                                                    SharedPart{.own = own_, .all = problem.particles(), .sum = sum_over_processes});
        keep_own_rows();
        loads_ = network.loads().topRows(6 * own_);
        norm_ = dot_over_processes(loads_, loads_, own_).sqrt();
        modulus_tolerance_ = problem.modulus_tolerance();
        // Loads that symmetry cancels down to rounding errors are no loads.
        for (Index column = 0; column < 6; ++column) {
            if (norm_[column] <= EnergyError::rounding * std::sqrt(affine_[column])) {
                norm_[column] = 0;
                loads_.col(column).setZero();
            }
        }
    }

    const SharedVector& vectors() const { return vectors_; }
    const Loads& loads() const { return loads_; }

    void multiply_by_matrix(Vec x, Vec y) {
        vectors_.read(x, in_);
        multiply(rows_, in_, out_);
        vectors_.write_own(out_, y);
    }

    void precondition(Vec r, Vec z) {
        vectors_.read(r, residual_);
        schwarz_->solve(residual_, out_);
        vectors_.add_up(out_, z);
    }

    /// Whether the moduli are known well enough. What motion x has gained of a column's energy is f x + r x, r the residual, which
    /// was preconditioned last.
    bool has_converged(int iteration, Vec x) {
        if (iteration == 0) {
            return (norm_ == 0).all();
        }
        vectors_.read_own(x, in_);
        const Row gained = dot_over_processes(in_, loads_, own_) + dot_over_processes(in_, residual_, own_);
        const Row gain = gained - gained_;
        settled_ = settled_ || gain.abs() <= EnergyError::rounding * gained.abs();
        error_.add(gain, norm_ > 0 && !settled_);
        gained_ = gained;
        return modulus_error() <= modulus_tolerance_;
    }
    double modulus_error() const {
        const Row left = (affine_ - gained_).max(EnergyError::rounding * affine_).max(1e-300);
        const Row of_rounding = EnergyError::rounding * gained_.abs() / left;
        return (norm_ > 0).select(settled_.select(of_rounding, error_.estimate()), 0.0).maxCoeff();
    }

    /// |f - K x| / |f|, largest over the loads.
    double relative_residual(Vec x) {
        vectors_.read(x, in_);
        multiply(rows_, in_, out_);
        const Loads left = loads_ - out_.topRows(6 * own_);
        return (norm_ > 0).select(dot_over_processes(left, left, own_).sqrt() / norm_, 0.0).maxCoeff();
    }

private:
    void keep_own_rows() {
        rows_.start.resize(static_cast<std::size_t>(own_) + 1);
        rows_.column.resize(static_cast<std::size_t>(rows_.start.back()));
        rows_.block.resize(rows_.column.size());
        rows_.block.shrink_to_fit();
    }

    Index own_;
    SharedVector vectors_;
    BlockMatrix rows_;
    std::unique_ptr<SchwarzPreconditioner> schwarz_;
    Loads loads_;
    Row norm_;
    Row affine_;
    Row gained_ = Row::Zero();
    EnergyError::Columns settled_ = EnergyError::Columns::Constant(false);  ///< gained no more than rounding errors in an iteration
    double modulus_tolerance_ = 0;
    EnergyError error_;
    Loads in_;
    Loads out_;
    Loads residual_;
};

PetscErrorCode multiply_shell(Mat matrix, Vec x, Vec y) {
    Equations* equations = nullptr;
    check(MatShellGetContext(matrix, &equations));
    equations->multiply_by_matrix(x, y);
    return 0;
}

PetscErrorCode precondition_shell(PC preconditioner, Vec r, Vec z) {
    Equations* equations = nullptr;
    check(PCShellGetContext(preconditioner, &equations));
    equations->precondition(r, z);
    return 0;
}

PetscErrorCode test_convergence(KSP solver, PetscInt iteration, PetscReal /*norm*/, KSPConvergedReason* reason, void* context) {
    Vec x = nullptr;
    check(KSPGetSolution(solver, &x));
    *reason = static_cast<Equations*>(context)->has_converged(static_cast<int>(iteration), x) ? KSP_CONVERGED_RTOL
                                                                                              : KSP_CONVERGED_ITERATING;
    return 0;
}

/// PETSc's solver of the equations.
class Solver {
public:
    Solver(Equations& equations, int most_iterations) {
        const Index numbers = equations.loads().size();
        check(MatCreateShell(PETSC_COMM_WORLD, static_cast<PetscInt>(numbers), static_cast<PetscInt>(numbers), PETSC_DETERMINE,
                             PETSC_DETERMINE, &equations, &matrix_));
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): PETSc takes all operations as functions of nothing
        check(MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply_shell)));
        check(KSPCreate(PETSC_COMM_WORLD, &solver_));
        check(KSPSetOperators(solver_, matrix_, matrix_));
        check(KSPSetType(solver_, KSPCG));
        check(KSPSetNormType(solver_, KSP_NORM_NATURAL));
        check(KSPSetTolerances(solver_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
        PC preconditioner = nullptr;
        check(KSPGetPC(solver_, &preconditioner));
        check(PCSetType(preconditioner, PCSHELL));
        check(PCShellSetContext(preconditioner, &equations));
        check(PCShellSetApply(preconditioner, precondition_shell));
        check(KSPSetConvergenceTest(solver_, test_convergence, &equations, nullptr));
        check(KSPSetFromOptions(solver_));
    }
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;
    ~Solver() {
        KSPDestroy(&solver_);
        MatDestroy(&matrix_);
    }

    /// @return iterations.
    int solve(Vec f, Vec x) {
        check(KSPSolve(solver_, f, x));
        PetscInt iterations = 0;
        check(KSPGetIterationNumber(solver_, &iterations));
        return static_cast<int>(iterations);
    }

private:
    Mat matrix_ = nullptr;
    KSP solver_ = nullptr;
};

}  // namespace

SharedSolution solve_together(const ProblemFile& problem, const Part& part) {
    check_count(problem.particles());
    Equations equations(problem, part);
    Vec f = equations.vectors().make();
    Vec x = equations.vectors().make();
    equations.vectors().write_own(equations.loads(), f);
    SharedSolution solution;
    solution.summary.iterations = Solver(equations, problem.most_iterations()).solve(f, x);
    solution.summary.modulus_error = equations.modulus_error();
    solution.summary.residual = equations.relative_residual(x);
    equations.vectors().read_own(x, solution.motion);
    check(VecDestroy(&f));
    check(VecDestroy(&x));
    if (!(solution.summary.modulus_error <= problem.modulus_tolerance())) {
        throw std::runtime_error("the iterative solver did not converge in " + std::to_string(solution.summary.iterations) +
                                 " iterations; the network is too close to losing its stiffness");
    }
    return solution;
}

}  // namespace coagula::mechanics
