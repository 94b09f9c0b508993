// What a waveform says: moduli of the first harmonic and the third harmonic of the stress.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <optional>

namespace coagula::diagnose {

struct WaveformHarmonics {
    double strain;             ///< amplitude of the first harmonic
    double angular_frequency;  ///< [rad/s]
    double storage_modulus;    ///< of the first harmonics of stress and strain [Pa]
    double loss_modulus;
    double
        third_harmonic;  ///< I3 / I1: amplitude of the third harmonic of the stress over the first, 0 where the response is linear
};

/// Harmonics 0 to 5 of strain and stress against time by least squares (Wilhelm 2002, Macromol. Mater. Eng. 287, 83), so that
/// samples need neither be even nor cover whole periods. Nothing where the table has no angular frequency, where its readable
/// samples do not determine the harmonics (too few of them, or less than nine tenths of a period), or where strain or stress do not
/// oscillate.
/// @param waveform table of kind waveform that has passed check_data.
std::optional<WaveformHarmonics> harmonics_of(const Measurement& waveform);

}  // namespace coagula::diagnose
