// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/failures.hpp>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>
#include <typeinfo>

namespace coagula {

namespace {

/// The words of a text, which may have several lines, with one blank between them.
std::string on_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) {
        line += (line.empty() ? "" : " ") + word;
    }
    return line;
}

}  // namespace

std::string failure_sentence(const std::exception& error) {
    const bool no_memory =
        dynamic_cast<const std::bad_alloc*>(&error) != nullptr || dynamic_cast<const std::length_error*>(&error) != nullptr;
    if (no_memory) {
        return "there is not enough memory for this";
    }
    const bool own =
        typeid(error) == typeid(std::runtime_error) || std::string(typeid(error).name()).find("7coagula") != std::string::npos;
    return own ? error.what() : "the calculation failed where that was not foreseen (" + on_one_line(error.what()) + ")";
}

void end_with_sentence() {
    std::string sentence = "the calculation failed where that was not foreseen";
    try {
        if (const std::exception_ptr error = std::current_exception()) {
            std::rethrow_exception(error);
        }
    } catch (const std::exception& error) {
        sentence = failure_sentence(error);
    } catch (...) {  // not an std::exception: the general sentence stays
    }
    std::fprintf(stderr, "coagula: %s\n", sentence.c_str());
    std::_Exit(EXIT_FAILURE);
}

}  // namespace coagula
