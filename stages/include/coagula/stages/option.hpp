// SPDX-License-Identifier: GPL-3.0-or-later
// The table of a verb's options. Parsing, range checks, help text, manual page, completion, signatures of Python and provenance
// follow from it.
#pragma once

#include <limits>
#include <set>
#include <string>
#include <vector>

namespace coagula::stages {

/// The values an option may take.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool ends_included = true;

    bool holds(double value) const;
    /// The range as text, such as "> 0", "> 0 and < 1", "3 .. 100". It is empty when everything is allowed.
    std::string text() const;
};
Range at_least(double low);
Range above(double low);
/// Both ends excluded.
Range between(double low, double high);
/// Both ends included.
Range within(double low, double high);

/// What a quantity can be in any laboratory and far beyond: wide enough for colloids and granulates, narrow enough that no product
/// of some of them leaves the range of numbers.
namespace physical {
inline constexpr Range length{1e-12, 1e3};      // m
inline constexpr Range stiffness{1e-12, 1e15};  // N/m
inline constexpr Range friction{0, 1e6};
inline constexpr Range time{1e-15, 1e12};       // s
inline constexpr Range duration{0, 1e12};       // s
inline constexpr Range frequency{1e-12, 1e12};  // Hz
inline constexpr Range modulus{1e-9, 1e18};     // Pa
inline constexpr Range strain{1e-15, 10};
}  // namespace physical

/// What must hold of another option so that one is read.
struct Condition {
    std::string option;
    std::vector<std::string> values;  ///< the option has one of these; empty: it is given
    bool wanted;                      ///< false: the opposite must hold
};

struct Option {
    enum class Kind { flag, count, quantity, text };
    enum class File { none, read, written };

    Kind kind = Kind::flag;
    std::string name = {};
    std::string placeholder = {};           ///< of the value in the help text
    std::string meaning = {};               ///< one line
    std::string unit = {};                  ///< UDUNITS text of a quantity
    std::string fallback = {};              ///< default as one would type it; empty: none
    Range range = {};                       ///< of counts and quantities, in `unit`
    std::vector<std::string> choices = {};  ///< of a text; empty: any
    bool required = false;
    char letter = 0;         ///< short name
    File file = File::none;  ///< whether its text names a file, and what becomes of that
    /// The largest length without a unit. A larger number is refused, because its unit was more likely forgotten than metres meant.
    double largest_bare = std::numeric_limits<double>::infinity();
    std::vector<Condition> conditions = {};  ///< under which the option is read; otherwise it is refused
    std::string former_name = {};            ///< which still works, and is said to be old

    bool goes_by(const std::string& written) const { return written == name || (!written.empty() && written == former_name); }
};

Option flag(std::string name, std::string meaning);
/// A whole number.
Option count(std::string name, std::string meaning, std::string fallback, Range range);
/// A number with a unit.
Option quantity(std::string name, std::string unit, std::string meaning, std::string fallback, Range range);
/// A radius of particles. Metres without a unit are taken up to a decimetre only.
Option particle_radius(std::string meaning);
Option text(std::string name, std::string placeholder, std::string meaning, std::string fallback = {});
Option choice(std::string name, std::vector<std::string> choices, std::string meaning, std::string fallback);
Option required(Option option);
/// The option had another name in an earlier version.
Option formerly(std::string name, Option option);
/// A text that names a file, which the call reads.
Option reads(Option option);
/// A text that names a file, which the call writes.
Option writes(Option option);
/// -o FILE
Option output(std::string meaning);

/// The options of these names are read only beside another one: where that has one of the values or, without values, is given.
void read_only_with(std::vector<Option>& options, const std::vector<std::string>& names, const std::string& other,
                    const std::vector<std::string>& values = {});
/// They are not read beside it.
void not_read_with(std::vector<Option>& options, const std::vector<std::string>& names, const std::string& other,
                   const std::vector<std::string>& values = {});

/// What the program and the Python module can be asked to do.
struct Verb {
    std::string name;                     ///< "generate vem"
    std::string summary;                  ///< one line
    std::string input;                    ///< what the argument without a name is, "FILE.h5"; empty: there is none
    std::vector<Option> options;          ///< without those that every verb has
    std::vector<std::string> notes = {};  ///< lines below the options in the help text
    bool many_inputs = false;             ///< whether several arguments without a name may be given
    std::string many_beside = {};         ///< name of a flag beside which they may be, too
    std::string alone = {};               ///< name of a flag beside which no argument without a name is needed
    bool input_required = true;
    std::vector<std::string> input_choices = {};  ///< of the argument without a name; empty: any
};

/// The verb without its files: it works on what its caller has, and leaves there what it finds.
/// @param without names of further options that have no meaning then.
Verb in_memory(Verb verb, const std::set<std::string>& without = {});

/// The options of a verb with those that every verb has; in front the argument without a name, as "input", if there is one.
std::vector<Option> all_options(const Verb& verb);

}  // namespace coagula::stages
