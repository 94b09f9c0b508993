// SPDX-License-Identifier: GPL-3.0-or-later
#include "finding_sentences.hpp"

#include "html.hpp"
#include "page_axis.hpp"

#include <coagula/diagnose/observable.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace coagula::report {

namespace {

using diagnose::Misfit;
using diagnose::observable_named;

std::string three_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::string value_text(double value, const WrittenCoordinate& coordinate) {
    return three_digits(value / coordinate.unit) + std::string(coordinate.symbol);
}

/// "3.2 standard deviations above".
std::string deviations_text(double score) {
    return three_digits(std::abs(score)) + " standard deviations " + (score > 0 ? "above" : "below");
}

/// Which way the measured values go from the early ones to the late ones, against a base model that may be zero.
std::string way_of(double early, double late, bool base_is_zero) {
    if (base_is_zero) {
        return late < 0 ? " falls below the base model" : " rises above the base model";
    }
    return late < early ? " falls relative to the base model" : " rises relative to the base model";
}

/// It tells a departure in percent, and where that exceeds the base model as the factor between both.
class DepartureText {
public:
    DepartureText(bool of_base_model, double largest) : as_factor_(of_base_model && largest > 1) {}

    const char* before() const { return as_factor_ ? ": " : ": mean difference "; }

    std::string first(double departure) const { return other(departure) + (as_factor_ ? " the base model" : ""); }

    std::string other(double departure) const {
        return as_factor_ ? three_digits(1 + departure) + " times" : three_digits(100 * departure) + " %";
    }

private:
    bool as_factor_;
};

std::string sentence(const Misfit& misfit, const diagnose::SmoothMisfit& course) {
    const diagnose::Observable& observable = observable_named(misfit.observable);
    const WrittenCoordinate coordinate = written_coordinate(misfit.axis);
    const std::string whole(course.over_largest ? "the largest predicted modulus" : observable.whole);
    const std::string of = whole.empty() ? "" : " (of " + whole + ")";
    const std::string axis = std::string(coordinate.words) + (course.time_is_stated ? "" : " (10 s a row where none is stated)");
    const double early = course.before;
    const double late = misfit.departure;
    const DepartureText text(whole.empty(), std::max(early, late));
    if (course.is_the_same) {
        return std::string(observable.phrase) + " lies " + (late < 0 ? "below" : "above") + " the base model all along " + axis +
               text.before() + text.first(0.5 * (early + late)) + of;
    }
    return std::string(observable.phrase) + way_of(early, late, course.base_is_zero) + " along " + axis + text.before() +
           text.first(early) + " before and " + text.other(late) + " from " + value_text(misfit.from, coordinate) + " on" + of;
}

std::string sentence(const Misfit& misfit, const diagnose::LevelMisfit& level) {
    const bool newtonian = misfit.axis == "viscosity";
    const std::string unit = newtonian ? " Pa.s" : " N/m";
    return std::string(newtonian ? "the level asks for a viscosity of " : "the level of G' asks for a normal stiffness of ") +
           three_digits(misfit.from) + unit + ", " + deviations_text(level.score) + " the known " + three_digits(level.known) +
           unit;
}

std::string sentence(const Misfit& misfit, const diagnose::SampleMisfit& one) {
    return "sample '" + one.sample + "' as a whole lies " + three_digits(100 * std::abs(misfit.departure)) + " %, " +
           deviations_text(one.score) + " the base model";
}

std::string sentence(const Misfit& misfit, const diagnose::ImageMisfit& images) {
    const std::string text = misfit.observable == "unmatched_share"
                                 ? three_digits(100 * images.value) + " % of the centres of an image are not in the next one"
                                 : "images of the same particles scatter: a centre by " + three_digits(images.value) +
                                       " diameters " + (misfit.observable == "localisation_plane" ? "in the plane" : "along z");
    return text + ", " + deviations_text(images.score) + " exact centres";
}

/// " (0.333 to 3 mm)"; empty where nobody knows the lengths.
std::string millimetres(const std::vector<double>& lengths) {
    if (lengths.empty() || !std::isfinite(lengths.front())) {
        return {};
    }
    std::string text;
    for (const double length : lengths) {
        text += (text.empty() ? " (" : " to ") + three_digits(1e3 * length);
    }
    return text + " mm)";
}

/// A measurement in words; LENGTHS, GAPS and REST stand for those of a proposal.
const std::map<std::string, std::string>& measurements() {
    const std::string steady = "a run at constant small strain and frequency ";
    const std::string sweep = "an amplitude sweep on a fresh sample";
    const std::string flow = "a flow curve of a fresh sample ";
    static const std::map<std::string, std::string> all{
        {"time-sweep", steady + "over the same time"},
        {"long-time-sweep", steady + "over ten times as long, with the first rows close together"},
        {"long-time-sweep-under-trap", steady + "over ten times as long under a solvent trap"},
        {"time-sweep-at-small-gap", steady + "on a fresh sample at a third of the gapLENGTHS, with the first rows close together"},
        {"frequency-sweep", "a frequency sweep over four decades at the smallest strain"},
        {"frequency-sweep-under-small-plate", "a frequency sweep with a plate of half the radiusLENGTHS"},
        {"amplitude-sweep", sweep},
        {"amplitude-sweep-with-waveforms", sweep + " with its waveforms"},
        {"amplitude-sweep-at-high-frequency", sweep + " at ten times the frequency"},
        {"amplitude-sweep-and-again", sweep + ", and the same again after a rest of REST"},
        {"amplitude-sweep-up-and-down", "an amplitude sweep up and down again"},
        {"amplitude-sweep-at-small-gap", sweep + " at a quarter of the gapLENGTHS"},
        {"amplitude-sweep-under-cone", sweep + " under a cone of 1 degree, where the strain is the same everywhere"},
        {"sweep-under-rough-cone", "a sweep at the smallest strain between a rough cone and a rough plate, at which nothing slips"},
        {"sweep-under-small-cone", "a sweep at the smallest strain under a cone of half the radiusLENGTHS"},
        {"gap-series", "GAPS"},
        {"gap-series-with-rough-plates", "GAPS between rough plates, at which nothing slips"},
        {"gap-series-with-oil", "GAPS with a Newtonian oil of known viscosity"},
        {"gap-series-with-rough-plates-and-with-oil",
         "GAPS between rough plates, at which nothing slips, and one with a Newtonian oil of known viscosity"},
        {"flow-curve-up", flow + "from low shear rates to high ones"},
        {"flow-curve-down", flow + "from high shear rates to low ones"},
        {"flow-curve-with-small-tool", flow + "with a tool of half the radiusLENGTHS"},
        {"flow-curve-at-small-gap", flow + "at a third of the gapLENGTHS"},
        {"images-again", "the same particles imaged twice, one image after the other"}};
    return all;
}

}  // namespace

std::string sentence_on(const Misfit& misfit) {
    return std::visit([&](const auto& what) { return sentence(misfit, what); }, misfit.what);
}

std::string sentence_on(const diagnose::Remainder& remainder) {
    if (remainder.observable.empty()) {
        return {};
    }
    std::string text = std::string(observable_named(remainder.observable).phrase) + " lies " +
                       (remainder.largest < 0 ? "below" : "above") + " the model by up to " +
                       three_digits(100 * std::abs(remainder.largest)) + " % of |G*|";
    std::string link = ", at ";
    for (const diagnose::CoordinateRange& range : remainder.where) {
        const WrittenCoordinate coordinate = written_coordinate(range.coordinate);
        text += link + std::string(coordinate.words) + " " + value_text(range.low, coordinate) +
                (range.high > range.low ? " to " + value_text(range.high, coordinate) : "");
        link = " and ";
    }
    return text;
}

std::string words_for(const diagnose::Proposal& proposal) {
    const std::vector<double>& lengths = proposal.lengths;
    const bool widening = lengths.size() == 2 && lengths.front() < lengths.back();
    const std::string gaps = std::string("a series of gaps from ") + (widening ? "narrow to wide" : "wide to narrow");
    const std::string rest = std::isfinite(proposal.rest) ? std::to_string(std::lround(proposal.rest / 60)) + " min" : "";
    std::string text = replaced(measurements().at(proposal.measurement), "GAPS", gaps + "LENGTHS");
    return replaced(replaced(std::move(text), "LENGTHS", millimetres(lengths)), "REST", rest);
}

}  // namespace coagula::report
