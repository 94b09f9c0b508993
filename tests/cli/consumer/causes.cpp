// SPDX-License-Identifier: GPL-3.0-or-later
// Another: the causes that a diagnosis knows.
#include <coagula/report/diagnosis_catalogue.hpp>

#include <iostream>

int main() {
    std::cout << coagula::report::catalogue_table();
}
