// SPDX-License-Identifier: GPL-3.0-or-later
// The linear problem of a bonded network and its solution as files, by which a program of many processes solves it: each process
// reads and writes its part.
#pragma once

#include "linear_solution.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace coagula::mechanics {

/// A problem has bonds, and besides them what the solver needs to know.
struct LinearProblem {
    Eigen::Matrix3Xd fraction;                  ///< 3 x n, positions of the load-bearing particles in the cell, each in [0, 1)
    Eigen::Vector3d lengths;                    ///< edge lengths of the cell, any unit
    Eigen::Matrix<double, 6, 1> affine_energy;  ///< as conjugate_gradients() takes it
    double modulus_tolerance = 1e-5;            ///< relative error of the moduli at which to stop
    int most_iterations = 2000;
};

/// Throws std::runtime_error where the file cannot be written.
void write_problem(const std::filesystem::path& path, const LinearProblem& problem, const std::vector<LinearBond>& bonds);

/// A problem that lies in a file and is read where it is looked at.
class ProblemFile {
public:
    using Ends = std::array<std::int64_t, 2>;

    /// Throws std::runtime_error where the file is none.
    explicit ProblemFile(const std::filesystem::path& path);
    ~ProblemFile();
    ProblemFile(const ProblemFile&) = delete;
    ProblemFile& operator=(const ProblemFile&) = delete;

    Index particles() const { return fraction_.cols(); }
    const Eigen::Map<const Eigen::Matrix3Xd>& fraction() const { return fraction_; }
    const Eigen::Vector3d& lengths() const { return lengths_; }
    const Eigen::Matrix<double, 6, 1>& affine_energy() const { return affine_energy_; }
    double modulus_tolerance() const { return modulus_tolerance_; }
    int most_iterations() const { return most_iterations_; }
    std::span<const Ends> ends() const { return ends_; }
    LinearBond bond(std::size_t place) const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
    Eigen::Map<const Eigen::Matrix3Xd> fraction_;
    Eigen::Vector3d lengths_;
    Eigen::Matrix<double, 6, 1> affine_energy_;
    double modulus_tolerance_ = 0;
    int most_iterations_ = 0;
    std::span<const Ends> ends_;
    const double* springs_ = nullptr;
};

/// A solution has a motion, and besides it these numbers.
struct SolutionSummary {
    int iterations = 0;
    double residual = 0;
    double modulus_error = 0;
};

/// A file for the motion of so many particles, without a summary.
void create_solution(const std::filesystem::path& path, Index particles);
/// Writes the rows of some particles into that file. @param particle their places, ascending. @param motion six rows for each.
void write_motion(const std::filesystem::path& path, const std::vector<Index>& particle, const Loads& motion);
/// The last thing to be written: without it the solution is incomplete.
void write_summary(const std::filesystem::path& path, const SolutionSummary& summary);
/// Throws std::runtime_error where the file is no complete solution for so many particles.
SolvedNetwork read_solution(const std::filesystem::path& path, Index particles);

}  // namespace coagula::mechanics
