// SPDX-License-Identifier: GPL-3.0-or-later
// An experiment file and, after a line "=== table", the file "table" beside it that its measurements may name.
#include "reader_contract.hpp"

#include <coagula/diagnose/check_data.hpp>
#include <coagula/experiment/experiment_file.hpp>

namespace {

using namespace coagula;

void check_measurement(const diagnose::Measurement& measurement) {
    fuzz::expect(measurement.oscillations >= 1 && measurement.run_order >= 0, "a count of a measurement is impossible");
    for (const diagnose::Column& column : diagnose::check_data(measurement).measurement.columns) {
        fuzz::expect(column.values.size() == measurement.rows(), "column " + column.name + " is not as long as the first");
        for (const double value : column.values) {
            fuzz::expect(!std::isinf(value), "column " + column.name + " has an infinite number");
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    constexpr std::string_view separator = "=== table\n";
    const std::string_view input = fuzz::text_of(data, size);
    const std::size_t end = std::min(input.find(separator), input.size());
    const std::string path = folder.write("experiment.toml", input.substr(0, end));
    folder.write("table", input.substr(std::min(end + separator.size(), input.size())));
    fuzz::expect_value_or_sentence("", [&] {
        const experiment::ExperimentFile file = experiment::read_experiment(path);
        for (const diagnose::Measurement& measurement : file.experiment.measurements) {
            check_measurement(measurement);
        }
    });
    return 0;
}
