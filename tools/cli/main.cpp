// SPDX-License-Identifier: GPL-3.0-or-later
// coagula: generate, characterize and shear random sphere packings. Chooses the verb and turns exceptions into exit codes.
#include "command_line.hpp"
#include "help_text.hpp"
#include "interruption.hpp"
#include "report.hpp"
#include "verbs.hpp"

#include <coagula/common/blas_kernels.hpp>
#include <coagula/common/failures.hpp>
#include <coagula/common/parallel.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/printable.hpp>
#include <coagula/io/standard_descriptors.hpp>

#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::tools {

namespace {

constexpr int failed = 1;
constexpr int wrong_usage = 2;
constexpr int exists_already = 3;
constexpr int out_of_reach = 4;

void print_program_help() {
    std::cout << "usage: coagula VERB [options]\n\n"
                 "Random sphere packings and coagulated particle gels: generate, characterize, shear.\n\nverbs:\n";
    for (const Verb& verb : all_verbs()) {
        std::string name = verb.name;
        name.resize(20, ' ');
        std::cout << "  " << name << verb.summary << '\n';
    }
    std::cout
        << "\noptions:\n"
           "  -h, --help    print this text; 'coagula VERB --help' lists the options of a verb\n"
           "  -V, --version print the version\n\n"
           "Quantities are SI numbers or carry a unit: 0.25um, 100N/m.\n"
           "Exit codes: 0 done, 1 failed, 2 wrong usage or bad input, 3 what would be written exists already (see --force),\n"
           "            4 no structure has what was asked for, such as a coordination number.\n"
           "An option that nothing would read beside the others is refused. Ctrl-C ends the program within two seconds; what is\n"
           "not complete by then is not written.\n";
}

/// The end of the sentence about words that begin with no verb; with the two words of a verb like "generate vem", if there are two.
std::string suggestion(const std::vector<std::string>& words) {
    std::vector<std::string> pairs;
    std::vector<std::string> singles = {"generate", "fit", "dataset"};
    for (const Verb& verb : all_verbs()) {
        (verb.name.find(' ') == std::string::npos ? singles : pairs).push_back(verb.name);
    }
    const std::string meant = words.size() > 1 ? did_you_mean(words[0] + ' ' + words[1], pairs) : std::string{};
    return meant.empty() ? did_you_mean(words[0], singles) : meant;
}

/// The verb with the longest name that the words begin with; they are removed.
const Command& take_command(std::vector<std::string>& words) {
    const Command* found = nullptr;
    std::size_t length = 0;
    for (const Command& command : commands()) {
        const std::vector<std::string> name = split(command.verb.name, ' ');
        if (name.size() > length && words.size() >= name.size() && std::equal(name.begin(), name.end(), words.begin())) {
            found = &command;
            length = name.size();
        }
    }
    if (found != nullptr) {
        words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(length));
        return *found;
    }
    if (words.front() == "fit") {
        throw InputError("'fit' needs the name of a law, and the one law is 'fit power-law'");
    }
    if (words.front() == "dataset") {
        throw InputError("'dataset' needs what to do: plan, run, table, verify, join or workflow" +
                         (words.size() > 1 ? suggestion(words) : std::string{}) + " (see 'coagula --help')");
    }
    if (words.front() == "generate") {
        throw InputError(words.size() > 1
                             ? "'generate " + words[1] +
                                   "' is not a verb: the generators are 'generate vem' and 'generate brownian'" + suggestion(words)
                             : "'generate' needs the name of a generator: 'generate vem' or 'generate brownian'");
    }
    throw InputError("'" + words.front() + "' is not a verb" + suggestion(words) + " (see 'coagula --help')");
}

void run(std::vector<std::string> words) {
    if (words.empty()) {
        throw InputError("a verb is missing (see 'coagula --help')");
    }
    const bool lists_names = words.size() == 2 && (words[0] == "generate" || words[0] == "fit" || words[0] == "dataset") &&
                             (words[1] == "--help" || words[1] == "-h");
    if (words.front() == "--help" || words.front() == "-h" || words.front() == "help" || lists_names) {
        print_program_help();
        flush_output();
        return;
    }
    if (words.front() == "--version" || words.front() == "-V") {
        std::cout << "coagula " << version_text() << '\n';
        flush_output();
        return;
    }
    const Command& command = take_command(words);
    const CommandLine line = read_command_line(command.verb, words);
    if (line.help_wanted) {
        std::cout << help_text(command.verb);
        flush_output();
        return;
    }
    const Arguments arguments(command.verb, line.call);
    omp_set_num_threads(
        usable_threads(arguments.has("threads") ? static_cast<int>(arguments.count("threads")) : omp_get_max_threads()));
    command.run(arguments);
    for (const std::string& note : line.notes) {  // of a call that failed, its one sentence is enough
        std::cerr << "coagula: " << note << std::endl;
    }
}

/// The word after --threads, or what follows it and an equals sign; empty where it is not asked for.
std::string threads_asked_for(char** argv) {
    const std::string option = "--threads";
    for (; *argv != nullptr; ++argv) {
        const std::string word = *argv;
        if (word == option && argv[1] != nullptr) {
            return argv[1];
        }
        if (word.starts_with(option + "=")) {
            return word.substr(option.size() + 1);
        }
    }
    return {};
}

/// Whether the variable had another value.
bool set(const char* variable, const std::string& value) {
    const char* before = std::getenv(variable);
    return (before == nullptr || before != value) && setenv(variable, value.c_str(), 1) == 0;
}

bool address_space_is_limited() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Memory in pages of 2 MB, from one heap that grows in large steps and keeps what is free: of the small pages of which a stage
/// asks the system again and again, each costs as much as thousands of operations (by glibc's manual, "Memory Allocation
/// Tunables").
constexpr const char* heap_settings =
    "glibc.malloc.hugetlb=1:glibc.malloc.mmap_max=0:glibc.malloc.top_pad=16777216:glibc.malloc.trim_threshold=1099511627776";

/// Threads that wait for each other shall spin for some microseconds only before they sleep: on a machine that also does other
/// work a spinning thread keeps its partner from the processor, and the void expansion took four times as long. No library shall
/// take more threads than were asked for or can be had: CHOLMOD's loops ask for four of their own. OpenBLAS shall not begin with a
/// thread and a buffer for each processor, for which it would wait for ever where there is no room. The libraries read their
/// environment before main, so the program starts itself once more; if that fails, it goes on as it is.
void restart_with_settings(char** argv) {
    const std::string word = threads_asked_for(argv);
    // libgomp has a sentence of its own for what is no number of threads; the program says it once.
    const bool number = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos && word.size() < 5;
    const int asked = number ? std::max(1, std::stoi(word)) : std::numeric_limits<int>::max();
    bool changed = set("OPENBLAS_NUM_THREADS", "1");
    const char* tunables = std::getenv("GLIBC_TUNABLES");
    const std::string others = tunables == nullptr || *tunables == '\0' ? "" : std::string(tunables) + ':';
    if (others.find("glibc.malloc.") == std::string::npos) {
        changed = set("GLIBC_TUNABLES", others + heap_settings) || changed;
    }
    if (std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr) {
        changed = set("GOMP_SPINCOUNT", "3000") || changed;
    }
    if (!changed || !address_space_is_limited()) {  // otherwise the buffers of OpenBLAS would count as taken
        changed = set("OMP_THREAD_LIMIT", std::to_string(usable_threads(asked))) || changed;
    }
    if (changed) {
        execv("/proc/self/exe", argv);
    }
}

int complain(const std::string& sentence, int code) {
    std::cerr << "coagula: " << io::printable(sentence) << std::endl;
    return code;
}

}  // namespace

}  // namespace coagula::tools

int main(int argc, char** argv) {
    using namespace coagula::tools;
    coagula::io::occupy_standard_descriptors();
    restart_with_settings(argv);
    coagula::take_newest_blas_kernels();
    install_signal_handlers();
    std::set_terminate(coagula::end_with_sentence);
    try {
        run(std::vector<std::string>(argv + 1, argv + argc));
        return 0;
    } catch (const coagula::ExistsAlready& error) {
        return complain(error.what(), exists_already);
    } catch (const coagula::OutOfReach& error) {
        return complain(error.what(), out_of_reach);
    } catch (const coagula::InputError& error) {
        return complain(error.what(), wrong_usage);
    } catch (const std::invalid_argument& error) {
        return complain(error.what(), wrong_usage);
    } catch (const std::filesystem::filesystem_error& error) {
        const bool too_long = error.code() == std::errc::filename_too_long;
        return complain(error.path1().string() + " cannot be used: " + error.code().message(), too_long ? wrong_usage : failed);
    } catch (const std::exception& error) {
        return complain(coagula::failure_sentence(error), failed);
    }
}
