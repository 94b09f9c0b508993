// SPDX-License-Identifier: GPL-3.0-or-later
// What a call complains of.
#pragma once

#include <exception>
#include <string>

namespace coagula::testing {

/// The sentence of the exception that the call throws; empty when it throws none.
template <class Call>
std::string complaint(Call&& call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace coagula::testing
