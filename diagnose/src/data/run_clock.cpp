// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/run_clock.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double row_duration = 10;           // s, where the table has no times
constexpr double usual_pause = row_duration;  // s
constexpr double same_minute = 60;            // s; exports give no seconds

/// Whether a table is of a run on the sample. Waveforms were recorded during the sweeps.
bool is_run(const Measurement& table) {
    const bool shears = table.kind == MeasurementKind::frequency_sweep || table.kind == MeasurementKind::amplitude_sweep ||
                        table.kind == MeasurementKind::time_sweep || table.kind == MeasurementKind::gap_series ||
                        is_flow(table.kind);
    return shears && std::isnan(table.fluid_viscosity);
}

std::pair<double, double> first_and_last(const Measurement& table) {
    double first = unset;
    double last = unset;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        first = std::fmin(first, time_in(table, row));
        last = std::fmax(last, time_in(table, row));
    }
    return {first, last};
}

/// Whether the times of a table go on from those of the run before it. A clock of its own would show about one step of the table in
/// the first row; this one shows more, and no time that the run before it shows.
bool runs_on(const Measurement& before, const Measurement& table) {
    const Column* time = find_column(table, "time");
    if (find_column(before, "time") == nullptr || time == nullptr || table.rows() < 2) {
        return false;
    }
    const auto [first, last] = first_and_last(table);
    return first >= first_and_last(before).second && first > 3 * (last - first) / static_cast<double>(table.rows() - 1);
}

/// Places the runs on one sample, one after the other.
class SampleClock {
public:
    SampleClock(const Experiment& experiment, std::vector<RunTime>& times) : experiment_(experiment), times_(times) {}

    void add(std::size_t number) {
        const Measurement& table = experiment_.measurements[number];
        RunTime& time = times_[number];
        const auto [first, last] = first_and_last(table);
        time.before = before_;
        const bool stated = table.shared_clock.value_or(false);
        time.runs_on = stated || (!table.shared_clock && before_ != no_run && runs_on(experiment_.measurements[before_], table));
        time.origin = start_of(table);
        const double step = (last - first) / static_cast<double>(std::max<std::size_t>(table.rows(), 2) - 1);
        if (time.runs_on) {
            const double clock = stated || before_ == no_run ? 0 : times_[before_].origin;
            refuse_second_clock(table, clock + first - step - time.origin);
            time.origin = clock;
        }
        if (std::isfinite(table.preshear) || experiment_.sample.sheared_before) {
            sheared_ = time.origin + (time.runs_on ? first - step : 0);
        }
        time.sheared = sheared_;
        end_ = time.origin + last;
        before_ = number;
    }

private:
    static std::string place_of(const Measurement& table) { return table.label + ", sample '" + table.sample + "'"; }

    /// @param difference by which the run begins later on its clock than it would by its start [s].
    static void refuse_second_clock(const Measurement& table, double difference) {
        if (std::isfinite(table.pause)) {
            throw InputError(place_of(table) + ": 'pause' is given, but its times run on from those of the run before it; leave " +
                             "'pause' out, or say clock = \"run\"");
        }
        if (std::isfinite(table.start) && std::abs(difference) > same_minute) {
            throw InputError(place_of(table) + ": its times run on from those of the run before it, and its start is " +
                             to_text(std::abs(difference)) + " s " + (difference > 0 ? "earlier" : "later") +
                             " than they say; leave 'start' out, or say clock = \"run\"");
        }
    }

    double start_of(const Measurement& table) {
        const double rest = std::isfinite(table.pause) ? table.pause : (before_ == no_run ? 0 : usual_pause);
        const double follows = end_ + rest + (std::isfinite(table.preshear) ? table.preshear : 0);
        if (std::isnan(table.start)) {
            return follows;
        }
        if (std::isnan(first_start_)) {
            first_start_ = table.start - follows;
        }
        const double start = table.start - first_start_;
        if (std::abs(start) > longest_session) {
            throw InputError(place_of(table) +
                             ": its start and that of another run are more than a year apart: give the start of " +
                             "all of them as dates, or of all as times");
        }
        if (start < end_ - same_minute) {
            throw InputError(place_of(table) + ": begins " + to_text(end_ - start) + " s before " +
                             experiment_.measurements[before_].label + " has ended; correct 'start' or 'run_order'");
        }
        return start;
    }

    const Experiment& experiment_;
    std::vector<RunTime>& times_;
    std::size_t before_ = no_run;
    double end_ = 0;  // of the run before
    double sheared_ = 0;
    double first_start_ = unset;  // where the clock of the sample stands at zero
};

bool share_clock(const Measurement& a, const Measurement& b) {
    return a.shared_clock.value_or(false) && b.shared_clock.value_or(false);
}

/// Puts the runs into the order in which they were made: by their starts where all have one, otherwise by `run_order`.
void put_in_order(const Experiment& experiment, std::vector<std::size_t>& runs) {
    const auto& tables = experiment.measurements;
    const bool dated = std::all_of(runs.begin(), runs.end(), [&](std::size_t one) { return std::isfinite(tables[one].start); });
    std::stable_sort(runs.begin(), runs.end(), [&](std::size_t one, std::size_t other) {
        const Measurement& a = tables[one];
        const Measurement& b = tables[other];
        if (dated || a.run_order != b.run_order) {
            return dated ? a.start < b.start : a.run_order < b.run_order;
        }
        return share_clock(a, b) && first_and_last(a).first < first_and_last(b).first;
    });
}

/// Whether something says which of two runs came first.
bool are_ordered(const Measurement& a, const Measurement& b) {
    return a.run_order != b.run_order || (std::isfinite(a.start) && std::isfinite(b.start)) || share_clock(a, b);
}

}  // namespace

double time_in(const Measurement& table, std::size_t row) {
    const Column* time = find_column(table, "time");
    if (time == nullptr) {
        return row_duration * static_cast<double>(row);
    }
    const auto place = time->values.begin() + static_cast<std::ptrdiff_t>(row);
    const auto is_known = [](double value) { return std::isfinite(value); };
    const auto next = std::find_if(place, time->values.end(), is_known);
    const auto last = std::find_if(std::make_reverse_iterator(place), time->values.rend(), is_known);
    return next == place || last == time->values.rend() ? (next == time->values.end() ? unset : *next) : *last;
}

std::vector<std::size_t> rows_in_time(const Measurement& table) {
    std::vector<std::pair<double, std::size_t>> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        rows.emplace_back(time_in(table, row), row);
    }
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::size_t> order;
    std::transform(rows.begin(), rows.end(), std::back_inserter(order), [](const auto& row) { return row.second; });
    return order;
}

std::vector<RunTime> run_times(const Experiment& experiment) {
    const auto& tables = experiment.measurements;
    std::vector<RunTime> times(tables.size());
    std::map<std::string, std::vector<std::size_t>> samples;
    for (std::size_t k = 0; k < tables.size(); ++k) {
        times[k].order = tables[k].run_order;
        if (is_run(tables[k])) {
            samples[tables[k].sample].push_back(k);
        }
    }
    for (auto& [sample, runs] : samples) {
        put_in_order(experiment, runs);
        SampleClock clock(experiment, times);
        for (const std::size_t run : runs) {
            clock.add(run);
            const std::size_t before = times[run].before;
            times[run].order = before == no_run ? 0 : times[before].order + (are_ordered(tables[before], tables[run]) ? 1 : 0);
            times[run].known = std::all_of(runs.begin(), runs.end(), [&, run = run](std::size_t other) {
                return other == run || are_ordered(tables[run], tables[other]);
            });
        }
        for (std::size_t k = 0; k < tables.size(); ++k) {
            if (tables[k].kind == MeasurementKind::harmonics && tables[k].sample == sample) {
                const auto during = std::find_if(runs.begin(), runs.end(),
                                                 [&](std::size_t run) { return tables[run].run_order >= tables[k].run_order; });
                times[k] = times[during == runs.end() ? runs.back() : *during];
            }
        }
    }
    return times;
}

std::vector<DoubtfulClock> doubtful_clocks(const Experiment& experiment) {
    const std::vector<RunTime> times = run_times(experiment);
    std::vector<DoubtfulClock> doubtful;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        if (!times[k].known) {
            doubtful.push_back({table.label, table.sample, {}});
        } else if (times[k].runs_on && !table.shared_clock) {
            doubtful.push_back({table.label, table.sample, experiment.measurements[times[k].before].label});
        }
    }
    return doubtful;
}

}  // namespace coagula::diagnose
