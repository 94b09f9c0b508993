// The project's own simulation behind a diagnosis: moduli of the structures, cached, and the instrument in front of them.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/diagnose/settings.hpp>

#include <complex>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// Results by what was computed; a caller may keep it between diagnoses.
using SimulationCache = std::map<std::string, std::vector<double>>;

/// Moduli of some structures of one sample (mean over them and over the orientations).
///
/// `linear_modulus` and `amplitude_response` run the solvers at nodes of a grid and interpolate between them (cubic, in
/// logarithms), because a diagnosis asks thousands of times; `exact_*` run them at the values asked for.
class Simulator {
public:
    /// @param names content hashes of the structures, for the cache.
    Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
              const Progress& progress = {});

    /// G [Pa] at vanishing strain without losses.
    double linear_modulus(const Settings& settings);
    double exact_linear_modulus(const Settings& settings);

    /// G* / G at amplitude gamma_0 of a sweep that goes up in amplitude, for finite bond strength, by the explicit rheometer.
    std::complex<double> amplitude_response(const Settings& settings, double amplitude);
    /// The same for all amplitudes of one sweep in their order.
    std::vector<std::complex<double>> exact_amplitude_response(const Settings& settings, const std::vector<double>& amplitudes);

    /// G' / G at amplitude gamma_0 of Hertz contacts that are loaded at rest, G that of linear springs: equilibrium under the
    /// strain by secant stiffnesses, which depends on strain over overlap at rest alone. What unloading loses by micro-slip is not
    /// in it.
    double contact_response(const Settings& settings, double amplitude);

    double radius() const { return radius_; }

private:
    double node(double ratio, double bending, double tolerance);
    std::vector<std::complex<double>> sweep(std::size_t structure, const Settings& settings, double strength,
                                            const std::vector<double>& amplitudes);
    const std::vector<double>& strength_curve();
    double secant_modulus(std::size_t structure, double load);
    const std::vector<double>& secant_curve();

    std::vector<Packing> structures_;
    std::vector<std::string> names_;
    SimulationCache& cache_;
    Progress progress_;
    double radius_;
    std::vector<double> secant_curve_;    ///< once it has been asked for
    std::vector<double> strength_curve_;  ///< likewise
};

}  // namespace coagula::diagnose
