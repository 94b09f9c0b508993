// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasistatic_checkpoint.hpp"

#include <coagula/io/checkpoint_file.hpp>

#include <array>

namespace coagula::stages {

namespace {

using io::CheckpointReader;
using io::Integers;
using io::Numbers;

using mechanics::AmplitudeResponse;
using mechanics::BrokenBond;
using mechanics::NetworkFailure;
using mechanics::StrainPoint;

const std::string quasistatic_kind = "checkpoint of coagula shear --method quasistatic";

constexpr std::array point_numbers{&StrainPoint::strain,     &StrainPoint::work,     &StrainPoint::stored,
                                   &StrainPoint::dissipated, &StrainPoint::breakage, &StrainPoint::released};
constexpr std::size_t stress_numbers = 9;
constexpr std::array amplitude_numbers{&AmplitudeResponse::amplitude,      &AmplitudeResponse::storage_modulus,
                                       &AmplitudeResponse::loss_modulus,   &AmplitudeResponse::loop_area,
                                       &AmplitudeResponse::third_harmonic, &AmplitudeResponse::peak_stress,
                                       &AmplitudeResponse::balance_error};

void put_points(std::vector<io::Dataset>& all, const std::string& group, const std::vector<StrainPoint>& points) {
    Numbers numbers;
    Integers counts;
    for (const StrainPoint& point : points) {
        for (const auto number : point_numbers) {
            numbers.push_back(point.*number);
        }
        numbers.insert(numbers.end(), point.stress.data(), point.stress.data() + stress_numbers);
        counts.insert(counts.end(), {point.bonds, point.contacts});
    }
    io::put(all, group + "points", std::move(numbers));
    io::put(all, group + "point_counts", std::move(counts));
}

std::vector<StrainPoint> read_points(const CheckpointReader& file, const std::string& group) {
    const std::size_t count = file.get<Integers>(group + "point_counts").size() / 2;
    const auto& counts = file.table<Integers>(group + "point_counts", 2, count);
    const Numbers& numbers = file.finite(group + "points", point_numbers.size() + stress_numbers, count);
    std::vector<StrainPoint> points(count);
    const double* next = numbers.data();
    for (std::size_t k = 0; k < count; ++k) {
        for (const auto number : point_numbers) {
            points[k].*number = *next++;
        }
        points[k].stress = Eigen::Matrix3d::Map(next);
        next += stress_numbers;
        points[k].bonds = counts[2 * k];
        points[k].contacts = counts[2 * k + 1];
    }
    return points;
}

void put_amplitudes(std::vector<io::Dataset>& all, const std::string& group, const std::vector<AmplitudeResponse>& amplitudes) {
    Numbers numbers;
    Integers counts;
    for (const AmplitudeResponse& amplitude : amplitudes) {
        for (const auto number : amplitude_numbers) {
            numbers.push_back(amplitude.*number);
        }
        counts.insert(counts.end(), {amplitude.broken, amplitude.bonds});
    }
    io::put(all, group + "amplitudes", std::move(numbers));
    io::put(all, group + "amplitude_counts", std::move(counts));
}

std::vector<AmplitudeResponse> read_amplitudes(const CheckpointReader& file, const std::string& group) {
    const std::size_t count = file.get<Integers>(group + "amplitude_counts").size() / 2;
    const auto& counts = file.table<Integers>(group + "amplitude_counts", 2, count);
    const Numbers& numbers = file.finite(group + "amplitudes", amplitude_numbers.size(), count);
    std::vector<AmplitudeResponse> amplitudes(count);
    const double* next = numbers.data();
    for (std::size_t k = 0; k < count; ++k) {
        for (const auto number : amplitude_numbers) {
            amplitudes[k].*number = *next++;
        }
        amplitudes[k].broken = counts[2 * k];
        amplitudes[k].bonds = counts[2 * k + 1];
    }
    return amplitudes;
}

void put_broken(std::vector<io::Dataset>& all, const std::string& group, const std::vector<BrokenBond>& broken) {
    Numbers strains;
    Integers numbers;
    for (const BrokenBond& bond : broken) {
        strains.push_back(bond.strain);
        numbers.insert(numbers.end(), {bond.bond, static_cast<std::int64_t>(bond.cause), bond.follows ? 1 : 0, bond.section});
    }
    io::put(all, group + "broken_strain", std::move(strains));
    io::put(all, group + "broken", std::move(numbers));
}

std::vector<BrokenBond> read_broken(const CheckpointReader& file, const std::string& group) {
    const std::size_t count = file.get<Numbers>(group + "broken_strain").size();
    const Numbers& strains = file.finite(group + "broken_strain", 1, count);
    const auto& numbers = file.table<Integers>(group + "broken", 4, count);
    std::vector<BrokenBond> broken;
    for (std::size_t k = 0; k < count; ++k) {
        const std::int64_t* entry = &numbers[4 * k];
        const auto cause = file.whole(entry[1], 0, static_cast<std::int64_t>(BreakageCause::pull_off) + 1, "a cause of breakage");
        broken.push_back({file.small_count(entry[0], "a bond"), strains[k], static_cast<BreakageCause>(cause), entry[2] != 0,
                          file.small_count(entry[3], "an amplitude")});
    }
    return broken;
}

void put_failure(std::vector<io::Dataset>& all, const std::string& group, const std::optional<NetworkFailure>& failure) {
    io::put(all, group + "failure_strain", failure ? Numbers{failure->strain} : Numbers{});
    io::put(all, group + "failure", failure ? Integers{failure->broken, failure->parted ? 1 : 0} : Integers{});
}

std::optional<NetworkFailure> read_failure(const CheckpointReader& file, const std::string& group) {
    if (file.get<Numbers>(group + "failure_strain").empty()) {
        return std::nullopt;
    }
    const auto& numbers = file.table<Integers>(group + "failure", 2, 1);
    return NetworkFailure{file.finite(group + "failure_strain", 1, 1)[0], file.small_count(numbers[0], "a number of bonds"),
                          numbers[1] != 0};
}

std::string group_of(std::size_t number, const char* part) {
    return "/finished/" + std::to_string(number) + "/" + part;
}

}  // namespace

void write_quasistatic_checkpoint(const std::string& path, const std::string& signature,
                                  const std::vector<QuasistaticTest>& finished) {
    std::vector<io::Dataset> all = io::checkpoint_head(quasistatic_kind, signature);
    io::put(all, "/count", Integers{static_cast<std::int64_t>(finished.size())});
    for (std::size_t number = 0; number < finished.size(); ++number) {
        const QuasistaticTest& test = finished[number];
        io::put(all, group_of(number, "orientation"), Integers{test.orientation.normal, test.orientation.direction});
        put_points(all, group_of(number, "ramp_"), test.ramp.points);
        put_broken(all, group_of(number, "ramp_"), test.ramp.broken);
        put_failure(all, group_of(number, "ramp_"), test.ramp.failure);
        put_amplitudes(all, group_of(number, "sweep_"), test.sweep.amplitudes);
        put_broken(all, group_of(number, "sweep_"), test.sweep.broken);
        put_failure(all, group_of(number, "sweep_"), test.sweep.failure);
    }
    io::write_checkpoint_file(path, std::move(all));
}

std::vector<QuasistaticTest> read_quasistatic_checkpoint(const std::string& path, const std::string& signature) {
    const CheckpointReader file(path, quasistatic_kind, signature);
    constexpr std::int64_t most_orientations = 6;
    const std::int64_t count = file.whole(file.table<Integers>("/count", 1, 1)[0], 0, most_orientations + 1, "orientation");
    std::vector<QuasistaticTest> finished(static_cast<std::size_t>(count));
    for (std::size_t number = 0; number < finished.size(); ++number) {
        QuasistaticTest& test = finished[number];
        const auto& axes = file.table<Integers>(group_of(number, "orientation"), 2, 1);
        test.orientation = {file.axis(axes[0]), file.axis(axes[1])};
        test.ramp.points = read_points(file, group_of(number, "ramp_"));
        test.ramp.broken = read_broken(file, group_of(number, "ramp_"));
        test.ramp.failure = read_failure(file, group_of(number, "ramp_"));
        test.sweep.amplitudes = read_amplitudes(file, group_of(number, "sweep_"));
        test.sweep.broken = read_broken(file, group_of(number, "sweep_"));
        test.sweep.failure = read_failure(file, group_of(number, "sweep_"));
        if (test.ramp.points.empty() == test.sweep.amplitudes.empty() && !test.sweep.failure) {
            file.fail("has an orientation that no run has: the checkpoint is damaged");
        }
    }
    return finished;
}

}  // namespace coagula::stages
