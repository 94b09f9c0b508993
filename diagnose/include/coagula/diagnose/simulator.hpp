// The project's own simulation behind a diagnosis: moduli of the structures, cached, and the instrument in front of them.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/structure_source.hpp>
#include <coagula/diagnose/yield_curves.hpp>

#include <Eigen/Core>

#include <array>
#include <complex>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// Results by what was computed; a caller may keep it between diagnoses.
using SimulationCache = std::map<std::string, std::vector<double>>;

/// Modulus G at one amplitude after bonds have broken.
struct Yielded {
    std::complex<double> first;  ///< G* / G in the first oscillation
    double settled = 0;          ///< G' / G in the next one, in which nothing breaks any more
};

struct HertzScatter;

/// Moduli of some structures of one sample (mean over them and over the orientations).
///
/// `linear_modulus` and `amplitude_response` run the solvers at nodes of a grid and interpolate between them (cubic, in
/// logarithms), because a diagnosis asks thousands of times; `exact_*` run them at the values asked for.
class Simulator {
public:
    /// @param names content hashes of the structures, for the cache. @param groups of each structure, from 1 (see Experiment), or
    /// empty.
    Simulator(std::vector<Packing> structures, std::vector<std::string> names, SimulationCache& cache,
              const Progress& progress = {}, std::vector<std::size_t> groups = {});

    /// Lets structures be made again and pores be measured by other stages.
    void use(OtherStages stages);

    /// The same simulation with structures that have this changed. They are made when something is asked of them that the cache
    /// does not know. `linear_modulus`, `neighbours` and `exclusion_probability` ask it by themselves at nodes of a grid; all else
    /// is that of the structures as they were given. Throws std::invalid_argument where no recipe can make them.
    Simulator& remade(const StructureChange& change);

    /// G [Pa] at vanishing strain without losses, mean over the structures of a group; group 0: over all.
    double linear_modulus(const Settings& settings, std::size_t group = 0);
    double exact_linear_modulus(const Settings& settings, std::size_t group = 0);

    /// Standard deviation of the mean of a group that so few structures leave, over that mean: the scatter between structures of
    /// one group at the base settings, pooled over the groups, over the root of their number. Where no group has two structures,
    /// that between the three shear planes of one structure takes its place.
    double structure_error(std::size_t group = 0);

    /// Mean number of particles of the structures of a group.
    double particles(std::size_t group = 0) const;

    /// Mean volume fraction of the structures of a group.
    double volume_fraction(std::size_t group = 0);
    /// Slope of the logarithm of the linear modulus over that of the volume fraction, by least squares over all structures that
    /// bear a load; 0 where their volume fractions do not differ by a hundredth.
    double volume_fraction_exponent(const Settings& settings, bool exact = false);

    /// G* / G in the first oscillation of this amplitude for finite bond strength, where `before` was the largest before on the
    /// sample (0: none), by the explicit rheometer. A bond breaks once: at an amplitude not above that, nothing is lost any more.
    /// That of a large sample as the structures tell it comes first (src/responses/population_curve.hpp), then the same moved by
    /// each of the independent standard errors that so few structures leave; these are missing where there is one structure or
    /// nothing breaks.
    Eigen::VectorXcd amplitude_response(const Settings& settings, double before, double amplitude);
    /// Degrees of freedom from which the common scale of these errors is known.
    double yield_degrees() const;
    /// The mean over the structures alone, by a run at these amplitudes, each larger than the one before.
    std::vector<Yielded> exact_amplitude_response(const Settings& settings, const std::vector<double>& amplitudes);
    /// The same run as a curve, for parts of the sample whose strains lie between. Where amplitudes are far from each other, there
    /// are more nodes.
    YieldCurves exact_yield_curve(const Settings& settings, const std::vector<double>& amplitudes);

    /// G' / G at amplitude gamma_0 of Hertz contacts that are loaded at rest, G that of linear springs: equilibrium under the
    /// strain by secant stiffnesses, which depends on strain over overlap at rest alone. What unloading loses by micro-slip is not
    /// in it.
    double contact_response(const Settings& settings, double amplitude);

    /// What more structures could change in it, over it, by each independent standard error (src/responses/hertz_scatter.hpp).
    Eigen::RowVectorXd contact_errors(const Settings& settings, double amplitude);
    /// Degrees of freedom from which their common scale is known.
    double contact_degrees();

    /// The same as contact_response for the stress over the strain at a momentary strain.
    double contact_secant(const Settings& settings, double strain);

    /// G' / G of bonds that break while the strain amplitude x sin(phase) runs for the first time, `before` being the largest
    /// before: in each quarter of that oscillation where |sin(phase)| is `sine`.
    std::array<double, 4> storage_while_breaking(const Settings& settings, double before, double amplitude, double sine);

    /// G* / G at an angular frequency [rad/s] of particles on which the solvent drags, by the frequency solver; what the
    /// contacts lose beside their springs is in both.
    std::complex<double> drag_response(const Settings& settings, double angular_frequency, std::size_t group = 0);
    /// What more structures would add to the logarithm of that less 1 (src/responses/drag_scatter.hpp): what is expected, then each
    /// independent standard error; as many for every group of structures and for all of them together, 0 for those of other groups.
    Eigen::RowVectorXcd drag_excess(const Settings& settings, double angular_frequency, std::size_t group = 0);
    /// Degrees of freedom from which their common scale is known.
    double drag_degrees();
    std::complex<double> exact_drag_response(const Settings& settings, double angular_frequency, std::size_t group = 0);

    /// G under a tension in all contacts over G without it, at vanishing strain.
    double prestress_response(const Settings& settings, std::size_t group = 0);
    double exact_prestress_response(const Settings& settings, std::size_t group = 0);

    /// G without a share of the contacts, missing at random, over G with all of them, at vanishing strain: between nodes for the
    /// contacts of the base model, or for those of the settings. A thousandth at least, where nothing bears a load.
    double thinned_response(double missing, std::size_t group = 0);
    double exact_thinned_response(const Settings& settings, double missing, std::size_t group = 0);

    /// Mean number of neighbours of a particle in a shell of distance (src/observables/neighbour_shells.hpp) as measured
    /// coordinates would show it, mean over the structures.
    double neighbours(const Settings& settings, std::size_t shell, bool exact = false);
    /// Errors of these that so few structures leave open, as independent standard errors: shells x errors.
    Eigen::MatrixXd neighbour_errors_of_structures();
    /// Those that dense and thin places give an image of so many centres, beside those of independent pairs, likewise.
    /// @param mutual share of the neighbours that are centres, too.
    Eigen::MatrixXd neighbour_errors_of_image(double centres, double mutual);

    /// What images of the same particles differ by, which no structure enters but through wrong matches: standard deviations of a
    /// centre in the plane and along z over the diameter, and the share of the centres that the next image does not have
    /// (src/observables/repeated_images.hpp).
    std::array<double, 3> repeated_images(const Settings& settings, bool exact = false);

    /// Probability that a point of the void space is farther than this [m] from the nearest particle surface, as measured
    /// coordinates would show it, mean over the structures.
    double exclusion_probability(const Settings& settings, double pore_radius, bool exact = false);
    /// How this scatters between structures with this change, as independent standard errors of one of them: radii x errors, as
    /// many whatever the change.
    Eigen::MatrixXd pore_errors(const StructureChange& change, const std::vector<double>& pore_radii);

    std::size_t structures() const { return structures_.size(); }

    double radius() const { return radius_; }

private:
    Simulator(Structures structures, std::vector<std::string> names, SimulationCache& cache, Progress progress,
              std::vector<std::size_t> groups, double radius);
    double over_changes(const StructureChange& change, const std::function<double(Simulator&)>& asked);
    Eigen::MatrixXd over_changes(const StructureChange& change, const std::function<Eigen::MatrixXd(Simulator&)>& asked);
    const Eigen::MatrixXd& pore_covariance();
    PoreCurve measured_pores(const Packing& packing) const;
    const PoreCurve& pore_curve(std::size_t structure);
    double mean_exclusion_probability(double pore_radius);
    const PoreCurve& imaged_pores(const std::array<double, 4>& errors);
    double change_in_images(const Settings& settings, double pore_radius, double probability, bool exact);
    std::vector<std::size_t> members(std::size_t group) const;
    const std::vector<double>& linear_moduli(std::size_t structure, double ratio, double bending, double tolerance);
    double node(double ratio, double bending, double tolerance, std::size_t group);
    double scatter_between_structures();
    double exponent_node(double ratio, double bending, double tolerance);
    std::vector<Yielded> sweep(std::size_t structure, const Settings& settings, double strength,
                               const std::vector<double>& amplitudes, const Progress& progress) const;
    std::vector<std::string> run_sweeps(const Settings& settings, const std::vector<std::vector<double>>& amplitudes);
    std::vector<std::vector<Yielded>> structure_responses(const Settings& settings,
                                                          const std::vector<std::vector<double>>& amplitudes);
    std::vector<std::vector<Yielded>> nodes_of_strength_curves();
    std::vector<double> unbroken_strains(const Settings& settings);
    const YieldCurves& strength_curves();
    const std::vector<double>& secant_moduli(std::size_t structure);
    const std::vector<double>& secant_curve();
    const HertzScatter& contact_scatter();
    double prestressed_modulus(std::size_t structure, const Settings& settings);
    double thinned_modulus(std::size_t structure, const Settings& settings, double missing);
    const std::vector<double>& thinned_curve(std::size_t group);
    const std::vector<double>& drag_nodes(std::size_t structure);
    const std::vector<std::complex<double>>& drag_curve(std::size_t group);
    const std::vector<std::complex<double>>& own_drag_curve(std::size_t structure);
    const Eigen::MatrixXd& drag_excess_of(std::size_t group);
    double reduced_drag(const Settings& settings, double angular_frequency) const;
    std::vector<double> shells(double plane, double axis);
    const std::vector<double>& neighbour_spread();
    const std::vector<double>& shell_node(int plane, int axis);
    const std::vector<double>& shells_about_places();
    std::vector<double> matched_images(double plane, double axis);
    const std::vector<double>& image_node(int plane, int axis);
    std::vector<double> mean_over_structures(const std::string& what, std::size_t count, const std::vector<double>& place,
                                             const std::function<std::vector<double>(const Packing&)>& measure);

    Structures structures_;
    std::vector<std::string> names_;
    std::vector<std::size_t> groups_;
    std::set<std::size_t> distinct_groups_;                      ///< 0 where there are none
    std::map<std::size_t, double> volume_fractions_;             ///< by group
    std::map<std::array<double, 4>, double> nodes_;              ///< by ratio, bending, tolerance and group
    std::map<std::array<double, 3>, double> exponents_;          ///< of the volume fraction, by ratio, bending and tolerance
    std::map<std::size_t, std::vector<double>> thinned_curves_;  ///< by group
    std::map<std::pair<int, int>, std::vector<double>> shell_nodes_;
    std::map<std::pair<int, int>, std::vector<double>> image_nodes_;
    std::map<std::size_t, std::vector<std::complex<double>>> drag_curves_;      ///< by group
    std::map<std::size_t, std::vector<std::complex<double>>> own_drag_curves_;  ///< by structure
    std::map<std::size_t, Eigen::MatrixXd> drag_excesses_;                      ///< nodes x (expected, errors), by group
    double drag_degrees_ = 0;                                                   ///< once one of these has been asked for
    double scatter_ = -1;                                                       ///< between structures, once it has been asked for
    SimulationCache& cache_;
    Progress progress_;
    double radius_;
    OtherStages stages_;
    std::map<StructureChange, std::unique_ptr<Simulator>> remade_;
    std::map<std::size_t, PoreCurve> pore_curves_;
    std::map<std::array<double, 4>, PoreCurve> imaged_pores_;
    std::vector<double> shells_about_places_;              ///< once it has been asked for
    std::vector<double> spread_of_neighbours_;             ///< likewise
    Eigen::MatrixXd pore_covariance_;                      ///< likewise
    std::vector<double> secant_curve_;                     ///< likewise
    std::shared_ptr<const HertzScatter> contact_scatter_;  ///< likewise
    std::optional<YieldCurves> strength_curves_;           ///< likewise
};

}  // namespace coagula::diagnose
