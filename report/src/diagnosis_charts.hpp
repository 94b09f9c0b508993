// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of the page of a diagnosis, as the script of the page draws them (web/src/plots/chart.ts, ChartSpec).
#pragma once

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/report/results.hpp>

#include <string>

namespace coagula::report {

/// Figures in the order in which they stand on the page.
class Charts {
public:
    /// @return the element in which the script draws this one.
    std::string place(Json chart);

    const Json& all() const { return charts_; }

private:
    Json charts_ = Json::array();
};

/// Measured data of one table against the models, beside them the residuals: moduli, third harmonics, neighbours, pores and
/// viscosities, as far as the table has them. HTML.
/// @param cause name of the best cause; empty: there is none, and the base model stands alone.
std::string table_charts(Charts& charts, const diagnose::Measurement& table, std::size_t number,
                         const diagnose::Diagnosis& diagnosis, const std::string& cause);

/// Errors of the predictions of held-out rows of one table, by models that were fitted to the other rows; empty where no row of the
/// table is held out.
std::string gain_charts(Charts& charts, const diagnose::Measurement& table, std::size_t number,
                        const diagnose::Diagnosis& diagnosis);

/// The largest misfit among data sets drawn from the base model, and that of the data; empty where none were drawn.
std::string detection_chart(Charts& charts, const diagnose::Diagnosis& diagnosis, const std::string& note);

/// "G'", "G''" and so on for the name of an observable.
std::string symbol_of(const std::string& observable);

}  // namespace coagula::report
