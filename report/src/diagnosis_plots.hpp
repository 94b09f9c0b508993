// The pictures of a diagnosis, as commands for gnuplot.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/report/gnuplot.hpp>

#include <string>
#include <vector>

namespace coagula::report {

struct Picture {
    std::string svg;
    std::string meaning;  ///< of its points, in words
    bool moduli;          ///< on a logarithmic axis, perhaps
};

/// Measured data of one table against both models, beside them the residuals: moduli, third harmonics, neighbours and pores, as far
/// as the table has them.
/// @param cause name of the best cause; empty: there is none, and the base model stands alone.
std::vector<Picture> draw_table(Gnuplot& gnuplot, const diagnose::Measurement& table, std::size_t number,
                                const diagnose::Diagnosis& diagnosis, const std::string& cause);

/// Errors of the predictions of held-out rows of one table, by models that were fitted to the other rows; none where no row of the
/// table is held out.
std::vector<Picture> draw_gain(Gnuplot& gnuplot, const diagnose::Measurement& table, std::size_t number,
                               const diagnose::Diagnosis& diagnosis);

/// The largest misfit among data sets drawn from the base model, and that of the data.
std::string draw_detection(Gnuplot& gnuplot, const diagnose::Diagnosis& diagnosis);

/// "G'", "G''" and so on for the name of an observable.
std::string symbol_of(const std::string& observable);

}  // namespace coagula::report
