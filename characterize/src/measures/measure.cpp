// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/measure.hpp>

#include <coagula/common/failures.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace coagula::characterize {

namespace {

std::string path_of(const std::string& name) {
    return "/characterization/" + name;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> names_in(const std::vector<Measure>& table) {
    std::vector<std::string> names;
    names.reserve(table.size());
    for (const Measure& measure : table) {
        names.push_back(measure.name);
    }
    return names;
}

/// What every file of results says first. Of an open packing only the inner part has a volume: that of the Voronoi cells in which
/// pores were measured, if they were.
MeasureResult packing_facts(const MeasureInput& input) {
    const Packing& packing = input.packing();
    const bool inner_only = !packing.cell.is_periodic() && input.has_pores();
    const double fraction = inner_only ? 1 - input.pores().void_fraction : volume_fraction(packing);
    const std::string meaning =
        inner_only ? "solid volume over volume in the inner Voronoi cells"
                   : std::string("solid volume over the volume of the ") + (packing.cell.is_open() ? "enclosing box" : "box");
    MeasureResult facts;
    facts.add_count("particles", packing.size(), "number of particles");
    facts.add("volume_fraction", fraction, "1", meaning);
    facts.add_vector("box", packing.cell.edge_lengths(), "m", "edge lengths of the box");
    facts.add("mean_radius", input.r0(), "m", "r0, by which reduced lengths are divided");
    facts.add_line("particles", std::to_string(packing.size()));
    facts.add_line("box", describe(packing.cell));
    facts.add_line("volume fraction", with_unit(fraction, "1") + "   (" + meaning + ")");
    return facts;
}

/// Throws unless all numbers of a result are finite.
void check_numbers(const MeasureResult& result) {
    std::vector<Dataset> all = result.datasets;
    all.insert(all.end(), result.contact_results.begin(), result.contact_results.end());
    for (const Dataset& dataset : all) {
        const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
        if (numbers != nullptr &&
            !std::all_of(numbers->begin(), numbers->end(), [](double value) { return std::isfinite(value); })) {
            throw std::runtime_error("its result " + dataset.path.substr(path_of("").size()) + " is not a finite number");
        }
    }
}

/// The outcome of all measures of a call.
class Run {
public:
    Run(const MeasureInput& input, const std::vector<std::string>& only) : input_(input), only_(only) {}

    void add(const Measure& measure) {
        input_.progress().update(measure.name, 0);
        try {
            const MeasureResult result = measure.run(input_);
            check_numbers(result);
            found_.append(result);
            ++succeeded_;
        } catch (const NotApplicable& reason) {
            if (contains(only_, measure.name)) {
                throw NotApplicable(measure.name + ": " + reason.what());
            }
            found_.leave_out(measure.name, reason.what());
        } catch (const std::invalid_argument&) {  // the packing or an option is wrong for all of them
            throw;
        } catch (const InputError&) {
            throw;
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception& error) {
            const std::string sentence = failure_sentence(error);
            found_.leave_out(measure.name, sentence);
            failure_ = failure_.empty() ? measure.name + ": " + sentence : failure_;
        }
    }

    const MeasureResult& found() const {
        if (succeeded_ == 0 && !failure_.empty()) {
            throw std::runtime_error(failure_);
        }
        return found_;
    }

private:
    const MeasureInput& input_;
    const std::vector<std::string>& only_;
    MeasureResult found_;
    std::size_t succeeded_ = 0;
    std::string failure_;  ///< the first
};

bool reads(const Measure& measure, const std::string& option) {
    return std::ranges::any_of(measure.options, [&](const MeasureOption& own) { return own.name == option; });
}

/// Names of the measures to be run. Those in `only` must not fail; the others of a default run may not apply.
/// @param given(option) whether its value is given.
template <class Given>
std::set<std::string> chosen_measures(const Given& given, const std::vector<std::string>& only, const std::vector<Measure>& table) {
    std::set<std::string> chosen;
    const bool all = contains(only, "all");
    for (const Measure& measure : table) {
        const bool by_option = !measure.when_given.empty() && given(measure.when_given);
        const bool wanted = only.empty() ? measure.by_default : contains(only, measure.name) || (all && measure.when_given.empty());
        if (wanted || by_option) {
            chosen.insert(measure.name);
            chosen.insert(measure.along.begin(), measure.along.end());
        }
    }
    return chosen;
}

}  // namespace

void MeasureResult::add(const std::string& name, double value, const std::string& unit, const std::string& description,
                        double standard_error) {
    datasets.push_back(dataset::scalar(path_of(name), value, unit, description));
    if (std::isfinite(standard_error)) {
        datasets.push_back(dataset::scalar(path_of("uncertainty/" + name), standard_error, unit,
                                           "standard error of " + name + " over structures of the same kind, from sub-volumes"));
    }
}

void MeasureResult::add_count(const std::string& name, Index value, const std::string& description) {
    datasets.push_back(dataset::integer(path_of(name), value, description));
}

void MeasureResult::add_text(const std::string& name, const std::string& value, const std::string& description) {
    datasets.push_back(dataset::text(path_of(name), value, description));
}

void MeasureResult::add_vector(const std::string& name, const Eigen::VectorXd& values, const std::string& unit,
                               const std::string& description) {
    datasets.push_back(dataset::vector(path_of(name), values, unit, description));
}

void MeasureResult::add_counts(const std::string& name, const Eigen::VectorXi& values, const std::string& description) {
    datasets.push_back(dataset::integers(path_of(name), values, description));
}

void MeasureResult::add_matrix(const std::string& name, const Eigen::MatrixXd& values, const std::string& unit,
                               const std::string& description) {
    datasets.push_back(dataset::matrix(path_of(name), values, unit, description));
}

void MeasureResult::add_field(const std::string& name, const Eigen::MatrixXd& values, const std::string& unit,
                              const std::string& description) {
    fields.push_back({name, values, unit, description});
}

void MeasureResult::add_line(const std::string& label, const std::string& text) {
    lines.emplace_back(label, text);
}

void MeasureResult::append(const MeasureResult& other) {
    datasets.insert(datasets.end(), other.datasets.begin(), other.datasets.end());
    contact_results.insert(contact_results.end(), other.contact_results.begin(), other.contact_results.end());
    fields.insert(fields.end(), other.fields.begin(), other.fields.end());
    lines.insert(lines.end(), other.lines.begin(), other.lines.end());
}

void MeasureResult::leave_out(const std::string& measure, const std::string& reason) {
    add_text("left_out/" + measure, reason, "why the last characterization found nothing for this measure");
    add_line(measure, "left out: " + reason);
}

std::string MeasureResult::reason_left_out(const std::string& measure) const {
    const std::string path = path_of("left_out/" + measure);
    const auto found = std::find_if(datasets.begin(), datasets.end(), [&](const Dataset& one) { return one.path == path; });
    return found == datasets.end() ? std::string{} : std::get<std::string>(found->values);
}

double MeasureResult::value(const std::string& name) const {
    for (const Dataset& dataset : datasets) {
        const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
        if (numbers != nullptr && dataset.shape.empty() && dataset.path == path_of(name)) {
            return numbers->front();
        }
    }
    return unset;
}

std::vector<std::string> measure_names() {
    return names_in(measures());
}

std::vector<MeasureOption> measure_options() {
    std::vector<MeasureOption> options;
    for (const Measure& measure : measures()) {
        for (const MeasureOption& option : measure.options) {
            if (std::none_of(options.begin(), options.end(),
                             [&](const MeasureOption& other) { return other.name == option.name; })) {
                options.push_back(option);
            }
        }
    }
    return options;
}

void check_options(const std::vector<std::string>& given, const std::vector<std::string>& only) {
    const std::set<std::string> chosen =
        chosen_measures([&](const std::string& option) { return contains(given, option); }, only, measures());
    for (const std::string& option : given) {
        std::vector<std::string> readers;
        for (const Measure& measure : measures()) {
            if (reads(measure, option)) {
                readers.push_back(measure.name);
            }
        }
        require(std::ranges::any_of(readers, [&](const std::string& reader) { return chosen.contains(reader); }),
                option + " is read by the measure " + list_of(readers) + ", which is not among those of this call: name " +
                    (readers.size() > 1 ? "one of them" : "it") + " with --only, or leave the option out");
    }
}

MeasureResult run_measures(const MeasureInput& input, const std::vector<std::string>& only, const std::vector<Measure>& table) {
    const std::vector<std::string> names = names_in(table);
    for (const std::string& name : only) {
        require(name == "all" || contains(names, name), "'" + name + "' is not one of " + list_of(names));
    }
    const std::set<std::string> chosen =
        chosen_measures([&](const std::string& option) { return input.given(option); }, only, table);
    Run run(input, only);
    for (const Measure& measure : table) {
        if (chosen.contains(measure.name)) {
            run.add(measure);
        }
    }
    MeasureResult result = packing_facts(input);
    result.append(run.found());
    return result;
}

}  // namespace coagula::characterize
