#include "measured_text.hpp"

#include "text_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace coagula::io {

namespace {

using Entry = std::pair<std::string_view, std::string_view>;

/// Headings in lower case and what they mean. Anton Paar RheoCompass (English, German), TA Instruments TRIOS, and the symbols
/// people use. Interval and step times are not here: they start anew in each section, and which clock a sweep ran on must be said.
constexpr std::array headings = {
    Entry{"time", "time"},
    Entry{"zeit", "time"},
    Entry{"step time", "time"},
    Entry{"t", "time"},
    Entry{"shear strain", "strain"},
    Entry{"scherdeformation", "strain"},
    Entry{"deformation", "strain"},
    Entry{"strain", "strain"},
    Entry{"strain amplitude", "strain"},
    Entry{"oscillation strain", "strain"},
    Entry{"shear stress", "stress"},
    Entry{"schubspannung", "stress"},
    Entry{"stress", "stress"},
    Entry{"stress amplitude", "stress"},
    Entry{"oscillation stress", "stress"},
    Entry{"storage modulus", "storage_modulus"},
    Entry{"speichermodul", "storage_modulus"},
    Entry{"g'", "storage_modulus"},
    Entry{"loss modulus", "loss_modulus"},
    Entry{"verlustmodul", "loss_modulus"},
    Entry{"g''", "loss_modulus"},
    Entry{"g\"", "loss_modulus"},
    Entry{"complex modulus", "complex_modulus"},
    Entry{"complex shear modulus", "complex_modulus"},
    Entry{"komplexer schubmodul", "complex_modulus"},
    Entry{"|g*|", "complex_modulus"},
    Entry{"third harmonic storage", "third_harmonic_storage"},
    Entry{"third harmonic loss", "third_harmonic_loss"},
    Entry{"loss factor", "loss_tangent"},
    Entry{"verlustfaktor", "loss_tangent"},
    Entry{"tan(delta)", "loss_tangent"},
    Entry{"tan delta", "loss_tangent"},
    Entry{"phase shift angle", "phase"},
    Entry{"phasenverschiebungswinkel", "phase"},
    Entry{"phase angle", "phase"},
    Entry{"phase", "phase"},
    Entry{"raw phase", "raw_phase"},
    Entry{"angular frequency", "angular_frequency"},
    Entry{"kreisfrequenz", "angular_frequency"},
    Entry{"omega", "angular_frequency"},
    Entry{"frequency", "frequency"},
    Entry{"frequenz", "frequency"},
    Entry{"complex viscosity", "complex_viscosity"},
    Entry{"komplexe viskosität", "complex_viscosity"},
    Entry{"torque", "torque"},
    Entry{"moment", "torque"},
    Entry{"drehmoment", "torque"},
    Entry{"oscillation torque", "torque"},
    Entry{"deflection angle", "deflection"},
    Entry{"auslenkwinkel", "deflection"},
    Entry{"oscillation displacement", "deflection"},
    Entry{"deflection", "deflection"},
    Entry{"normal force", "normal_force"},
    Entry{"normalkraft", "normal_force"},
    Entry{"axial force", "normal_force"},
    Entry{"temperature", "temperature"},
    Entry{"temperatur", "temperature"},
    Entry{"gap", "gap"},
    Entry{"spaltabstand", "gap"},
    Entry{"messspalt", "gap"},
    Entry{"plate radius", "plate_radius"},
    Entry{"volume fraction", "volume_fraction"},
    Entry{"phi", "volume_fraction"},
    Entry{"heterogeneity", "heterogeneity"},
    Entry{"coordination", "coordination"},
    Entry{"coordination number", "coordination"},
    Entry{"structure", "structure"},
    Entry{"rattler fraction", "rattler_fraction"},
    Entry{"x", "x"},
    Entry{"y", "y"},
    Entry{"z", "z"},
    Entry{"frame", "frame"},
    Entry{"image", "frame"},
    Entry{"particle radius", "particle_radius"},
    Entry{"pore radius", "pore_radius"},
    Entry{"exclusion probability", "exclusion_probability"},
};

}  // namespace

std::string quantity_of_heading(std::string_view heading) {
    std::string name = lower_case(trim(heading));
    std::replace(name.begin(), name.end(), '_', ' ');
    const auto found = std::find_if(headings.begin(), headings.end(), [&](const Entry& entry) { return entry.first == name; });
    return found == headings.end() ? "" : std::string(found->second);
}

}  // namespace coagula::io
