// Time and memory of the characterization.
//
//     bench_characterize 8000                       random non-overlapping spheres (sequential addition, volume fraction 0.3)
//     bench_characterize structure.csv EDGE TILES   spheres of radius 0.25 um, centres x,y,z [m] after a header line, in a periodic
//                                                   cube [m], repeated TILES times along each axis and shaken by 1 % of the radius
#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/common/random.hpp>

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace coagula;

constexpr double radius = 0.25e-6;

Packing make_packing(const std::vector<Eigen::Vector3d>& centres, double edge) {
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(edge));
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(centres.front().data(), 3, std::ssize(centres));
    packing.radii = Eigen::VectorXd::Constant(packing.size(), radius);
    return packing;
}

/// Boxes with room for one centre each, to look for overlaps with the spheres placed so far.
class Occupancy {
public:
    explicit Occupancy(double edge) : edge_(edge), boxes_(static_cast<int>(std::ceil(edge / (2 * radius / std::sqrt(3.0))))) {
        occupant_.assign(static_cast<std::size_t>(boxes_) * static_cast<std::size_t>(boxes_) * static_cast<std::size_t>(boxes_),
                         -1);
    }

    bool place(const Eigen::Vector3d& centre, std::vector<Eigen::Vector3d>& centres, const Cell& cell) {
        const Eigen::Array3i home = (centre.array() / edge_ * boxes_).cast<int>();
        for (int neighbour = 0; neighbour < 125; ++neighbour) {
            const Eigen::Array3i offset(neighbour % 5 - 2, neighbour / 5 % 5 - 2, neighbour / 25 - 2);
            const int other = occupant_[slot(home + offset)];
            if (other >= 0 &&
                cell.minimum_image(centres[static_cast<std::size_t>(other)] - centre).squaredNorm() < 4 * radius * radius) {
                return false;
            }
        }
        occupant_[slot(home)] = static_cast<int>(centres.size());
        centres.push_back(centre);
        return true;
    }

private:
    std::size_t slot(Eigen::Array3i box) const {
        for (int& index : box) {
            index = (index + boxes_) % boxes_;
        }
        const auto count = static_cast<std::size_t>(boxes_);
        return (static_cast<std::size_t>(box[2]) * count + static_cast<std::size_t>(box[1])) * count +
               static_cast<std::size_t>(box[0]);
    }

    double edge_;
    int boxes_;
    std::vector<int> occupant_;
};

Packing random_packing(std::size_t particles) {
    constexpr double volume_fraction = 0.3;
    const double edge = radius * std::cbrt(4 * 3.14159265358979324 / 3 * static_cast<double>(particles) / volume_fraction);
    const Cell cell = Cell::periodic(Eigen::Vector3d::Constant(edge));
    Occupancy occupancy(edge);
    std::vector<Eigen::Vector3d> centres;
    for (std::uint64_t trial = 0; centres.size() < particles; ++trial) {
        occupancy.place(edge * random_uniform(1, RandomPurpose::initial_position, 0, trial), centres, cell);
    }
    return make_packing(centres, edge);
}

Packing tiled_packing(const std::string& path, double edge, int tiles) {
    std::ifstream file(path);
    std::string header;
    std::getline(file, header);
    std::vector<Eigen::Vector3d> centres;
    Eigen::Vector3d centre;
    char comma = ' ';
    std::uint64_t count = 0;
    const Cell cell = Cell::periodic(Eigen::Vector3d::Constant(tiles * edge));
    while (file >> centre[0] >> comma >> centre[1] >> comma >> centre[2]) {
        for (int tile = 0; tile < tiles * tiles * tiles; ++tile) {
            const Eigen::Vector3d corner(tile % tiles, tile / tiles % tiles, tile / tiles / tiles);
            const Eigen::Vector3d shake = 0.01 * radius * random_normal(1, RandomPurpose::perturbation, 0, count++);
            centres.push_back(cell.wrap(centre + edge * corner + shake));
        }
    }
    if (centres.empty()) {
        throw std::runtime_error(path + " holds no centres");
    }
    return make_packing(centres, tiles * edge);
}

class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> seconds = now - start_;
        start_ = now;
        return seconds.count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void measure(const Packing& packing) {
    Stopwatch stopwatch;
    std::printf("N = %td, volume fraction %.4f\n", packing.size(), volume_fraction(packing));
    const auto pores = characterize::measure_pores(packing);
    const double pores_seconds = stopwatch.lap();
    std::printf("pore curve, 200 radii  %8.3f s   mean %.6f r0, largest %.4f r0, cell volume defect %.1e\n", pores_seconds,
                pores.mean / radius, pores.max / radius, pores.cell_volume_defect);
    const auto fit = characterize::fit_degree_of_heterogeneity(pores, radius);
    const double fit_seconds = stopwatch.lap();
    std::printf("fit                    %8.3f s   a = %.5f +- %.5f, b = %.5f, rms %.5f\n", fit_seconds, fit.a, fit.a_stderr, fit.b,
                fit.rms_residual);
    const auto coordination = characterize::measure_coordination(packing);
    const double coordination_seconds = stopwatch.lap();
    std::printf("coordination           %8.3f s   %.4f\n", coordination_seconds, coordination.mean);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("all                    %8.3f s   peak memory %.2f GiB\n", pores_seconds + fit_seconds + coordination_seconds,
                static_cast<double>(usage.ru_maxrss) / 1048576);
}

}  // namespace

int main(int count, char** arguments) {
    try {
        if (count == 2) {
            measure(random_packing(std::stoul(arguments[1])));
        } else if (count == 4) {
            measure(tiled_packing(arguments[1], std::stod(arguments[2]), std::stoi(arguments[3])));
        } else {
            std::cerr << "usage: bench_characterize PARTICLES | bench_characterize structure.csv EDGE TILES\n";
            return 2;
        }
    } catch (const std::exception& error) {
        std::cerr << "bench_characterize: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
