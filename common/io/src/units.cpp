// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/units.hpp>

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>

namespace coagula::io {

namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// The UDUNITS database, which is not safe for threads: whoever uses it holds the mutex.
struct UnitSystem {
    UnitSystem() : system(nullptr, ut_free_system) {
        ut_set_error_message_handler(ut_ignore);
        system.reset(ut_read_xml(nullptr));
        if (!system) {
            throw std::runtime_error("the units database of UDUNITS-2 cannot be read (Debian package libudunits2-data)");
        }
        const Unit degree(ut_get_unit_by_name(system.get(), "degree"), ut_free);
        ut_map_name_to_unit("deg", UT_ASCII, degree.get());  // as rheologists write a cone angle
        const Unit thermal_energy(ut_new_base_unit(system.get()), ut_free);
        ut_map_symbol_to_unit("kT", UT_ASCII, thermal_energy.get());  // of no temperature in particular; not kilotesla
    }
    std::unique_ptr<ut_system, decltype(&ut_free_system)> system;
    std::mutex mutex;
};

UnitSystem& unit_system() {
    static UnitSystem units;
    return units;
}

constexpr std::size_t longest_unit = 100;  ///< characters

/// value * factor + offset.
struct Conversion {
    double factor;
    double offset;
};

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}

bool is_sign(char c) {
    return c == '-' || c == '+';
}

/// True when every digit belongs to an exponent ("m-3", "s^2", "m2"). UDUNITS takes "m 7" for seven metres, "K--1" for minus one
/// kelvin and "K @ 273" for a shifted scale; in a quantity these are slips of the pen.
bool digits_are_exponents(std::string_view unit) {
    for (std::size_t i = 0; i < unit.size(); ++i) {
        const bool second_sign = is_sign(unit[i]) && i > 0 && is_sign(unit[i - 1]);
        if (unit[i] == '@' || second_sign) {
            return false;
        }
        if (std::isdigit(static_cast<unsigned char>(unit[i])) == 0) {
            continue;
        }
        std::size_t before = i;
        while (before > 0 && (std::isdigit(static_cast<unsigned char>(unit[before - 1])) != 0 || unit[before - 1] == '-' ||
                              unit[before - 1] == '+' || unit[before - 1] == '^')) {
            --before;
        }
        const bool lone_one = unit == "1" || (before == i && i == 0 && unit.substr(0, 2) == "1/");
        if (!lone_one && (before == 0 || !(is_letter(unit[before - 1]) || unit[before - 1] == ')'))) {
            return false;
        }
    }
    return true;
}

/// Equal dimension in the strict sense: UDUNITS converts reciprocals into each other and takes an angle for a pure number.
bool same_dimension(const ut_unit* from, const ut_unit* to) {
    const Unit quotient(ut_divide(from, to), ut_free);
    if (!quotient || ut_is_dimensionless(quotient.get()) == 0) {
        return false;
    }
    std::array<char, 256> text{};
    const int length = ut_format(quotient.get(), text.data(), text.size(), UT_ASCII | UT_DEFINITION);
    return length >= 0 && std::string_view(text.data()).find("rad") == std::string_view::npos;
}

/// UDUNITS would read up to a NUL character, and a message would end there.
void refuse_nul(const std::string& text, const std::string& unit) {
    if (text.find('\0') != std::string::npos) {
        throw InputError("a text with a NUL character is not a quantity or unit (expected: one in " + unit + ")");
    }
}

/// @param what names the text in messages.
Conversion conversion(const std::string& from, const std::string& to, const std::string& what) {
    UnitSystem& units = unit_system();
    if (from.size() > longest_unit) {
        throw InputError("a text of " + std::to_string(from.size()) + " characters is not a unit (expected: a unit such as " + to +
                         ")");
    }
    const std::lock_guard lock(units.mutex);
    const Unit target(ut_parse(units.system.get(), to.c_str(), UT_UTF8), ut_free);
    if (!target) {
        throw InputError("'" + to + "' is not a unit");
    }
    const Unit source(digits_are_exponents(from) ? ut_parse(units.system.get(), from.c_str(), UT_UTF8) : nullptr, ut_free);
    if (!source) {
        throw InputError(what + ": '" + from + "' is not a unit (expected: a unit such as " + to + ")");
    }
    if (!same_dimension(source.get(), target.get())) {
        throw InputError(what + ": '" + from + "' has another dimension than the expected unit " + to);
    }
    const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(source.get(), target.get()), cv_free);
    if (!converter) {
        throw InputError(what + ": '" + from + "' cannot be converted into the expected unit " + to);
    }
    const double offset = cv_convert_double(converter.get(), 0.0);
    const double factor = cv_convert_double(converter.get(), 1.0) - offset;
    if (!(std::isfinite(offset) && std::isnormal(factor) && factor > 0)) {
        throw InputError(what + ": '" + from + "' is too large or too small a unit for " + to);
    }
    return {factor, offset};
}

/// `value` if it is a whole number but for the rounding UDUNITS made, otherwise 0.
double whole_number(double value) {
    const double nearest = std::round(value);
    return std::abs(value - nearest) < 1e-14 * nearest ? nearest : 0.0;
}

/// Divides where the factor is one over a whole number (the prefixes): that rounds once, so 0.3um and 3e-7 are the same number.
double apply(const Conversion& conversion, double value) {
    if (const double inverse = whole_number(1 / conversion.factor); inverse > 1) {
        return value / inverse + conversion.offset;
    }
    const double whole = whole_number(conversion.factor);
    return value * (whole > 0 ? whole : conversion.factor) + conversion.offset;
}

/// UDUNITS does not know the molar, and M is a prefix to it: where a concentration is asked, mM is mmol/l.
std::string spelled_out(std::string_view written, const std::string& unit) {
    if (unit == "mol/m3" && written.ends_with('M')) {
        return std::string(written.substr(0, written.size() - 1)) + "mol/l";
    }
    return std::string(written);
}

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

double parse_quantity(const std::string& text, const std::string& unit) {
    refuse_nul(text, unit);
    const std::string what = "'" + text + "' is not a quantity in " + unit;
    std::string_view rest = trim(text);
    if (rest.starts_with('+') && !rest.starts_with("+-")) {
        rest.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc::result_out_of_range) {
        throw InputError(what + ": the number is too large or too small");
    }
    if (error != std::errc{} || !std::isfinite(value)) {
        throw InputError(what + ": it must begin with a finite number");
    }
    rest = trim(rest.substr(static_cast<std::size_t>(end - rest.data())));
    const double result = rest.empty() ? value : apply(conversion(spelled_out(rest, unit), unit, what), value);
    if (!std::isfinite(result)) {
        throw InputError(what + ": the number is too large");
    }
    return result;
}

bool is_unit_text(const std::string& text) {
    if (text.empty() || text.size() > longest_unit || text.find('\0') != std::string::npos || !digits_are_exponents(text)) {
        return false;
    }
    UnitSystem& units = unit_system();
    const std::lock_guard lock(units.mutex);
    return Unit(ut_parse(units.system.get(), text.c_str(), UT_UTF8), ut_free) != nullptr;
}

double unit_factor(const std::string& from, const std::string& to) {
    refuse_nul(from, to);
    const std::string what = "'" + from + "' is not a unit of the dimension of " + to;
    const Conversion found = conversion(std::string(trim(from)), to, what);
    if (found.offset != 0) {
        throw InputError(what + ": its zero lies elsewhere");
    }
    return apply(found, 1.0);
}

std::vector<double> convert(const std::vector<double>& values, const std::string& from, const std::string& to) {
    refuse_nul(from, to);
    const Conversion found = conversion(std::string(trim(from)), to, "'" + from + "' is not a unit of the dimension of " + to);
    std::vector<double> converted(values.size());
    std::transform(values.begin(), values.end(), converted.begin(), [&](double value) {
        const double result = apply(found, value);
        if (std::isfinite(value) && !std::isfinite(result)) {
            throw InputError(to_text(value) + " " + from + " is too large a number in " + to);
        }
        return result;
    });
    return converted;
}

}  // namespace coagula::io
