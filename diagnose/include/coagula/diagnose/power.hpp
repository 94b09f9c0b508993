// SPDX-License-Identifier: GPL-3.0-or-later
// Before anyone measures: which causes an experiment could find, and how strong they would have to be.
#pragma once

#include <coagula/common/progress.hpp>
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <map>
#include <string>
#include <vector>

namespace coagula::diagnose {

struct PowerOptions {
    DiagnosisOptions diagnosis;            ///< of every simulated data set; its noise is that stated
    StatedNoise noise;                     ///< what the rheometer is stated to do
    double storage_modulus = unset;        ///< expected at small strain [Pa]; NaN: that of particles with the stiffness of Settings
    std::vector<std::string> causes = {};  ///< of the catalogue; empty: all that the experiment could show
    int data_sets = 200;                   ///< at each strength close to the threshold
    int diagnoses = 4;                     ///< at the strength that is found with 95 %: is the cause named, or tied? 0: not asked
};

/// A share of simulated data sets with its 95 % interval (Wilson, J. Am. Stat. Assoc. 22 (1927) 209).
struct Share {
    int count = 0;
    int of = 0;
    double low = 0;
    double high = 1;
};
Share share_of(int count, int of);

/// Rate at which the base model was found to fail at one strength of a cause.
struct PowerPoint {
    double strength = 0;
    Share found;
};

/// The strength from which on a cause is found with some probability; NaN: not within its physical range. The interval is where the
/// ends of the intervals of the shares cross that probability.
struct Threshold {
    double value = unset;
    double low = unset;
    double high = unset;
};

/// Diagnoses of data sets with a cause of one strength.
struct NamingRuns {
    double strength = 0;
    int runs = 0;
    int named = 0;                           ///< the true cause alone
    int tied = 0;                            ///< the true cause and others
    int misnamed = 0;                        ///< another cause alone, or a tie without the true one
    int none = 0;                            ///< none of the catalogue
    int missed = 0;                          ///< nothing found
    std::map<std::string, int> rivals = {};  ///< how often another cause was in the credible set
};

/// Power of the experiment for one cause.
struct CausePower {
    std::string name;
    std::string parameter;  ///< the strength
    std::string unit;
    double range_low = 0;  ///< physical range of the strength
    double range_high = 0;
    std::map<std::string, double> others = {};  ///< further parameters, in the middle of their ranges
    std::vector<PowerPoint> curve = {};         ///< weak to strong; a yield strain is strong when it is small
    Threshold half = {};                        ///< found with 50 %
    Threshold most = {};                        ///< found with 95 %
    NamingRuns naming = {};
};

struct Power {
    double storage_modulus = 0;       ///< that was expected [Pa]
    double normal_stiffness = 0;      ///< of a particle, that gives it [N/m]
    std::size_t moduli = 0;           ///< that would be measured
    std::size_t third_harmonics = 0;  ///< elastic and viscous parts of them, likewise
    Share by_chance;                  ///< found although nothing is wrong: the level, if the test is right
    std::vector<CausePower> causes;
};

/// Simulates the planned experiment with each cause of the catalogue that it can show, over the physical range of its strength, and
/// diagnoses the data. Errors: of the torque sqrt((w floor)^2 + (relative |G*|)^2), of the phase, and of a modulus alone as of the
/// torque; a factor of each sample; of a part of a third harmonic over the first 0.005 and a quarter of it. Moduli in the tables
/// are ignored; a table without a column of loss moduli plans to measure them unless it has one of storage moduli only. A table of
/// kind `harmonics` plans waveforms, of which the moduli are those of a sweep. Throws InputError when there is no table of moduli,
/// fewer than five rows, or a cause that is not in the catalogue.
Power find_power(const Experiment& experiment, Simulator& simulator, const PowerOptions& given = {}, const Progress& progress = {});

}  // namespace coagula::diagnose
