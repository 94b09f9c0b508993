// SPDX-License-Identifier: GPL-3.0-or-later
// Time and memory of the characterization: every measure, the exact pore curve, Voronoi volumes beside voro++.
//
//     bench_characterize 8000                       random non-overlapping spheres (sequential addition, volume fraction 0.3)
//     bench_characterize 8000 unequal               the same with radii between half of theirs and all
//     bench_characterize structure.csv EDGE TILES   spheres of radius 0.25 um, centres x,y,z [m] after a header line, in a periodic
//                                                   cube [m], repeated TILES times along each axis and shaken by 1 % of the radius
#include <coagula/characterize/measure.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/random.hpp>

#include <omp.h>
#include <sys/resource.h>
#include <time.h>
#ifdef COAGULA_VOROPP
#include <voro++/voro++.hh>
#endif

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
            const Eigen::Vector3i place(tile % tiles, tile / tiles % tiles, tile / tiles / tiles);
            const Eigen::Vector3d corner = place.cast<double>();
            const Eigen::Vector3d shake = 0.01 * radius * random_normal(1, RandomPurpose::perturbation, 0, count++);
            centres.push_back(cell.wrap(centre + edge * corner + shake));
        }
    }
    if (centres.empty()) {
        throw std::runtime_error(path + " holds no centres");
    }
    return make_packing(centres, tiles * edge);
}

/// Seconds of wall clock and of the processor.
struct Seconds {
    double wall = 0;
    double processor = 0;
};

class Stopwatch {
public:
    Seconds lap() {
        const Seconds now = read();
        const Seconds passed{now.wall - start_.wall, now.processor - start_.processor};
        start_ = now;
        return passed;
    }

private:
    static double seconds_of(clockid_t clock) {
        timespec time{};
        clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    static Seconds read() { return {seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID)}; }

    Seconds start_ = read();
};

void print(const std::string& what, const Seconds& seconds, const std::string& remark = "") {
    std::printf("%-22s %8.3f %10.3f   %s\n", what.c_str(), seconds.wall, seconds.processor, remark.c_str());
}

/// Every measure that is made by default, one after the other; what several share counts for the first of them.
void time_measures(const Packing& packing) {
    const characterize::MeasureInput input(packing);
    Stopwatch stopwatch;
    Seconds all;
    for (const characterize::Measure& measure : characterize::measures()) {
        if (measure.by_default) {
            measure.run(input);
            const Seconds seconds = stopwatch.lap();
            all.wall += seconds.wall;
            all.processor += seconds.processor;
            print(measure.name, seconds);
        }
    }
    print("all of these", all);
}

void time_curve(const Packing& packing) {
    Stopwatch stopwatch;
    const double mean = characterize::measure_pores(packing).mean;
    print("pore curve, 200 radii", stopwatch.lap(), "mean " + to_text(mean / mean_radius(packing)) + " r0");
}

#ifdef COAGULA_VOROPP
/// Volumes by voro++, with about the number of particles per block that it recommends.
template <class Container>
Eigen::VectorXd volumes_by_voropp(const Packing& packing) {
    const Eigen::Vector3d lengths = packing.cell.lengths() / radius;
    const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(packing.size()) / 5)));
    Container container(0, lengths[0], 0, lengths[1], 0, lengths[2], blocks, blocks, blocks, true, true, true, 8);
    for (int i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d centre = packing.positions.col(i) / radius;
        if constexpr (std::is_same_v<Container, voro::container_poly>) {
            container.put(i, centre[0], centre[1], centre[2], packing.radii[i] / radius);
        } else {
            container.put(i, centre[0], centre[1], centre[2]);
        }
    }
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(packing.size());
    voro::c_loop_all loop(container);
    voro::voronoicell cell;
    if (loop.start()) {
        do {
            volumes[loop.pid()] = container.compute_cell(cell, loop) ? cell.volume() : 0.0;
        } while (loop.inc());
    }
    return volumes * (radius * radius * radius);
}
#endif

/// Both on one core.
void time_voronoi_volumes(const Packing& packing) {
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    Stopwatch stopwatch;
    const Eigen::VectorXd volumes = characterize::measure_voronoi_cells(packing).volumes;
    const Seconds seconds = stopwatch.lap();
    print("Voronoi volumes", seconds, "one core");
#ifdef COAGULA_VOROPP
    const Eigen::VectorXd other =
        is_monodisperse(packing) ? volumes_by_voropp<voro::container>(packing) : volumes_by_voropp<voro::container_poly>(packing);
    const Seconds other_seconds = stopwatch.lap();
    print("the same by voro++", other_seconds,
          to_text(std::round(100 * other_seconds.processor / seconds.processor) / 100) + " times as long; largest difference " +
              to_text((volumes - other).cwiseAbs().maxCoeff() / volumes.mean()) + " of the mean");
#endif
    omp_set_num_threads(threads);
}

void measure(const Packing& packing) {
    std::printf("N = %td, volume fraction %.4f, %d threads\n", packing.size(), volume_fraction(packing), omp_get_max_threads());
    std::printf("%-22s %8s %10s\n", "", "wall, s", "processor, s");
    constexpr Index most_for_all = 100000;
    if (packing.size() <= most_for_all) {
        time_measures(packing);
    }
    time_curve(packing);
    time_voronoi_volumes(packing);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-union-access): a union of the C library
    std::printf("peak memory %.2f GiB\n", static_cast<double>(usage.ru_maxrss) / 1048576);
}

/// The same centres with radii between half of the radius and all of it.
Packing with_unequal_radii(Packing packing) {
    for (Index i = 0; i < packing.size(); ++i) {
        packing.radii[i] =
            radius * (0.5 + 0.5 * random_uniform(1, RandomPurpose::perturbation, 1, static_cast<std::uint64_t>(i))[0]);
    }
    return packing;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        if (count == 2) {
            measure(random_packing(std::stoul(arguments[1])));
        } else if (count == 3 && arguments[2] == std::string("unequal")) {
            measure(with_unequal_radii(random_packing(std::stoul(arguments[1]))));
        } else if (count == 4) {
            measure(tiled_packing(arguments[1], std::stod(arguments[2]), std::stoi(arguments[3])));
        } else {
            std::cerr << "usage: bench_characterize PARTICLES [unequal] | bench_characterize structure.csv EDGE TILES\n";
            return 2;
        }
    } catch (const std::exception& error) {
        std::cerr << "bench_characterize: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
