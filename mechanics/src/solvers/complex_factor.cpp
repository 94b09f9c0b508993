// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_factor.hpp"

#include <zmumps_c.h>

#include <mutex>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

/// MUMPS keeps state in the modules of its Fortran, so only one thread may be inside.
std::mutex& mumps_mutex() {
    static std::mutex mutex;
    return mutex;
}

enum Job : int { start = -1, finish = -2, analyse = 1, factorise_job = 2, solve_job = 3 };

constexpr int use_comm_world = -987654;  // MUMPS users' guide: MPI_COMM_WORLD of its own (dummy) MPI
constexpr int more_memory = 30;          // per cent beyond what the analysis predicts

}  // namespace

struct ComplexSymmetricFactor::Implementation {
    Implementation() {
        mumps.sym = 2;
        mumps.par = 1;
        mumps.comm_fortran = use_comm_world;
        call(start, "starting MUMPS");
        set_controls();
    }
    ~Implementation() {
        const std::lock_guard lock(mumps_mutex());
        mumps.job = finish;
        zmumps_c(&mumps);
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    mutable ZMUMPS_STRUC_C mumps{};
    std::vector<MUMPS_INT> row;
    std::vector<MUMPS_INT> column;
    std::vector<MUMPS_INT> position;
    std::vector<Complex> values;

    /// The controls of the users' guide count from 1.
    MUMPS_INT& control(int number) { return mumps.icntl[number - 1]; }

    void call(Job job, const char* what) const {
        const std::lock_guard lock(mumps_mutex());
        mumps.job = job;
        zmumps_c(&mumps);
        const int status = mumps.infog[0];
        if (status == -8 || status == -9 || status == -13 || status == -19) {
            throw std::runtime_error(std::string(what) + ": not enough memory for the frequency response");
        }
        if (status < 0) {
            throw std::runtime_error(std::string(what) + " failed (MUMPS status " + std::to_string(status) + ", " +
                                     std::to_string(mumps.infog[1]) + ")");
        }
    }

    void set_controls() {
        for (const int output : {1, 2, 3, 4}) {
            control(output) = 0;
        }
        control(6) = 0;   // no permutation by values
        control(7) = 1;   // the order of elimination is given
        control(8) = 0;   // the matrix is in reduced units: no scaling
        control(10) = 0;  // refinement is done outside, on the matrix without shift
        control(12) = 1;  // nor any other reordering for pivots
        control(14) = more_memory;
        control(28) = 1;    // sequential analysis
        mumps.cntl[0] = 0;  // no pivoting
    }
};

ComplexSymmetricFactor::ComplexSymmetricFactor(const std::vector<int>& row, const std::vector<int>& column,
                                               const std::vector<int>& permutation)
    : implementation_(std::make_unique<Implementation>()) {
    Implementation& own = *implementation_;
    ZMUMPS_STRUC_C& mumps = own.mumps;
    own.position.resize(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) {
        own.position.at(static_cast<std::size_t>(permutation[k])) = static_cast<MUMPS_INT>(k + 1);
    }
    own.row.assign(row.begin(), row.end());
    own.column.assign(column.begin(), column.end());
    for (std::size_t k = 0; k < row.size(); ++k) {
        ++own.row[k];
        ++own.column[k];
    }
    mumps.n = static_cast<MUMPS_INT>(permutation.size());
    mumps.nnz = static_cast<MUMPS_INT8>(row.size());
    mumps.irn = own.row.data();
    mumps.jcn = own.column.data();
    mumps.perm_in = own.position.data();
    own.call(analyse, "analysing the complex stiffness matrix");
}

ComplexSymmetricFactor::~ComplexSymmetricFactor() = default;

void ComplexSymmetricFactor::factorise(const std::vector<Complex>& values) {
    Implementation& own = *implementation_;
    own.values = values;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): two doubles, as std::complex is
    own.mumps.a = reinterpret_cast<ZMUMPS_COMPLEX*>(own.values.data());
    own.call(factorise_job, "factorising the complex stiffness matrix");
}

void ComplexSymmetricFactor::solve(const ComplexLoads& b, ComplexLoads& x) const {
    ZMUMPS_STRUC_C& mumps = implementation_->mumps;
    Eigen::MatrixXcd columns = b;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): likewise
    mumps.rhs = reinterpret_cast<ZMUMPS_COMPLEX*>(columns.data());
    mumps.nrhs = static_cast<MUMPS_INT>(columns.cols());
    mumps.lrhs = static_cast<MUMPS_INT>(columns.rows());
    implementation_->call(solve_job, "solving with the complex factor");
    x = columns;
}

}  // namespace coagula::mechanics
