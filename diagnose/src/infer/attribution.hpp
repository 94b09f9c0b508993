// SPDX-License-Identifier: GPL-3.0-or-later
// Which cause explains the data: the base model, every cause and pairs, each alone and with a discrepancy on top.
#pragma once

#include "discrepancy.hpp"
#include "free_forms.hpp"
#include "hypothesis.hpp"

#include <coagula/common/progress.hpp>
#include <coagula/diagnose/diagnosis.hpp>

#include <optional>
#include <vector>

namespace coagula::diagnose {

/// Logarithms of prior weights over that of a single mechanism.
struct Priors {
    double pair;    ///< of one pair
    double none;    ///< of a discrepancy alone
    double beside;  ///< of a discrepancy beside a cause: all causes together as probable as none of them
};

Priors priors_of(const DiagnosisOptions& options, std::size_t mechanisms);

/// A hypothesis without and with a discrepancy.
struct Compared {
    Fit fit;
    double log_prior = 0;
    std::optional<Discrepancy> discrepancy = {};  ///< once it was looked for

    double log_weight() const { return fit.log_evidence + log_prior; }
    double log_weight_with_discrepancy(const Priors& priors) const;
    double log_total(const Priors& priors) const;
};

/// The models compared.
struct Comparison {
    std::vector<Compared> all;         ///< the base model first
    std::size_t winner = 0;            ///< the most probable of all but the base model
    double p_value = 1;                ///< of the test, applied to the winner
    std::vector<FreeForm> forms = {};  ///< of each kind of departure; none in brief

    /// Returns the weight of a departure that no cause explains: smooth along the coordinates, or the free form of a link.
    double log_weight_of_none(const Priors& priors) const;
};

/// Extent of the search: in brief without discrepancies and with one pair.
enum class Effort { whole, brief };

/// Fits single causes; where the best does not pass the test with ease, it is paired with those causes towards which the data still
/// depart from it. Where a pair is the best then, its second member is paired with those that explain nearly as much alone; where
/// the best still fails, the two best causes are paired, and the best with one of every other link of the chain.
Comparison compare(const Fit& base, const Hypothesis& possible, const Inference& inference, const DiagnosisOptions& options,
                   Effort effort = Effort::whole, const Progress& progress = {});

}  // namespace coagula::diagnose
