// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of a quasi-static run; see checkpoint_edits.hpp and hdf5_edits.hpp for what the input is.
#include "checkpoint_edits.hpp"
#include "quasistatic_checkpoint.hpp"

namespace {

using namespace coagula;
using stages::QuasistaticTest;

/// A small file as the program writes it.
std::string sound_file(const fuzz::InputFolder& folder) {
    QuasistaticTest ramp{{2, 0}, {}, {}};
    ramp.ramp.points.resize(3);
    ramp.ramp.broken = {{1, 0.5, BreakageCause::pull_off, true, 0}};
    ramp.ramp.failure = mechanics::NetworkFailure{0.5, 1, true};
    QuasistaticTest sweep{{0, 1}, {}, {}};
    sweep.sweep.amplitudes.resize(2);
    const std::string path = folder.write("sound.h5", "");
    stages::write_quasistatic_checkpoint(path, "run", {ramp, sweep});
    return fuzz::contents_of(path);
}

void check_test(const QuasistaticTest& test) {
    const auto is_axis = [](int axis) { return axis >= 0 && axis < 3; };
    fuzz::expect(is_axis(test.orientation.normal) && is_axis(test.orientation.direction), "an axis does not exist");
    for (const mechanics::StrainPoint& point : test.ramp.points) {
        fuzz::expect(std::isfinite(point.strain) && point.stress.allFinite(), "an equilibrium is not finite");
    }
    for (const mechanics::AmplitudeResponse& amplitude : test.sweep.amplitudes) {
        fuzz::expect(std::isfinite(amplitude.storage_modulus), "a modulus is not finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    static const std::string sound = sound_file(folder);
    fuzz::read_edited_checkpoint(folder, sound, fuzz::Choices(data, size), [](const std::string& path) {
        for (const QuasistaticTest& test : stages::read_quasistatic_checkpoint(path, "run")) {
            check_test(test);
        }
    });
    return 0;
}
