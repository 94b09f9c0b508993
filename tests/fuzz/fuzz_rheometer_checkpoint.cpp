// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of an explicit rheometer run; see checkpoint_edits.hpp and hdf5_edits.hpp for what the input is.
#include "checkpoint_edits.hpp"
#include "rheometer_checkpoint.hpp"

namespace {

using namespace coagula;
using mechanics::RheometerCheckpoint;
using mechanics::RheometerRun;

RheometerRun small_run() {
    RheometerRun run;
    run.orientation = {2, 0};
    run.oscillations.resize(1);
    run.strain = run.stress = run.plate_stress = {0, 1, 2};
    run.sphere_stress = Eigen::MatrixXd::Ones(3, 2);
    run.sphere_storage = Eigen::VectorXd::Ones(2);
    run.broken = {{0, 1, 0.5, 0, BreakageCause::pull_off}};
    return run;
}

/// A small file as the program writes it.
std::string sound_file(const fuzz::InputFolder& folder) {
    RheometerCheckpoint checkpoint{{small_run()}, small_run(), {}};
    dem::ParticleState& state = checkpoint.state;
    for (auto* vectors : {&state.position, &state.velocity, &state.spin, &state.turn, &state.force, &state.moment}) {
        vectors->assign(3, dem::Quad::Ones());
    }
    state.inverse_mass = state.inverse_inertia = {1, 2, 3};
    state.bonds.resize(2);
    state.bonds[0].second = 1;
    const std::string path = folder.write("sound.h5", "");
    stages::write_checkpoint(path, "run", checkpoint);
    return fuzz::contents_of(path);
}

void check_run(const RheometerRun& run) {
    const auto is_axis = [](int axis) { return axis >= 0 && axis < 3; };
    fuzz::expect(is_axis(run.orientation.normal) && is_axis(run.orientation.direction), "a run has an axis that does not exist");
    fuzz::expect(run.orientation.normal != run.orientation.direction, "a run has one axis twice");
    fuzz::expect(run.strain.size() == run.stress.size(), "stresses and strains are not as many");
    fuzz::expect(run.plate_stress.empty() || run.plate_stress.size() == run.strain.size(), "stresses of the plate are not as many");
}

void check_checkpoint(const RheometerCheckpoint& checkpoint) {
    for (const RheometerRun& run : checkpoint.finished) {
        check_run(run);
    }
    check_run(checkpoint.current);
    const dem::ParticleState& state = checkpoint.state;
    for (const auto* vectors : {&state.position, &state.velocity, &state.spin, &state.turn, &state.force, &state.moment}) {
        for (const dem::Quad& vector : *vectors) {
            fuzz::expect(vector.allFinite(), "a vector of the state is not finite");
        }
    }
    fuzz::expect(state.shear.direction >= 0 && state.shear.direction < 3 && state.shear.normal >= 0 && state.shear.normal < 3,
                 "the cell is sheared along an axis that does not exist");
    fuzz::expect(std::isfinite(state.shear.strain), "the strain of the cell is not finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    static const std::string sound = sound_file(folder);
    fuzz::read_edited_checkpoint(folder, sound, fuzz::Choices(data, size),
                                 [](const std::string& path) { check_checkpoint(stages::read_checkpoint(path, "run")); });
    return 0;
}
