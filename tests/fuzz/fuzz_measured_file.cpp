// CSV, RheoCompass and TRIOS: the format is recognised by the content.
#include <coagula/io/measured_file.hpp>

#include "reader_contract.hpp"

namespace {

using namespace coagula;

void check_table(const io::PlainTable& table) {
    fuzz::expect(table.point >= 0 && table.announced_points >= 0 && table.section >= 0, "a count of a table is negative");
    for (const io::PlainColumn& column : table.columns) {
        fuzz::expect(column.values.size() == table.rows(), "a column is not as long as the first");
        for (const double value : column.values) {
            fuzz::expect(!std::isinf(value), "a number is infinite");
        }
    }
    for (const io::UnreadableCell& cell : table.unreadable) {
        fuzz::expect(cell.column < table.columns.size() && cell.row < table.rows(), "an unreadable cell lies outside its table");
        fuzz::expect(std::isnan(table.columns[cell.column].values[cell.row]), "an unreadable cell has a number");
        fuzz::expect(!cell.reason.empty(), "an unreadable cell has no reason");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string path = fuzz::input_file(data, size, "measured.csv");
    fuzz::expect_value_or_sentence(path, [&] {
        for (const io::PlainTable& table : io::read_measured_file(path).tables) {
            check_table(table);
        }
    });
    return 0;
}
