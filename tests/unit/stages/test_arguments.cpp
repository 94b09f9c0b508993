// SPDX-License-Identifier: GPL-3.0-or-later
// Options from command lines, sweep files and Python: one converter, and names as the caller spells them.
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/shear.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::stages {
namespace {

Call vem_call(Caller caller, const Given& fraction) {
    return {{{"particles", std::int64_t{60}}, {"volume-fraction", fraction}, {"radius", 2.5e-7}}, "", caller};
}

std::string refusal(const Verb& verb, const Call& call) {
    try {
        const Arguments arguments(verb, call);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Arguments, NumbersAndWordsMeanTheSame) {
    const Verb verb = in_memory(generate_vem_verb());
    const Arguments numbers(verb, vem_call(Caller::python, 0.4));
    Call words{{{"particles", std::string("60")}, {"volume-fraction", std::string("40%")}, {"radius", std::string("0.25um")}}};
    const Arguments from_words(verb, words);
    EXPECT_EQ(numbers.to_json(), from_words.to_json());
    EXPECT_EQ(numbers.quantity("radius"), 2.5e-7);
}

TEST(Arguments, SentencesSpellTheOptionAsTheCallerDoes) {
    const Verb verb = in_memory(generate_vem_verb());
    EXPECT_EQ(refusal(verb, vem_call(Caller::program, 0.9)),
              "--volume-fraction: '0.9' is out of range: must be > 0 and < 0.64 (see 'coagula generate vem --help')");
    EXPECT_EQ(refusal(verb, vem_call(Caller::python, 0.9)),
              "volume_fraction: '0.9' is out of range: must be > 0 and < 0.64 (see help(coagula.generate_vem))");
    EXPECT_EQ(refusal(verb, vem_call(Caller::file, 0.9)),
              "volume-fraction: '0.9' is out of range: must be > 0 and < 0.64 (see 'coagula generate vem --help')");
}

TEST(Arguments, ConditionsSpellTheOtherOption) {
    const Verb verb = in_memory(shear_verb());
    EXPECT_EQ(refusal(verb, {{{"ramp", 0.1}}, "", Caller::python}),
              "ramp is read only with method='quasistatic' (see help(coagula.shear))");
    EXPECT_EQ(refusal(verb, {{{"ramp", 0.1}}, "", Caller::program}),
              "--ramp is read only with --method quasistatic (see 'coagula shear --help')");
}

TEST(Arguments, ANumberOfAnotherKindIsRefused) {
    const Verb verb = in_memory(generate_vem_verb());
    Call call = vem_call(Caller::file, 0.4);
    call.values["particles"] = 60.5;
    EXPECT_EQ(refusal(verb, call), "particles: '60.5' is not a whole number (see 'coagula generate vem --help')");
    call.values["particles"] = true;
    EXPECT_EQ(refusal(verb, call), "particles: 'true' is not a whole number (see 'coagula generate vem --help')");
    call.values["particles"] = 1e3;
    EXPECT_EQ(Arguments(verb, call).count("particles"), 1000);
    EXPECT_EQ(refusal(in_memory(shear_verb()),
                      {{{"method", std::string("dem")}, {"constant-amplitude", std::int64_t{1}}}, "", Caller::file}),
              "constant-amplitude: '1' is neither true nor false (see 'coagula shear --help')");
}

TEST(Arguments, ListsOfNumbersAreListsOfWords) {
    const Verb verb = in_memory(shear_verb());
    const Arguments arguments(verb, {{{"frequency", std::vector<GivenItem>{1.0, std::string("10Hz"), std::int64_t{100}}}}});
    EXPECT_EQ(shear_run(arguments).frequencies, (std::vector<double>{1, 10, 100}));
}

}  // namespace
}  // namespace coagula::stages
