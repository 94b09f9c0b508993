// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a sweep file and checks every option in it. The result has one row of options for each structure of the set.
#include "signature.hpp"
#include "sweep_section.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/checksums.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/dataset.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/shear.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

/// Options that name a file to write, or another way of working.
const std::set<std::string> without_place = {"checkpoint", "checkpoint-interval", "potential-curve", "picture", "compare", "start"};

const Option* option_named(const Verb& verb, const std::string& name) {
    const auto found =
        std::find_if(verb.options.begin(), verb.options.end(), [&](const Option& option) { return option.goes_by(name); });
    return found == verb.options.end() ? nullptr : &*found;
}

std::string meant_option(const Verb& verb, const std::string& name) {
    std::vector<std::string> names;
    for (const Option& option : verb.options) {
        names.push_back(option.name);
    }
    std::string dashed = name;
    std::replace(dashed.begin(), dashed.end(), '_', '-');
    return did_you_mean(dashed, names);
}

/// Files are named from the folder of the sweep.
void resolve_files(const Option& option, const fs::path& folder, Axis& axis) {
    for (Given& value : axis.values) {
        const auto* name = std::get_if<std::string>(&value);
        if (option.file == Option::File::read && name != nullptr && fs::path(*name).is_relative() && fs::exists(folder / *name)) {
            value = (folder / *name).string();
        }
    }
}

Section read_section(const toml::table& table, Verb verb, std::string where, const fs::path& folder, bool stepped) {
    Section section{in_memory(std::move(verb), without_place), std::move(where), {}};
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (name == "verb" || name == "replicates") {
            continue;
        }
        const Option* option = option_named(section.verb, name);
        if (option == nullptr) {
            fail_at(section.where, name,
                    without_place.contains(name) || name == "output" || name == "force"
                        ? "has no place in a set"
                        : "is no option of " + section.verb.name + meant_option(section.verb, name));
        }
        if (std::ranges::count(section.axes, option->name, &Axis::option) > 0) {
            fail_at(section.where, name,
                    "and its other name stand for one option: " + option->former_name + " is the old name of " + option->name);
        }
        section.axes.push_back(read_axis(node, *option, section.where, stepped));
        resolve_files(*option, folder, section.axes.back());
    }
    return section;
}

std::string text_at(const toml::table& table, const char* key, const std::string& where) {
    const toml::node* node = table.get(key);
    if (node == nullptr || !node->is_string()) {
        fail_at(where, key, node == nullptr ? "is missing" : "must be a text in quotes");
    }
    return node->ref<std::string>();
}

std::int64_t whole_at(const toml::table& table, const char* key, const std::string& where, std::int64_t otherwise, std::int64_t low,
                      std::int64_t high) {
    const toml::node* node = table.get(key);
    if (node == nullptr) {
        return otherwise;
    }
    const auto* number = node->as_integer();
    if (number == nullptr || number->get() < low || number->get() > high) {
        fail_at(where, key, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return number->get();
}

void refuse_other_keys(const toml::table& table, const std::vector<std::string>& known, const std::string& where) {
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            throw InputError(where + ": the key '" + name + "' is unknown" + did_you_mean(name, known));
        }
    }
}

Design read_design(const toml::table& root, const std::string& path) {
    const std::string where = path + ", [design]";
    const toml::node* node = root.get("design");
    if (node == nullptr) {
        return {};
    }
    if (!node->is_table()) {
        fail_at(path, "design", "must be a table, [design]");
    }
    const toml::table& table = *node->as_table();
    refuse_other_keys(table, {"kind", "samples", "seed"}, where);
    const std::vector<std::string> kinds = {"grid", "latin-hypercube", "sobol"};
    const std::string kind = text_at(table, "kind", where);
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end()) {
        fail_at(where, "kind", "'" + kind + "' is not one of " + list_of(kinds) + did_you_mean(kind, kinds));
    }
    Design design{.kind = static_cast<Design::Kind>(found - kinds.begin())};
    if (design.kind == Design::Kind::grid && table.contains("samples")) {
        fail_at(where, "samples", "is not read with the design \"grid\", which takes every combination");
    }
    if (design.kind != Design::Kind::latin_hypercube && table.contains("seed")) {
        fail_at(where, "seed", "is read only with the design \"latin-hypercube\"");
    }
    if (design.kind != Design::Kind::grid && !table.contains("samples")) {
        fail_at(where, "samples", "is missing: how many points the design has");
    }
    design.samples = whole_at(table, "samples", where, 0, 1, static_cast<std::int64_t>(most_structures));
    design.seed = static_cast<std::uint64_t>(whole_at(table, "seed", where, 1, 0, INT64_MAX));
    return design;
}

Verb generator_named(const std::string& name, const std::string& where) {
    for (const Verb& verb : {generate_vem_verb(), generate_brownian_verb()}) {
        if (verb.name == "generate " + name) {
            return verb;
        }
    }
    fail_at(where, "verb", "'" + name + "' is not one of vem, brownian" + did_you_mean(name, {"vem", "brownian"}));
}

/// The seed of a section with replicates; 1 when it is not given.
std::int64_t first_seed(const Section& section) {
    for (const Axis& axis : section.axes) {
        if (axis.option == "seed" && section.replicates > 1) {
            const auto* seed = axis.range || axis.values.size() > 1 ? nullptr : std::get_if<std::int64_t>(&axis.values.front());
            if (seed == nullptr) {
                fail_at(section.where, "replicates",
                        "excludes several values of seed: replicates take the seeds from a whole number on");
            }
            return *seed;
        }
    }
    return 1;
}

/// The axes of a grid, in which replicates are the values of the seed.
std::vector<Axis> with_replicates(const Section& section) {
    std::vector<Axis> axes = section.axes;
    if (section.replicates > 1) {
        std::erase_if(axes, [](const Axis& axis) { return axis.option == "seed"; });
        axes.push_back({"seed", {}});
        for (std::int64_t k = 0; k < section.replicates; ++k) {
            axes.back().values.emplace_back(first_seed(section) + k);
        }
    }
    return axes;
}

std::vector<Section> read_generators(const toml::table& root, const std::string& path, bool stepped) {
    const toml::node* node = root.get("generate");
    if (node == nullptr) {
        throw InputError(path + ": [[generate]] is missing: which generator makes the structures");
    }
    std::vector<const toml::table*> tables;
    if (const auto* table = node->as_table()) {
        tables.push_back(table);
    } else if (node->is_array_of_tables()) {
        for (const toml::node& entry : *node->as_array()) {
            tables.push_back(entry.as_table());
        }
    } else {
        fail_at(path, "generate", "must be a table, [[generate]]");
    }
    std::vector<Section> sections;
    for (const toml::table* table : tables) {
        const std::string where = path + ", [[generate]]" + (tables.size() > 1 ? " " + std::to_string(sections.size() + 1) : "");
        Section section = read_section(*table, generator_named(text_at(*table, "verb", where), where), where,
                                       fs::path(path).parent_path(), stepped);
        section.replicates = whole_at(*table, "replicates", where, 1, 1, static_cast<std::int64_t>(most_structures));
        first_seed(section);
        if (stepped) {
            section.axes = with_replicates(section);
            section.replicates = 1;
        }
        sections.push_back(std::move(section));
    }
    return sections;
}

std::optional<Section> read_stage(const toml::table& root, const char* key, Verb verb, const std::string& path, bool stepped) {
    const toml::node* node = root.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    if (!node->is_table()) {
        fail_at(path, key, std::string("must be a table, [") + key + "]");
    }
    if (node->as_table()->contains("replicates") || node->as_table()->contains("verb")) {
        fail_at(path + ", [" + key + "]", node->as_table()->contains("verb") ? "verb" : "replicates",
                "is read in [[generate]] only");
    }
    return read_section(*node->as_table(), std::move(verb), path + ", [" + key + "]", fs::path(path).parent_path(), stepped);
}

std::vector<std::pair<std::string, std::string>> read_card(const toml::table& root, const std::string& path) {
    std::vector<std::pair<std::string, std::string>> card;
    for (const char* key : {"title", "authors", "licence", "description"}) {
        if (const toml::node* node = root.get(key); node != nullptr && node->is_array() && std::string(key) == "authors") {
            std::string names;
            for (const toml::node& name : *node->as_array()) {
                if (!name.is_string()) {
                    fail_at(path, key, "must be a text, or a list of texts");
                }
                names += (names.empty() ? "" : ", ") + name.ref<std::string>();
            }
            card.emplace_back(key, names);
        } else if (node != nullptr) {
            card.emplace_back(key, text_at(root, key, path));
        }
    }
    return card;
}

/// Whether the structures keep what the stages found, or their particles alone.
bool read_whole(const toml::table& root, const std::string& path) {
    if (!root.contains("structures")) {
        return true;
    }
    const std::vector<std::string> kinds = {"whole", "particles"};
    const std::string kind = text_at(root, "structures", path);
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
        fail_at(path, "structures", "'" + kind + "' is not one of " + list_of(kinds) + did_you_mean(kind, kinds));
    }
    return kind == kinds.front();
}

std::string word_of(const Given& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        return *text;
    }
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        return std::to_string(*whole);
    }
    return to_text(std::get<double>(value));
}

/// The call on a command line that computes the same.
std::string call_of(const Verb& verb, const Values& values) {
    std::string call = "coagula " + verb.name;
    for (const auto& [name, value] : values) {
        const auto* flag = std::get_if<bool>(&value);
        call += flag == nullptr ? " --" + name + " " + word_of(value) : *flag ? " --" + name : "";
    }
    return call;
}

/// Options of a stage that many structures share are checked once.
class CheckedStage {
public:
    CheckedStage(const Section& section, void (*check)(const Arguments&)) : section_(section), check_(check) {}

    const std::pair<Arguments, Signature>& operator()(const Values& values) {
        const auto found = checked_.find(values);
        if (found != checked_.end()) {
            return found->second;
        }
        try {
            Arguments arguments(section_.verb, {values, call_of(section_.verb, values), Caller::file});
            check_(arguments);
            Signature signature = signature_of(section_.verb, arguments);
            return checked_.emplace(values, std::pair{std::move(arguments), std::move(signature)}).first->second;
        } catch (const InputError& error) {
            throw InputError(section_.where + ": " + error.what());
        } catch (const std::invalid_argument& error) {
            throw InputError(section_.where + ": " + error.what());
        }
    }

private:
    const Section& section_;
    void (*check_)(const Arguments&);
    std::map<Values, std::pair<Arguments, Signature>> checked_;
};

void check_generator(const Arguments& arguments) {
    if (arguments.verb() == generate_vem_verb().name) {
        generators::check(vem_run(arguments).expansion);
    } else {
        brownian_run(arguments);
    }
}

void append_rows(const Section& generate, const std::optional<Section>& characterize, const std::optional<Section>& shear,
                 const Design& design, bool whole, std::vector<SetRow>& rows) {
    constexpr std::size_t id_digits = 16;
    CheckedStage made(generate, check_generator);
    std::optional<CheckedStage> measured;
    std::optional<CheckedStage> sheared;
    if (characterize) {
        measured.emplace(*characterize, [](const Arguments& arguments) { characterize_run(arguments); });
    }
    if (shear) {
        sheared.emplace(*shear, [](const Arguments& arguments) { shear_run(arguments); });
    }
    Combinations(generate, characterize, shear).each(design, [&](const std::array<Values, 3>& values) {
        const auto& [first, made_of] = made(values[0]);
        SetRow row{.id = {},
                   .made_of = io::sha256(made_of.text),
                   .trajectory = io::sha256(made_of.of_trajectory),
                   .stop = made_of.stop,
                   .generate = first,
                   .characterize = {},
                   .shear = {},
                   .whole = whole};
        std::string all = (whole ? "" : "particles ") + made_of.text;
        if (measured) {
            const auto& [arguments, signature] = (*measured)(values[1]);
            row.characterize = arguments;
            all += signature.text;
        }
        if (sheared) {
            const auto& [arguments, signature] = (*sheared)(values[2]);
            row.shear = arguments;
            all += signature.text;
        }
        row.id = io::sha256(all).substr(0, id_digits);
        rows.push_back(std::move(row));
    });
}

void refuse_equal_rows(const std::vector<SetRow>& rows, const std::string& path) {
    std::set<std::string> seen;
    for (const SetRow& row : rows) {
        if (!seen.insert(row.id).second) {
            throw InputError(path + ": two structures of the sweep have the same options (" + row.generate.call() +
                             "): give the values once, or another seed");
        }
    }
}

}  // namespace

Sweep parse_sweep(const std::string& text, const std::string& path) {
    Sweep sweep{.path = path, .text = text};
    toml::table root;
    try {
        root = toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw InputError(path + ", line " + std::to_string(error.source().begin.line) +
                         ": not TOML: " + std::string(error.description()));
    }
    refuse_other_keys(
        root, {"title", "authors", "licence", "description", "design", "structures", "generate", "characterize", "shear"}, path);
    sweep.card = read_card(root, path);
    const Design design = read_design(root, path);
    const bool whole = read_whole(root, path);
    const bool stepped = design.kind == Design::Kind::grid;
    const std::vector<Section> generators = read_generators(root, path, stepped);
    const auto characterize = read_stage(root, "characterize", characterize_verb(), path, stepped);
    const auto shear = read_stage(root, "shear", shear_verb(), path, stepped);
    std::size_t count = 0;
    for (const Section& generate : generators) {
        count += Combinations(generate, characterize, shear).count(design);
        if (count > most_structures) {
            throw InputError(path + ": the sweep has more than " + std::to_string(most_structures) + " structures");
        }
    }
    for (const Section& generate : generators) {
        append_rows(generate, characterize, shear, design, whole, sweep.rows);
    }
    refuse_equal_rows(sweep.rows, path);
    sweep.characterized = characterize.has_value();
    sweep.sheared = shear.has_value();
    return sweep;
}

Sweep read_sweep(const std::string& path) {
    return parse_sweep(io::read_toml_text(path), path);
}

}  // namespace coagula::stages
