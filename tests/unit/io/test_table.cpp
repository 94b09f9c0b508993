// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/table.hpp>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

using Table = TemporaryFolder;

const std::vector<TableColumn> columns{{.name = "a", .unit = "1"},
                                       {.name = "Modulus", .unit = "Pa"},
                                       {.name = "error", .unit = "Pa", .default_unit = 1e3, .required = false}};

TEST_F(Table, ColumnsInAnyOrderWithUnits) {
    const std::string path =
        write("t.csv", "# measured\n\nname;modulus [MPa];A;error\r\nfirst;1.5;0.3;20\n\"second; best\";2;+0.5;30\n");
    const auto found = read_table(path, columns);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0], Eigen::Vector2d(0.3, 0.5));
    EXPECT_EQ(found[1], Eigen::Vector2d(1.5e6, 2e6));
    EXPECT_EQ(found[2], Eigen::Vector2d(2e4, 3e4));
}

TEST_F(Table, ColumnThatNeedNotBeThere) {
    const auto found = read_table(write("t.csv", "a,modulus (Pa)\n1,2\n"), columns);
    EXPECT_EQ(found[1], Eigen::VectorXd::Constant(1, 2));
    EXPECT_EQ(found[2].size(), 0);
    EXPECT_EQ(read_table(write("u.csv", "a,modulus [Pa]\n"), columns)[0].size(), 0);
}

TEST_F(Table, NamesFileLineAndRule) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"", " has no header"},
        {"# only a comment\n", " has no header"},
        {"a,b\n1,2\n", ", line 1: there is no column Modulus; the first line must be a header that names it"},
        {"a,modulus\n1,2\n", ", line 1: column modulus names no unit: write modulus [Pa]"},
        {"a,modulus [m]\n1,2\n",
         ", line 1: column modulus: 'm' is not a unit of the dimension of Pa: 'm' has another dimension than the expected unit Pa"},
        {"a,modulus [Pa]\n1\n", ", line 2: there are 1 fields, but the header names 2"},
        {"a,modulus [Pa]\n1,2\n\n1,two\n", ", line 4: modulus is 'two', which is not a number"},
        {"a,modulus [kPa]\n1,1e307\n", ", line 2: Modulus is too large a number in Pa"},
        {std::string("a,modulus [Pa]\n1,2\0\n", 20), " is not a text file"},
        {"a,modulus [Pa]\n1,inf\n", ", line 2: modulus is 'inf', but must be finite"},
    };
    for (const auto& [contents, rule] : files) {
        const std::string path = write("bad.csv", contents);
        EXPECT_EQ(sentence<InputError>([&] { read_table(path, columns); }), path + rule) << contents;
    }
    EXPECT_EQ(sentence<InputError>([&] { read_table(file("none.csv"), columns); }), file("none.csv") + " does not exist");
}

TEST_F(Table, KeepsTheRangeOfAColumn) {
    const std::vector<TableColumn> lengths{{.name = "a", .unit = "m", .low = 1e-9, .high = 1e-6}};
    EXPECT_EQ(read_table(write("t.csv", "a [um]\n0.5\n"), lengths)[0], Eigen::VectorXd::Constant(1, 5e-7));
    const std::string path = write("bad.csv", "a [nm]\n2\n-2\n");
    EXPECT_EQ(sentence<InputError>([&] { read_table(path, lengths); }),
              path + ", line 3: a is -2e-09 m, but must be 1e-09 .. 1e-06 m");
}

TEST_F(Table, WritesNoFormulas) {
    EXPECT_EQ(csv_text({{"=1+1", "+1", "-1e-3", "-x", "@a", "a=b", "+", "-inf"}}), "'=1+1,'+1,-1e-3,'-x,'@a,a=b,'+,-inf\n");
    EXPECT_EQ(csv_text({{"\t=1", "=a,b", "\r=1"}}), "\"'\t=1\",\"'=a,b\",\"'\r=1\"\n");
}

TEST_F(Table, WritesWhatItReads) {
    write_rows(file("t.csv"), {{"name", "a", "modulus [Pa]"}, {"x, \"y\"", to_text(0.1), to_text(1.0 / 3)}, {"", "2", "3e6"}},
               false);
    EXPECT_EQ(read(file("t.csv")), "name,a,modulus [Pa]\n\"x, \"\"y\"\"\",0.1,0.3333333333333333\n,2,3e6\n");
    const auto found = read_table(file("t.csv"), columns);
    EXPECT_EQ(found[0], Eigen::Vector2d(0.1, 2));
    EXPECT_EQ(found[1], Eigen::Vector2d(1.0 / 3, 3e6));
    EXPECT_THROW(write_rows(file("t.csv"), {{"a"}}, false), InputError);
    write_rows(file("t.csv"), {{"a"}}, true);
    EXPECT_EQ(read(file("t.csv")), "a\n");
    EXPECT_EQ(entries().size(), 1U);
}

}  // namespace
}  // namespace coagula::io
