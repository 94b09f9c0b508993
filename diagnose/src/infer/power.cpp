// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/power.hpp>
#include <coagula/diagnose/waveform.hpp>

#include "chain/forward.hpp"
#include "noise/error_model.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr int coarse_points = 9;  ///< over the whole range, to find where the threshold lies
constexpr int fine_points = 8;    ///< across it
constexpr double half = 0.5;
constexpr double most = 0.95;

bool is_planned(const Column& column) {
    return column.name == "storage_modulus" || column.name == "loss_modulus" || column.name.starts_with("third_harmonic");
}

/// The columns that are to be measured.
std::vector<std::string> planned_columns(const Measurement& table) {
    if (table.kind == MeasurementKind::harmonics) {
        return {"third_harmonic_storage", "third_harmonic_loss"};
    }
    const bool series = table.kind == MeasurementKind::structure_series;
    const bool storage = series || find_column(table, "storage_modulus") != nullptr;
    return storage && find_column(table, "loss_modulus") == nullptr ? std::vector<std::string>{"storage_modulus"}
                                                                    : std::vector<std::string>{"storage_modulus", "loss_modulus"};
}

/// The tables of moduli and of third harmonics with a number in every cell that is to be measured.
Experiment prepared(Experiment experiment) {
    ErrorSpec none;
    reduce_waveforms(experiment, none, 0, 0);
    auto& tables = experiment.measurements;
    std::erase_if(tables,
                  [](const Measurement& table) { return !has_moduli(table.kind) && table.kind != MeasurementKind::harmonics; });
    for (Measurement& table : tables) {
        const std::vector<std::string> names = planned_columns(table);
        std::erase_if(table.columns, is_planned);
        if (axis_of(table) == nullptr) {
            throw InputError(table.label + ": a planned " + std::string(name_of(table.kind)) + " needs its axis");
        }
        const std::vector<double> ones(table.rows(), 1.0);
        for (const std::string& name : names) {
            table.columns.push_back({name, std::string(find_quantity(name)->unit), ones});
        }
    }
    if (std::none_of(tables.begin(), tables.end(), [](const Measurement& table) { return has_moduli(table.kind); })) {
        throw InputError(
            "the experiment plans no table of moduli: a frequency, amplitude or time sweep, a gap series or a structure series");
    }
    return experiment;
}

/// A draw gives tables as they would be measured, and the errors that one would know of them.
struct Drawn {
    Experiment experiment;
    ErrorSpec errors;
};

/// Draws data sets of a planned experiment.
class Planned {
public:
    Planned(Experiment experiment, Simulator& simulator, const PowerOptions& options)
        : experiment_(std::move(experiment)),
          observations_(observations_of(experiment_)),
          forward_(experiment_, observations_, simulator),
          options_(options) {}

    const Experiment& experiment() const { return experiment_; }
    const std::vector<Observation>& observations() const { return observations_; }
    Eigen::VectorXd expected(const Model& model) const { return forward_.predict(model); }

    /// Returns what would be measured where the truth is `expected`, with errors and effects of the samples.
    Drawn draw(const Eigen::VectorXd& expected, std::uint64_t number) const;

private:
    Drawn with_values(const Eigen::VectorXd& values) const;

    Experiment experiment_;
    std::vector<Observation> observations_;
    Forward forward_;
    const PowerOptions& options_;
};

/// The planned tables with these numbers.
Drawn Planned::with_values(const Eigen::VectorXd& values) const {
    Drawn drawn{experiment_, options_.diagnosis.errors};
    put_values(observations_, values, drawn.experiment);
    drawn.errors.tables.clear();
    for (const Measurement& table : drawn.experiment.measurements) {
        drawn.errors.tables.push_back(planned_errors(table, options_.noise));
    }
    return drawn;
}

Drawn Planned::draw(const Eigen::VectorXd& expected, std::uint64_t number) const {
    constexpr std::uint64_t first_step = 5000000;  // beyond those of bootstrap, gain and proposal
    const Drawn truth = with_values(expected);
    DataSet data = data_set_of(truth.experiment, truth.errors);
    data.noise.widen(forward_.structure_deviation(expected));  // of what is measured from what is simulated
    return with_values(ErrorModel(data).drawn_about(expected, options_.diagnosis.seed, first_step + number));
}

/// In how many data sets, drawn about these expectations, the base model is found to fail.
Share found_in(int data_sets, const Planned& planned, const Eigen::VectorXd& expected, Simulator& simulator,
               const DiagnosisOptions& options) {
    DiagnosisOptions test_only = options;
    test_only.level = 0;  // no p-value is as small, so that the diagnosis ends with the test
    int found = 0;
    for (int k = 0; k < data_sets; ++k) {
        const Drawn drawn = planned.draw(expected, static_cast<std::uint64_t>(k));
        test_only.errors = drawn.errors;
        test_only.seed = options.seed + static_cast<std::uint64_t>(k);  // or all share the errors of one bootstrap
        found += diagnose(drawn.experiment, simulator, test_only).p_value <= options.level ? 1 : 0;
    }
    return share_of(found, data_sets);
}

/// Searches the strengths of one cause.
class Search {
public:
    Search(const Planned& planned, Simulator& simulator, const PowerOptions& options, const Mechanism& mechanism, double stiffness)
        : planned_(planned), simulator_(simulator), options_(options), mechanism_(mechanism), stiffness_(stiffness) {}

    CausePower run() const;

private:
    const MechanismParameter& strength() const { return mechanism_.parameters.front(); }
    Model truth_at(double value) const {
        std::vector<double> values{value};
        for (std::size_t k = 1; k < mechanism_.parameters.size(); ++k) {
            values.push_back(mechanism_.parameters[k].at(0.5));
        }
        return {{&mechanism_}, values, stiffness_};
    }
    PowerPoint measure(double place, int data_sets) const;
    std::vector<PowerPoint> curve() const;
    NamingRuns name(double value) const;

    const Planned& planned_;
    Simulator& simulator_;
    const PowerOptions& options_;
    const Mechanism& mechanism_;
    double stiffness_;
};

PowerPoint Search::measure(double place, int data_sets) const {
    const double value = strength().at(place);
    return {value, found_in(data_sets, planned_, planned_.expected(truth_at(value)), simulator_, options_.diagnosis)};
}

double part(const PowerPoint& point) {
    return static_cast<double>(point.found.count) / point.found.of;
}

/// Where, coming from the strong end, a share first falls below a probability; interpolated in the logarithm of the strength
/// where that is positive.
/// @param points weak to strong. @param shares of them.
double crossing(const std::vector<PowerPoint>& points, double probability, const std::vector<double>& shares) {
    if (shares.back() < probability) {
        return unset;
    }
    for (std::size_t k = points.size() - 1; k > 0; --k) {
        if (shares[k - 1] < probability) {
            const double way = (probability - shares[k - 1]) / (shares[k] - shares[k - 1]);
            const double weak = points[k - 1].strength;
            const double strong = points[k].strength;
            return weak > 0 ? weak * std::pow(strong / weak, way) : weak + way * (strong - weak);
        }
    }
    return points.front().strength;  // found over the whole range
}

Threshold threshold(const std::vector<PowerPoint>& points, double probability) {
    std::vector<double> shares;
    std::vector<double> low;
    std::vector<double> high;
    for (const PowerPoint& point : points) {
        shares.push_back(part(point));
        // What is stronger is found at least as often, so that a bound holds for all that is stronger, or weaker.
        low.push_back(std::max(low.empty() ? 0.0 : low.back(), point.found.low));
        high.push_back(point.found.high);
    }
    for (std::size_t k = high.size() - 1; k > 0; --k) {
        high[k - 1] = std::min(high[k - 1], high[k]);
    }
    Threshold found{.value = crossing(points, probability, shares)};
    const bool rising = points.back().strength > points.front().strength;
    (rising ? found.low : found.high) = crossing(points, probability, high);
    (rising ? found.high : found.low) = crossing(points, probability, low);
    return found;
}

NamingRuns Search::name(double value) const {
    NamingRuns result{.strength = value};
    const Eigen::VectorXd expected = planned_.expected(truth_at(value));
    DiagnosisOptions whole = options_.diagnosis;
    const CauseSet truth = Hypothesis{&mechanism_};
    for (; result.runs < options_.diagnoses; ++result.runs) {
        const Drawn drawn = planned_.draw(expected, 100000 + static_cast<std::uint64_t>(result.runs));
        whole.errors = drawn.errors;
        const Diagnosis found = diagnose(drawn.experiment, simulator_, whole);
        const auto& set = found.credible_set;
        const bool inside = std::find(set.begin(), set.end(), truth) != set.end();
        result.missed += found.verdict == Verdict::no_discrepancy ? 1 : 0;
        result.none += found.verdict == Verdict::none_of_catalogue ? 1 : 0;
        const bool answered = found.verdict == Verdict::named || found.verdict == Verdict::tied;
        result.named += answered && inside && set.size() == 1 ? 1 : 0;
        result.tied += answered && inside && set.size() > 1 ? 1 : 0;
        result.misnamed += answered && !inside ? 1 : 0;
        for (const CauseSet& other : set) {
            result.rivals[name_of(other)] += answered && other != truth ? 1 : 0;
        }
    }
    std::erase_if(result.rivals, [](const auto& entry) { return entry.second == 0; });
    return result;
}

/// Few data sets at strengths over the whole range, many across the threshold. Weak to strong.
std::vector<PowerPoint> Search::curve() const {
    const int few = std::max(20, options_.data_sets / 5);
    std::vector<double> places;
    std::vector<PowerPoint> points;
    for (int k = 0; k < coarse_points; ++k) {
        places.push_back(static_cast<double>(k) / (coarse_points - 1));
        points.push_back(measure(places.back(), few));
    }
    if (part(points.front()) > part(points.back())) {
        std::reverse(places.begin(), places.end());
        std::reverse(points.begin(), points.end());
    }
    if (part(points.back()) < 0.3) {  // not even there
        points.back() = measure(places.back(), options_.data_sets);
        return points;
    }
    std::size_t strong = points.size() - 1;  // from here on nearly all is found
    while (strong > 0 && part(points[strong - 1]) > 0.99) {
        --strong;
    }
    if (strong == 0) {
        return points;
    }
    std::size_t weak = strong - 1;  // here little
    while (weak > 0 && part(points[weak]) > 0.3) {
        --weak;
    }
    std::vector<PowerPoint> all(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(weak));
    for (int k = 0; k <= fine_points; ++k) {
        const double way = static_cast<double>(k) / fine_points;
        all.push_back(measure(places[weak] * (1 - way) + places[strong] * way, options_.data_sets));
    }
    all.insert(all.end(), points.begin() + static_cast<std::ptrdiff_t>(strong) + 1, points.end());
    return all;
}

CausePower Search::run() const {
    CausePower power{.name = mechanism_.name, .parameter = strength().name, .unit = strength().unit};
    power.range_low = strength().low;
    power.range_high = strength().high;
    for (std::size_t k = 1; k < mechanism_.parameters.size(); ++k) {
        power.others[mechanism_.parameters[k].name] = mechanism_.parameters[k].at(0.5);
    }
    power.curve = curve();
    power.half = threshold(power.curve, half);
    power.most = threshold(power.curve, most);
    if (std::isfinite(power.half.value)) {
        power.naming = name(std::isfinite(power.most.value) ? power.most.value : power.curve.back().strength);
    }
    return power;
}

}  // namespace

Share share_of(int count, int of) {
    constexpr double z = 1.959964;
    const double n = of;
    const double p = count / n;
    const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
    const double half_width = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    return {count, of, count == 0 ? 0.0 : centre - half_width, count == of ? 1.0 : centre + half_width};
}

Power find_power(const Experiment& experiment, Simulator& simulator, const PowerOptions& given, const Progress& progress) {
    if (experiment.material.kind != MaterialKind::network) {
        throw InputError("a plan needs a simulated network, but material.kind is '" +
                         std::string(name_of(experiment.material.kind)) + "'");
    }
    PowerOptions options = given;
    options.diagnosis.errors.sample = given.noise.sample;
    const Planned planned(prepared(experiment), simulator, options);
    require_causes(options.causes);
    Power power;
    Settings base;
    const double modulus = exact_linear_modulus(simulator, base);
    power.storage_modulus = std::isfinite(options.storage_modulus) ? options.storage_modulus : modulus;
    base.normal_stiffness *= power.storage_modulus / modulus;
    power.normal_stiffness = base.normal_stiffness;
    const auto& observations = planned.observations();
    power.moduli = static_cast<std::size_t>(std::count_if(observations.begin(), observations.end(), is_modulus_or_viscosity));
    power.third_harmonics = observations.size() - power.moduli;

    power.by_chance = found_in(options.data_sets, planned, planned.expected(base), simulator, options.diagnosis);

    double done = 0;
    for (const Mechanism& mechanism : catalogue()) {
        progress.update("simulating the experiment", done++ / static_cast<double>(catalogue().size()), mechanism.name);
        if (is_asked_for(mechanism, options.causes) && can_act(mechanism, planned.experiment())) {
            power.causes.push_back(Search(planned, simulator, options, mechanism, base.normal_stiffness).run());
        }
    }
    return power;
}

}  // namespace coagula::diagnose
