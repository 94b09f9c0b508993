// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_problem_file.hpp"

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

constexpr std::uint64_t problem_mark = 0x31626f7270616f63;   // "coaprob1"
constexpr std::uint64_t solution_mark = 0x316c6f7361616f63;  // "coaasol1"
constexpr std::size_t numbers_of_spring = 13;
constexpr std::size_t motion_of_particle = 36 * sizeof(double);

struct ProblemHead {
    std::uint64_t mark = problem_mark;
    std::int64_t particles = 0;
    std::int64_t bonds = 0;
    std::int64_t most_iterations = 0;
    std::array<double, 3> lengths{};
    std::array<double, 6> affine_energy{};
    double modulus_tolerance = 0;
};

struct SolutionHead {
    std::uint64_t mark = 0;  ///< solution_mark once all is written
    std::int64_t iterations = 0;
    double residual = 0;
    double modulus_error = 0;
};

template <class Value>
void put(std::ostream& file, const Value* values, std::size_t count) {
    const void* const bytes = values;
    file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count * sizeof(Value)));
}

template <class Value>
void get(std::istream& file, Value* values, std::size_t count) {
    void* const bytes = values;
    file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count * sizeof(Value)));
}

/// Values that lie in memory from this byte on.
template <class Value>
const Value* values_at(const char* byte) {
    const void* const bytes = byte;
    return static_cast<const Value*>(bytes);
}

void require_written(std::ostream& file, const std::filesystem::path& path) {
    file.flush();
    if (!file) {
        throw std::runtime_error("cannot write " + path.string() + ", by which the solver is called");
    }
}

std::fstream opened(const std::filesystem::path& path) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    require_written(file, path);
    return file;
}

std::array<double, numbers_of_spring> numbers_of(const LinearBond& bond) {
    const ContactTangent& k = bond.tangent;
    return {bond.normal.x(), bond.normal.y(), bond.normal.z(), bond.branch.x(), bond.branch.y(), bond.branch.z(), bond.first_arm,
            bond.second_arm, k.normal,        k.shear,         k.bending,       k.twisting,      k.tension};
}

}  // namespace

void write_problem(const std::filesystem::path& path, const LinearProblem& problem, const std::vector<LinearBond>& bonds) {
    std::ofstream file(path, std::ios::binary);
    ProblemHead head{.particles = problem.fraction.cols(),
                     .bonds = static_cast<std::int64_t>(bonds.size()),
                     .most_iterations = problem.most_iterations,
                     .modulus_tolerance = problem.modulus_tolerance};
    std::copy_n(problem.lengths.data(), 3, head.lengths.begin());
    std::copy_n(problem.affine_energy.data(), 6, head.affine_energy.begin());
    put(file, &head, 1);
    put(file, problem.fraction.data(), static_cast<std::size_t>(problem.fraction.size()));
    for (const LinearBond& bond : bonds) {
        const ProblemFile::Ends ends{bond.first, bond.second};
        put(file, &ends, 1);
    }
    for (const LinearBond& bond : bonds) {
        const auto numbers = numbers_of(bond);
        put(file, numbers.data(), numbers.size());
    }
    require_written(file, path);
}

struct ProblemFile::Memory {
    boost::interprocess::file_mapping file;
    boost::interprocess::mapped_region region;
};

ProblemFile::ProblemFile(const std::filesystem::path& path) : fraction_(nullptr, 3, 0) {
    namespace ipc = boost::interprocess;
    try {
        memory_ = std::make_unique<Memory>();
        memory_->file = ipc::file_mapping(path.c_str(), ipc::read_only);
        memory_->region = ipc::mapped_region(memory_->file, ipc::read_only);
    } catch (const ipc::interprocess_exception& error) {
        throw std::runtime_error(path.string() + " cannot be read: " + error.what());
    }
    const auto* const begin = static_cast<const char*>(memory_->region.get_address());
    const std::size_t size = memory_->region.get_size();
    ProblemHead head;
    std::memcpy(&head, begin, std::min(sizeof head, size));
    const auto particles = static_cast<std::size_t>(head.particles);
    const auto bonds = static_cast<std::size_t>(head.bonds);
    if (head.mark != problem_mark ||
        size != sizeof head + 3 * sizeof(double) * particles + (sizeof(Ends) + numbers_of_spring * sizeof(double)) * bonds) {
        throw std::runtime_error(path.string() + " is no problem that coagula has written");
    }
    const char* const first_end = begin + sizeof head + 3 * sizeof(double) * particles;
    const auto* const fractions = values_at<double>(begin + sizeof head);
    const auto* const ends = values_at<Ends>(first_end);
    new (&fraction_) Eigen::Map<const Eigen::Matrix3Xd>(fractions, 3, head.particles);
    ends_ = {ends, bonds};
    springs_ = values_at<double>(first_end + sizeof(Ends) * bonds);
    lengths_ = Eigen::Vector3d(head.lengths.data());
    affine_energy_ = Eigen::Matrix<double, 6, 1>(head.affine_energy.data());
    modulus_tolerance_ = head.modulus_tolerance;
    most_iterations_ = static_cast<int>(head.most_iterations);
}

ProblemFile::~ProblemFile() = default;

LinearBond ProblemFile::bond(std::size_t place) const {
    const double* const x = springs_ + numbers_of_spring * place;
    return {ends_[place][0],
            ends_[place][1],
            Eigen::Vector3d(x),
            Eigen::Vector3d(x + 3),
            x[6],
            x[7],
            {.normal = x[8], .shear = x[9], .bending = x[10], .twisting = x[11], .tension = x[12]}};
}

void create_solution(const std::filesystem::path& path, Index particles) {
    {
        std::ofstream file(path, std::ios::binary);
        const SolutionHead head;
        put(file, &head, 1);
        require_written(file, path);
    }
    std::filesystem::resize_file(path, sizeof(SolutionHead) + static_cast<std::size_t>(particles) * motion_of_particle);
}

void write_motion(const std::filesystem::path& path, const std::vector<Index>& particle, const Loads& motion) {
    std::fstream file = opened(path);
    for (std::size_t begin = 0; begin < particle.size();) {
        std::size_t end = begin + 1;
        while (end < particle.size() && particle[end] == particle[end - 1] + 1) {
            ++end;
        }
        file.seekp(
            static_cast<std::streamoff>(sizeof(SolutionHead) + static_cast<std::size_t>(particle[begin]) * motion_of_particle));
        put(file, motion.data() + 36 * begin, 36 * (end - begin));
        begin = end;
    }
    require_written(file, path);
}

void write_summary(const std::filesystem::path& path, const SolutionSummary& summary) {
    std::fstream file = opened(path);
    const SolutionHead head{.mark = solution_mark,
                            .iterations = summary.iterations,
                            .residual = summary.residual,
                            .modulus_error = summary.modulus_error};
    put(file, &head, 1);
    require_written(file, path);
}

SolvedNetwork read_solution(const std::filesystem::path& path, Index particles) {
    std::ifstream file(path, std::ios::binary);
    SolutionHead head;
    get(file, &head, 1);
    SolvedNetwork solved{.motion = Loads(6 * particles, 6), .solver = LinearSolver::external};
    get(file, solved.motion.data(), static_cast<std::size_t>(solved.motion.size()));
    if (!file || head.mark != solution_mark) {
        throw std::runtime_error("the solver left no complete solution");
    }
    solved.iterations = static_cast<int>(head.iterations);
    solved.residual = head.residual;
    solved.modulus_error = head.modulus_error;
    return solved;
}

}  // namespace coagula::mechanics
