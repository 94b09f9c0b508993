// SPDX-License-Identifier: GPL-3.0-or-later
// Analysis of a waveform: moduli of the first harmonic and the third harmonic of the stress.
#pragma once

#include <coagula/diagnose/error_spec.hpp>
#include <coagula/diagnose/measurement.hpp>

#include <cstddef>
#include <optional>

namespace coagula::diagnose {

/// Part of a third harmonic to which its simulation knows it: explicit runs of two structures scatter by that.
constexpr double third_harmonic_error = 0.25;
/// Standard deviation of a part of a third harmonic over the first where nobody states it.
constexpr double unstated_harmonic_error = 5e-3;

struct WaveformHarmonics {
    double strain;             ///< amplitude of the first harmonic
    double angular_frequency;  ///< [rad/s]
    double storage_modulus;    ///< of the first harmonics of stress and strain [Pa]
    double loss_modulus;
    double
        third_harmonic;  ///< I3 / I1: amplitude of the third harmonic of the stress over the first, 0 where the response is linear
    double third_harmonic_storage;  ///< its elastic and viscous parts G3' / |G*| and G3'' / |G*|, the stress for the strain gamma_0
    double third_harmonic_loss;     ///< sin(w t) being gamma_0 sum of Gn' sin(n w t) + Gn'' cos(n w t) (Ewoldt, Hosoi and
                                    ///< McKinley 2008, J. Rheol. 52, 1427)
    double error;  ///< standard deviation of each of the two: that of the parts of the even harmonics, which are 0 where both
                   ///< directions of shear are alike
};

/// Harmonics 0 to 5 of strain and stress against time by least squares (Wilhelm 2002, Macromol. Mater. Eng. 287, 83), so that
/// samples need neither be even nor cover whole periods. Nothing where the table has no angular frequency, where its readable
/// samples do not determine the harmonics (too few of them, or less than nine tenths of a period), or where strain or stress do not
/// oscillate.
/// @param waveform table of kind waveform that has passed check_data.
std::optional<WaveformHarmonics> harmonics_of(const Measurement& waveform);

inline constexpr const char* needs_of_harmonics =
    "the waveform has no harmonics: it needs its angular frequency, at least 11 readable samples over nine tenths of a period, "
    "and a strain and a stress that oscillate";

/// Puts tables of harmonics in the place of the waveforms of an experiment, one for each sample, run and way to measure, with a row
/// per waveform: `strain`, `angular_frequency`, `third_harmonic_storage` and `third_harmonic_loss`. A quarter of the third
/// harmonic, which the simulation does not know about it, is part of their errors. Moduli are in it only where no sweep on the
/// sample has a row at that strain and frequency, for that row is the same oscillation; else its time is. Throws InputError for a
/// waveform without harmonics.
/// @param errors of the tables, among which those of the new tables take the place of those of waveforms.
/// @param relative error of a modulus. @param phase error of it [rad].
void reduce_waveforms(Experiment& experiment, ErrorSpec& errors, double relative, double phase);

/// The row of a sweep that was measured in the same oscillation as a row of a table of harmonics.
struct SweepRow {
    std::size_t measurement;
    std::size_t row;
};
std::optional<SweepRow> same_oscillation(const Experiment& experiment, const Measurement& harmonics, std::size_t row);

}  // namespace coagula::diagnose
