// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribution.hpp"

#include <coagula/common/log_probability.hpp>

#include "detection.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <set>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t most_pairs = 4;
/// A best cause with a larger p-value easily passes: pairs are not tried, and few causes beside a discrepancy.
constexpr double easily_passes = 0.2;
constexpr std::size_t most_with_discrepancy = 6;
constexpr std::size_t few_with_discrepancy = 2;

template <class Weight>
std::size_t heaviest_cause(const std::vector<Compared>& all, const Weight& weight) {
    const auto best =
        std::max_element(all.begin() + 1, all.end(), [&](const Compared& a, const Compared& b) { return weight(a) < weight(b); });
    return static_cast<std::size_t>(best - all.begin());
}

/// Finds the discrepancy of the base model, and of the causes that explain most, alone or beside the discrepancy that the base
/// model has: a cause may hide behind one that makes a part of what is left over. @param most of each kind.
void find_discrepancies(const Inference& inference, std::size_t most, std::vector<Compared>& all) {
    const SmoothDepartures departures = smooth_departures(inference.errors().data().observations);
    Simulator& simulator = inference.forward().simulator();
    all.front().discrepancy = find_discrepancy(inference, all.front().fit, departures);
    const Eigen::MatrixXd& directions = all.front().discrepancy->directions;
    std::vector<std::pair<double, std::size_t>> alone;
    std::vector<std::pair<double, std::size_t>> beside;
    for (std::size_t k = 1; k < all.size(); ++k) {
        alone.emplace_back(all[k].log_weight(), k);
        beside.emplace_back(unset, k);
    }
    simulator.together(beside.size(), [&](std::size_t k) {
        const Compared& one = all[k + 1];
        beside[k].first =
            one.log_weight() + inference.apart([&](const Inference& own) { return log_factor_along(own, one.fit, directions); });
    });
    std::set<std::size_t> chosen;
    for (auto* order : {&alone, &beside}) {
        std::sort(order->rbegin(), order->rend());
        for (std::size_t place = 0; place < std::min(order->size(), most); ++place) {
            chosen.insert((*order)[place].second);
        }
    }
    const std::vector<std::size_t> numbers(chosen.begin(), chosen.end());
    simulator.together(numbers.size(), [&](std::size_t k) {
        Compared& one = all[numbers[k]];
        one.discrepancy = inference.apart([&](const Inference& own) { return find_discrepancy(own, one.fit, departures); });
    });
}

/// Causes towards which the data depart most from the best one.
Hypothesis partners_of(const Detection& left, const Hypothesis& possible, std::size_t most) {
    Hypothesis partners;
    for (const MisfitStatistic& statistic : left.statistics) {
        const auto found = std::find_if(possible.begin(), possible.end(),
                                        [&](const Mechanism* mechanism) { return mechanism->name == statistic.cause; });
        if (found != possible.end() && partners.size() < most &&
            std::find(partners.begin(), partners.end(), *found) == partners.end()) {
            partners.push_back(*found);
        }
    }
    return partners;
}

/// Single causes that explain alone nearly as much as the best one, best first: not itself, nor the partner that it has found.
Hypothesis look_alikes(const std::vector<Compared>& all, std::size_t best, const Mechanism* partner) {
    constexpr double near = 10;  // logarithms
    std::vector<std::pair<double, const Mechanism*>> found;
    for (std::size_t k = 1; k < all.size(); ++k) {
        const Hypothesis& one = all[k].fit.hypothesis;
        if (k != best && one.size() == 1 && one.front() != partner && all[k].log_weight() > all[best].log_weight() - near) {
            found.emplace_back(all[k].log_weight(), one.front());
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    Hypothesis causes;
    for (std::size_t k = 0; k < std::min(found.size(), most_pairs); ++k) {
        causes.push_back(found[k].second);
    }
    return causes;
}

/// Pairs to try where the best of all still fails its own test: the two best single causes, and the best with the best one of each
/// other link of the chain.
std::vector<Hypothesis> further_pairs(const std::vector<Compared>& all) {
    std::vector<std::pair<double, const Mechanism*>> singles;
    for (auto one = all.begin() + 1; one != all.end(); ++one) {
        if (one->fit.hypothesis.size() == 1) {
            singles.emplace_back(one->log_weight(), one->fit.hypothesis.front());
        }
    }
    std::sort(singles.begin(), singles.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Hypothesis> pairs;
    std::set<Link> links;
    for (std::size_t k = 1; k < singles.size(); ++k) {
        const Hypothesis pair{singles.front().second, singles[k].second};
        const Link link = pair.back()->kind.link;
        const bool is_first_of_link = link != pair.front()->kind.link && links.insert(link).second;
        if (k == 1 || is_first_of_link) {
            pairs.push_back(pair);
        }
    }
    return pairs;
}

/// Every one of these causes, alone or beside another one.
std::vector<Hypothesis> with_each(const Hypothesis& beside, const Hypothesis& causes) {
    std::vector<Hypothesis> all(causes.size(), beside);
    for (std::size_t k = 0; k < causes.size(); ++k) {
        all[k].push_back(causes[k]);
    }
    return all;
}

/// Models that were fitted, the base model first, and the fits of more of them.
class Fits {
public:
    Fits(const Fit& base, const Inference& inference, const Progress& progress)
        : inference_(inference), progress_(progress), all_{{base}} {}

    /// Fits those that were not yet, several at once.
    void add(const std::vector<Hypothesis>& wanted, double log_prior, double done) {
        std::vector<Hypothesis> missing;
        std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing), [&](const Hypothesis& one) { return !has(one); });
        std::vector<Fit> found(missing.size());
        std::mutex mutex;
        inference_.forward().simulator().together(missing.size(), [&](std::size_t k) {
            {
                const std::lock_guard lock(mutex);
                progress_.update("attributing", done, missing[k].size() > 1 ? "pairs" : missing[k].front()->name);
            }
            found[k] = inference_.fit(missing[k]);
        });
        for (Fit& one : found) {
            all_.push_back({std::move(one), log_prior});
        }
    }

    /// The most probable of all but the base model.
    std::size_t best() const {
        return heaviest_cause(all_, [](const Compared& one) { return one.log_weight(); });
    }
    const std::vector<Compared>& all() const { return all_; }
    std::vector<Compared> taken() { return std::move(all_); }

private:
    bool has(const Hypothesis& wanted) const {
        return std::any_of(all_.begin(), all_.end(), [&](const Compared& one) {
            return std::is_permutation(one.fit.hypothesis.begin(), one.fit.hypothesis.end(), wanted.begin(), wanted.end());
        });
    }

    const Inference& inference_;
    const Progress& progress_;
    std::vector<Compared> all_;
};

}  // namespace

Priors priors_of(const DiagnosisOptions& options, std::size_t mechanisms) {
    // n mechanisms make n (n - 1) / 2 pairs.
    const double pairs = std::max(1.0, (static_cast<double>(mechanisms) - 1) / 2);
    return {.pair = std::log(options.pair_prior / pairs),
            .none = std::log(options.none_prior),
            .beside = std::log(options.none_prior / static_cast<double>(std::max<std::size_t>(1, mechanisms)))};
}

double Compared::log_weight_with_discrepancy(const Priors& priors) const {
    return discrepancy ? log_weight() + (fit.hypothesis.empty() ? priors.none : priors.beside) + discrepancy->log_factor
                       : -std::numeric_limits<double>::infinity();
}

double Compared::log_total(const Priors& priors) const {
    return log_sum({log_weight(), log_weight_with_discrepancy(priors)});
}

double Comparison::log_weight_of_none(const Priors& priors) const {
    const double smooth = all.front().log_weight_with_discrepancy(priors);
    if (forms.empty()) {
        return smooth;
    }
    std::vector<double> factors;
    for (const FreeForm& form : forms) {
        factors.push_back(form.log_factor);
    }
    return log_mean({smooth, all.front().log_weight() + priors.none + log_mean(factors)});
}

Comparison compare(const Fit& base, const Hypothesis& possible, const Inference& inference, const DiagnosisOptions& options,
                   Effort effort, const Progress& progress) {
    const Priors priors = priors_of(options, possible.size());
    Fits fits(base, inference, progress);
    fits.add(with_each({}, possible), 0, 0.5);
    const std::size_t best = fits.best();
    const Mechanism* first = fits.all()[best].fit.hypothesis.front();
    const auto test = [&](const Fit& fit) { return detect(inference, fit, possible, options.seed, options.bootstrap, progress); };
    const Detection rest = test(fits.all()[best].fit);
    const auto p_value_of = [&](std::size_t number, const std::vector<Compared>& all) {
        return number == best ? rest.p_value : test(all[number].fit).p_value;
    };
    const auto add_pairs = [&](const std::vector<Hypothesis>& pairs) { fits.add(pairs, priors.pair, 0.8); };
    if (rest.p_value < easily_passes) {
        const Hypothesis partners = partners_of(rest, possible, effort == Effort::whole ? most_pairs : 1);
        add_pairs(with_each({first}, partners));
        const Hypothesis pair = fits.all()[fits.best()].fit.hypothesis;
        if (effort == Effort::whole && pair.size() > 1) {
            // The best cause may stand for another one that looks like it, beside the partner that it has found.
            std::vector<Hypothesis> others = with_each({}, look_alikes(fits.all(), best, pair[1]));
            for (Hypothesis& other : others) {
                other.push_back(pair[1]);
            }
            add_pairs(others);
        }
    }
    if (effort == Effort::whole && rest.p_value <= options.level && p_value_of(fits.best(), fits.all()) <= options.level) {
        add_pairs(further_pairs(fits.all()));
    }
    Comparison comparison{.all = fits.taken()};
    if (effort == Effort::whole) {
        find_discrepancies(inference, rest.p_value < easily_passes ? most_with_discrepancy : few_with_discrepancy, comparison.all);
        comparison.forms = free_forms(inference, base);
    }
    comparison.winner = heaviest_cause(comparison.all, [&](const Compared& one) { return one.log_total(priors); });
    comparison.p_value = p_value_of(comparison.winner, comparison.all);
    return comparison;
}

}  // namespace coagula::diagnose
