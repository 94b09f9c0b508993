#include "rheometer_headings.hpp"

#include "text_reader.hpp"

#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <unordered_map>
#include <utility>

namespace coagula::io {

namespace {

using Entry = std::pair<std::string_view, std::string_view>;

/// Headings in lower case and what they mean; single letters, whose case matters, as they are written. Anton Paar RheoCompass
/// (English, German, French) and RheoPlus (English, Japanese), TA Instruments TRIOS, HAAKE RheoWin, Kinexus, and the symbols people
/// use. Of headings with one meaning the more special ones stand first. Interval times are not here: they start anew in each
/// section, and which clock a sweep ran on must be said.
constexpr std::array headings = {
    Entry{"time", "time"},
    Entry{"zeit", "time"},
    Entry{"temps", "time"},
    Entry{"時間", "time"},
    Entry{"t", "time"},
    Entry{"step time", "time"},
    Entry{"time (sequence)", "time"},

    Entry{"oscillation strain", "strain"},
    Entry{"strain amplitude", "strain"},
    Entry{"complex shear strain", "strain"},
    Entry{"shear strain amplitude", "strain"},
    Entry{"shear strain", "strain"},
    Entry{"scherdeformation", "strain"},
    Entry{"deformation", "strain"},
    Entry{"déformation de cisaillement", "strain"},
    Entry{"déformation", "strain"},
    Entry{"ひずみ", "strain"},
    Entry{"strain", "strain"},
    Entry{"γ", "strain"},
    Entry{"gamma", "strain"},

    Entry{"oscillation stress", "stress"},
    Entry{"stress amplitude", "stress"},
    Entry{"complex shear stress", "stress"},
    Entry{"shear stress amplitude", "stress"},
    Entry{"shear stress", "stress"},
    Entry{"schubspannung", "stress"},
    Entry{"contrainte de cisaillement", "stress"},
    Entry{"contrainte", "stress"},
    Entry{"せん断応力", "stress"},
    Entry{"stress", "stress"},
    Entry{"τ", "stress"},
    Entry{"tau", "stress"},
    Entry{"σ", "stress"},

    Entry{"storage modulus", "storage_modulus"},
    Entry{"speichermodul", "storage_modulus"},
    Entry{"module de stockage", "storage_modulus"},
    Entry{"module de conservation", "storage_modulus"},
    Entry{"貯蔵弾性率", "storage_modulus"},
    Entry{"elastic modulus", "storage_modulus"},
    Entry{"shear storage modulus", "storage_modulus"},
    Entry{"shear modulus (elastic component)", "storage_modulus"},
    Entry{"module élastique", "storage_modulus"},
    Entry{"g prime", "storage_modulus"},
    Entry{"gprime", "storage_modulus"},
    Entry{"gp", "storage_modulus"},
    Entry{"g'", "storage_modulus"},

    Entry{"loss modulus", "loss_modulus"},
    Entry{"verlustmodul", "loss_modulus"},
    Entry{"module de perte", "loss_modulus"},
    Entry{"損失弾性率", "loss_modulus"},
    Entry{"viscous modulus", "loss_modulus"},
    Entry{"shear loss modulus", "loss_modulus"},
    Entry{"shear modulus (viscous component)", "loss_modulus"},
    Entry{"module visqueux", "loss_modulus"},
    Entry{"g double prime", "loss_modulus"},
    Entry{"gdoubleprime", "loss_modulus"},
    Entry{"gpp", "loss_modulus"},
    Entry{"gdp", "loss_modulus"},
    Entry{"g''", "loss_modulus"},

    Entry{"complex modulus", "complex_modulus"},
    Entry{"complex shear modulus", "complex_modulus"},
    Entry{"shear modulus (complex component)", "complex_modulus"},
    Entry{"komplexer schubmodul", "complex_modulus"},
    Entry{"module complexe", "complex_modulus"},
    Entry{"module de cisaillement complexe", "complex_modulus"},
    Entry{"複素弾性率", "complex_modulus"},
    Entry{"|g*|", "complex_modulus"},
    Entry{"g*", "complex_modulus"},

    Entry{"third harmonic storage", "third_harmonic_storage"},
    Entry{"third harmonic loss", "third_harmonic_loss"},

    Entry{"loss tangent", "loss_tangent"},
    Entry{"loss factor", "loss_tangent"},
    Entry{"damping factor", "loss_tangent"},
    Entry{"verlustfaktor", "loss_tangent"},
    Entry{"facteur de perte", "loss_tangent"},
    Entry{"損失正接", "loss_tangent"},
    Entry{"tan(delta)", "loss_tangent"},
    Entry{"tan delta", "loss_tangent"},
    Entry{"tandelta", "loss_tangent"},
    Entry{"tan(δ)", "loss_tangent"},
    Entry{"tan δ", "loss_tangent"},
    Entry{"tanδ", "loss_tangent"},

    Entry{"phase shift angle", "phase"},
    Entry{"phasenverschiebungswinkel", "phase"},
    Entry{"angle de déphasage", "phase"},
    Entry{"位相角", "phase"},
    Entry{"phase angle", "phase"},
    Entry{"phase shift", "phase"},
    Entry{"loss angle", "phase"},
    Entry{"phasenwinkel", "phase"},
    Entry{"verlustwinkel", "phase"},
    Entry{"déphasage", "phase"},
    Entry{"phase", "phase"},
    Entry{"delta", "phase"},
    Entry{"δ", "phase"},

    Entry{"raw phase", "raw_phase"},
    Entry{"raw phase (torque)", "raw_phase"},
    Entry{"raw oscillation phase", "raw_phase"},
    Entry{"raw phase angle", "raw_phase"},

    Entry{"angular frequency", "angular_frequency"},
    Entry{"kreisfrequenz", "angular_frequency"},
    Entry{"fréquence angulaire", "angular_frequency"},
    Entry{"pulsation", "angular_frequency"},
    Entry{"角周波数", "angular_frequency"},
    Entry{"omega", "angular_frequency"},
    Entry{"ω", "angular_frequency"},
    Entry{"w", "angular_frequency"},

    Entry{"frequency", "frequency"},
    Entry{"frequenz", "frequency"},
    Entry{"fréquence", "frequency"},
    Entry{"周波数", "frequency"},
    Entry{"freq", "frequency"},
    Entry{"freq.", "frequency"},
    Entry{"f", "frequency"},

    Entry{"complex viscosity", "complex_viscosity"},
    Entry{"komplexe viskosität", "complex_viscosity"},
    Entry{"viscosité complexe", "complex_viscosity"},
    Entry{"複素粘度", "complex_viscosity"},
    Entry{"|eta*|", "complex_viscosity"},
    Entry{"eta*", "complex_viscosity"},
    Entry{"|η*|", "complex_viscosity"},
    Entry{"η*", "complex_viscosity"},

    Entry{"oscillation torque", "torque"},
    Entry{"torque", "torque"},
    Entry{"moment", "torque"},
    Entry{"drehmoment", "torque"},
    Entry{"couple", "torque"},
    Entry{"ﾄﾙｸ", "torque"},
    Entry{"トルク", "torque"},
    Entry{"M", "torque"},

    Entry{"oscillation displacement", "deflection"},
    Entry{"deflection angle", "deflection"},
    Entry{"auslenkwinkel", "deflection"},
    Entry{"angle de déflexion", "deflection"},
    Entry{"angular displacement", "deflection"},
    Entry{"振り角", "deflection"},
    Entry{"deflection", "deflection"},
    Entry{"displacement", "deflection"},

    Entry{"normal force", "normal_force"},
    Entry{"normalkraft", "normal_force"},
    Entry{"force normale", "normal_force"},
    Entry{"ﾉｰﾏﾙﾌｫｰｽ", "normal_force"},
    Entry{"ノーマルフォース", "normal_force"},
    Entry{"axial force", "normal_force"},
    Entry{"fn", "normal_force"},
    Entry{"F", "normal_force"},

    Entry{"temperature", "temperature"},
    Entry{"temperatur", "temperature"},
    Entry{"température", "temperature"},
    Entry{"温度", "temperature"},
    Entry{"T", "temperature"},

    Entry{"gap", "gap"},
    Entry{"spaltabstand", "gap"},
    Entry{"messspalt", "gap"},
    Entry{"entrefer", "gap"},
    Entry{"ｷﾞｬｯﾌﾟ", "gap"},
    Entry{"ギャップ", "gap"},

    Entry{"shear rate", "shear_rate"},
    Entry{"scherrate", "shear_rate"},
    Entry{"gradient de cisaillement", "shear_rate"},
    Entry{"vitesse de cisaillement", "shear_rate"},
    Entry{"taux de cisaillement", "shear_rate"},
    Entry{"せん断速度", "shear_rate"},
    Entry{"viscosity", "viscosity"},
    Entry{"shear viscosity", "viscosity"},
    Entry{"viskosität", "viscosity"},
    Entry{"viscosité", "viscosity"},
    Entry{"粘度", "viscosity"},
    Entry{"eta", "viscosity"},
    Entry{"η", "viscosity"},
    Entry{"relaxation modulus", "relaxation_modulus"},
    Entry{"緩和弾性率", "relaxation_modulus"},

    Entry{"plate radius", "plate_radius"},
    Entry{"volume fraction", "volume_fraction"},
    Entry{"phi", "volume_fraction"},
    Entry{"φ", "volume_fraction"},
    Entry{"ϕ", "volume_fraction"},
    Entry{"heterogeneity", "heterogeneity"},
    Entry{"coordination", "coordination"},
    Entry{"coordination number", "coordination"},
    Entry{"structure", "structure"},
    Entry{"rattler fraction", "rattler_fraction"},
    Entry{"x", "x"},
    Entry{"y", "y"},
    Entry{"z", "z"},
    Entry{"frame", "frame"},
    Entry{"image", "frame"},
    Entry{"particle radius", "particle_radius"},
    Entry{"pore radius", "pore_radius"},
    Entry{"exclusion probability", "exclusion_probability"},
};

constexpr std::size_t longest_heading = 100;  ///< bytes; none of the list comes near

using Replacements = std::initializer_list<std::pair<std::string_view, std::string_view>>;

std::string replaced(std::string text, const Replacements& replacements) {
    for (const auto& [from, to] : replacements) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
        }
    }
    return text;
}

/// Primes and dashes as a typewriter has them, and Greek letters where others look like them.
std::string plain_name(std::string_view heading) {
    std::string name = replaced(std::string(trim(heading)), {{"′", "'"},
                                                             {"’", "'"},
                                                             {"‘", "'"},
                                                             {"ʹ", "'"},
                                                             {"ˈ", "'"},
                                                             {"´", "'"},
                                                             {"`", "'"},
                                                             {"″", "''"},
                                                             {"”", "''"},
                                                             {"“", "''"},
                                                             {"\"", "''"},
                                                             {"Ω", "ω"},
                                                             {"ɣ", "γ"},
                                                             {"ɷ", "ω"},
                                                             {"_", " "}});
    return name.size() == 1 ? name : lower_case(name);
}

bool is_unit(std::string_view text) {
    return text == "1" || is_unit_text(normal_unit(text));
}

/// The parts of a heading whose left one is known and whose right one is a unit.
std::optional<HeadingWithUnit> split_at(std::string_view text, std::size_t at, std::size_t width) {
    const std::string_view name = trim(text.substr(0, at));
    const std::string_view unit = trim(text.substr(at + width));
    const bool may_be_a_name = width == 1 && text[at] == ' ' && unit.size() == 1 && unit != "%";  // "G' A" of sample A
    if (unit.empty() || may_be_a_name || known_heading(name).quantity.empty() || !is_unit(unit)) {
        return std::nullopt;
    }
    return HeadingWithUnit{std::string(name), normal_unit(unit)};
}

/// "ShearRate" as two words.
std::string parted_words(std::string_view heading) {
    std::string parted;
    for (const char c : heading) {
        const bool begins_word = c >= 'A' && c <= 'Z' && !parted.empty() && parted.back() >= 'a' && parted.back() <= 'z';
        parted += begins_word ? std::string{' ', c} : std::string{c};
    }
    return parted;
}

/// The heading as it stands in the list.
KnownHeading listed(std::string_view heading) {
    static const std::unordered_map<std::string_view, std::size_t> places = [] {
        std::unordered_map<std::string_view, std::size_t> map;
        for (std::size_t place = 0; place < headings.size(); ++place) {
            map.emplace(headings[place].first, place);
        }
        return map;
    }();
    const std::string name = plain_name(heading);
    auto found = places.find(name);
    const std::string lower = lower_case(name);
    found = found == places.end() ? places.find(lower) : found;
    found = found == places.end() ? places.find(plain_name(parted_words(heading))) : found;
    return found == places.end() ? KnownHeading{} : KnownHeading{std::string(headings[found->second].second), found->second};
}

/// Without what parts a word from its symbol.
std::string_view bare_part(std::string_view part) {
    constexpr std::string_view marks = " ,;:=-/";
    part.remove_prefix(std::min(part.find_first_not_of(marks), part.size()));
    part = part.substr(0, part.find_last_not_of(marks) + 1);
    const bool in_brackets =
        part.size() > 2 && ((part.front() == '(' && part.back() == ')') || (part.front() == '[' && part.back() == ']'));
    return in_brackets ? part.substr(1, part.size() - 2) : part;
}

/// "Storage modulus (G')", "Speichermodul G'", "ω, angular frequency": two known headings that mean the same.
KnownHeading listed_twice(std::string_view heading) {
    for (std::size_t i = 1; i + 1 < heading.size(); ++i) {
        if (std::string_view(" ([,:=-/").find(heading[i]) == std::string_view::npos) {
            continue;
        }
        const KnownHeading one = listed(bare_part(heading.substr(0, i)));
        if (!one.quantity.empty() && one.quantity == listed(bare_part(heading.substr(i))).quantity) {
            return one;
        }
    }
    return {};
}

}  // namespace

KnownHeading known_heading(std::string_view heading) {
    if (heading.size() > longest_heading) {
        return {};
    }
    KnownHeading known = listed(heading);
    return known.quantity.empty() ? listed_twice(trim(heading)) : known;
}

std::string quantity_of_heading(std::string_view heading) {
    return known_heading(heading).quantity;
}

std::string normal_unit(std::string_view text) {
    text = trim(text);
    if (text.size() >= 2 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'))) {
        text = trim(text.substr(1, text.size() - 2));
    }
    if (text == "-" || text == "—" || text == "–") {
        return "1";
    }
    std::string unit = replaced(std::string(text), {{"・", "."},
                                                    {"·", "."},
                                                    {"⋅", "."},
                                                    {"*", "."},
                                                    {"⁻¹", "-1"},
                                                    {"⁻²", "-2"},
                                                    {"N m", "N.m"},
                                                    {"Nm", "N.m"},
                                                    {"Pa s", "Pa.s"},
                                                    {"Pa_s", "Pa.s"},
                                                    {"rad_s", "rad/s"},
                                                    {"1_s", "1/s"}});
    if (unit.ends_with("Pas")) {
        unit.insert(unit.size() - 1, ".");
    }
    const bool per_torque = unit.ends_with("/N.m");
    return per_torque ? unit.substr(0, unit.size() - 3) + "(N.m)" : unit;
}

HeadingWithUnit split_heading(std::string_view text) {
    text = trim(text);
    if (!known_heading(text).quantity.empty()) {
        return {std::string(text), ""};
    }
    if (const std::size_t begin = text.rfind('['); text.ends_with(']') && begin != std::string_view::npos && begin > 0) {
        return {std::string(trim(text.substr(0, begin))), normal_unit(text.substr(begin))};
    }
    if (const std::size_t begin = text.rfind('('); text.ends_with(')') && begin != std::string_view::npos && begin > 0) {
        const std::string unit = normal_unit(text.substr(begin));
        return is_unit(unit) ? HeadingWithUnit{std::string(trim(text.substr(0, begin))), unit}
                             : HeadingWithUnit{std::string(text), ""};
    }
    for (const std::string_view separator : {" / ", " in ", " en ", "/", ", ", "_", " "}) {
        for (std::size_t at = text.find(separator, 1); at != std::string_view::npos; at = text.find(separator, at + 1)) {
            if (auto parts = split_at(text, at, separator.size())) {
                return std::move(*parts);
            }
        }
    }
    return {std::string(text), ""};
}

}  // namespace coagula::io
