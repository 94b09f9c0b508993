// SPDX-License-Identifier: GPL-3.0-or-later
// Exports as they come: shifted, with blank lines, in French, side by side, with a clock, in workbooks.
#include "instrument_exports.hpp"

#include <coagula/io/date_time.hpp>

#include "support/reference_data.hpp"

#include <numbers>

namespace coagula::io {
namespace {

class ExportVariants : public TemporaryFolder {
protected:
    PlainTable table_of(const std::string& text) { return read_measured_file(write("t.csv", text)).tables.front(); }
};

constexpr double degree = std::numbers::pi / 180;

TEST_F(ExportVariants, RowsThatLostTheirEmptyFirstCellGetItBack) {
    const PlainTable sweep = read_measured_file(testing::dataset("rheocompass_variants/frequency_sweep.csv")).tables.at(0);
    const auto omega = values(sweep, "angular_frequency", "rad/s");
    const auto storage = values(sweep, "storage_modulus", "Pa");
    const auto loss = values(sweep, "loss_modulus", "Pa");
    ASSERT_EQ(sweep.rows(), 10U);
    EXPECT_EQ(omega.front(), 0.1);
    EXPECT_EQ(omega.back(), 100);
    EXPECT_EQ(storage.front(), 1000);
    EXPECT_EQ(storage.back(), 3300);
    EXPECT_EQ(loss.front(), 100);
    EXPECT_EQ(loss.back(), 4200);
    for (std::size_t row = 0; row < 10; ++row) {
        EXPECT_NEAR(std::hypot(storage[row], loss[row]) / values(sweep, "complex_modulus", "Pa")[row], 1, 0.01);
        EXPECT_NEAR(std::atan(loss[row] / storage[row]) / values(sweep, "phase", "rad")[row], 1, 0.01);
    }
}

/// The same with numbers of points, with the rows as they should be, and with more lost than can be told.
TEST_F(ExportVariants, WhatIsLostAtTheBeginningOfRowsIsTold) {
    const std::string head =
        "Test:\tA\nInterval and data points:\t1\t2\nInterval data:\tPoint No.\tAngular "
        "Frequency\tG'\tG''\n\t\t[rad/s]\t[Pa]\t[Pa]\n";
    EXPECT_EQ(values(table_of(head + "1\t1\t100\t10\n2\t10\t120\t20\n"), "storage_modulus", "Pa"), (std::vector<double>{100, 120}));
    EXPECT_EQ(values(table_of(head + "\t1\t1\t100\t10\n2\t10\t120\t20\n"), "loss_modulus", "Pa"), (std::vector<double>{10, 20}));
    const std::string plain = "Test:\tA\nInterval data:\tAngular Frequency\tG'\tG''\n\t[rad/s]\t[Pa]\t[Pa]\n";
    EXPECT_EQ(values(table_of(plain + "\t1\t100\t10\n\t10\t120\t20\n"), "storage_modulus", "Pa"), (std::vector<double>{100, 120}));
    const std::string path = write("lost.csv", plain + "1\t100\t10\n100\t10\n");
    EXPECT_EQ(sentence<InputError>([&] { read_measured_file(path); }),
              path +
                  ", line 5: there are 2 cells, but the headings name 4, and the first cell, which is empty in such exports, is "
                  "not: cells "
                  "at the beginnings of lines were lost; export the measurement again");
}

TEST_F(ExportVariants, BlankLinesBetweenAllLinesPartNothing) {
    const MeasuredFile file = read_measured_file(testing::dataset("rheocompass_variants/cnf_10c.csv"));
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    EXPECT_TRUE(file.decimal_comma);
    ASSERT_EQ(file.tables.size(), 1U);
    const PlainTable& sweep = file.tables[0];
    EXPECT_EQ(sweep.test, "cnf(0.3%), mc(1.2%), zn(1.2%)");
    EXPECT_EQ(sweep.title, "Frequency sweep 10C-cooling");
    ASSERT_EQ(sweep.rows(), 21U);
    const auto first_three = [&](const char* name, const char* unit) {
        const auto all = values(sweep, name, unit);
        return std::vector<double>(all.begin(), all.begin() + 3);
    };
    EXPECT_EQ(first_three("angular_frequency", "rad/s"), (std::vector<double>{100, 63.1, 39.8}));
    EXPECT_EQ(first_three("storage_modulus", "Pa"), (std::vector<double>{311.76, 294.61, 259.54}));
    EXPECT_EQ(first_three("loss_modulus", "Pa"), (std::vector<double>{257.94, 186.17, 153.88}));
    EXPECT_EQ(sweep.first_line, 13U);  // as an editor counts
    // A CSV likewise, and an error that names the line of the file.
    const std::string csv = "ω [rad/s],G' [Pa]\r\n\r\n1,100\r\n\r\n2,120\r\n\r\n3,130\r\n\r\n4,140\r\n\r\n";
    EXPECT_EQ(values(table_of(csv), "storage_modulus", "Pa"), (std::vector<double>{100, 120, 130, 140}));
    const std::string path = write("short.csv", csv + "5\r\n\r\n6,150\r\n\r\n");
    EXPECT_NE(sentence<InputError>([&] { read_measured_file(path); }).find(", line 11: there are 1 fields"), std::string::npos);
}

TEST_F(ExportVariants, RheoWinInFrenchWithQuotationMarksInHeadings) {
    const MeasuredFile file = read_measured_file(testing::dataset("restylane_rheowin/Restylane_syringe_1.txt"));
    EXPECT_EQ(file.format, MeasuredFormat::rheowin);
    EXPECT_FALSE(file.decimal_comma);
    ASSERT_EQ(file.tables.size(), 10U);
    EXPECT_EQ(file.tables[0].date, seconds_of_date(2019, 3, 27, 10, 17, 48));
    const PlainTable& first = file.tables[0];
    const auto storage = values(first, "storage_modulus", "Pa");
    const auto loss = values(first, "loss_modulus", "Pa");
    EXPECT_EQ(storage, (std::vector<double>{782, 783, 786, 787, 783, 781}));
    EXPECT_NEAR(loss[0] / storage[0], std::tan(10.8 * degree), 0.002);
    EXPECT_NEAR(values(first, "phase", "rad")[0], 10.8 * degree, 1e-12);
    EXPECT_DOUBLE_EQ(values(first, "strain", "1")[0], 0.0008);
    EXPECT_DOUBLE_EQ(values(first, "torque", "N.m")[5], 1.57e-6);
    EXPECT_EQ(values(first, "frequency", "Hz")[0], 0.2);
    EXPECT_EQ(values(first, "time", "s")[1], 24.02);
    EXPECT_EQ(file.tables[9].rows(), 1U);
    for (const PlainTable& table : file.tables) {
        const auto stress = values(table, "stress", "Pa");
        const auto strain = values(table, "strain", "1");
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const double modulus =
                std::hypot(values(table, "storage_modulus", "Pa")[row], values(table, "loss_modulus", "Pa")[row]);
            EXPECT_NEAR(modulus * strain[row] / stress[row], 1, 0.1);
        }
    }
}

TEST_F(ExportVariants, QuotationMarksSplitAsInACsv) {
    const auto heading = [&](const std::string& line) {
        const PlainTable table = table_of(line + "\n1,2,3\n2,3,4\n");
        return table.columns.at(1).quantity + " " + table.columns.at(1).unit + ", " + table.columns.at(2).heading;
    };
    EXPECT_EQ(heading("t [s],G\" [Pa],x"), "loss_modulus Pa, x");
    EXPECT_EQ(heading("t [s],\"G\"\" [Pa]\",rest"), "loss_modulus Pa, rest");
    EXPECT_EQ(heading("t [s],\"G'' [Pa]\",\"a, b\""), "loss_modulus Pa, a, b");
    EXPECT_EQ(heading("t [s], \"G\" [kPa]\",5\" gap"), "loss_modulus kPa, 5\" gap");
}

TEST_F(ExportVariants, HeadingsWithWordSymbolAndUnit) {
    const auto check = [&](const std::string& heading, const std::string& quantity, const std::string& unit) {
        const PlainTable table = table_of(heading + ";rest\n1;2\n2;3\n");
        EXPECT_EQ(table.columns.front().quantity, quantity) << heading;
        EXPECT_EQ(table.columns.front().unit, unit) << heading;
    };
    check("Speichermodul G' [kPa]", "storage_modulus", "kPa");
    check("Storage modulus (G') [kPa]", "storage_modulus", "kPa");
    check("Storage modulus (G′) (MPa)", "storage_modulus", "MPa");
    check("G' (storage modulus) in Pa", "storage_modulus", "Pa");
    check("Storage modulus [G']", "storage_modulus", "");
    check("Verlustmodul, G'' / Pa", "loss_modulus", "Pa");
    check("Module de perte G'' en Pa", "loss_modulus", "Pa");
    check("G' en Pa", "storage_modulus", "Pa");
    check("G' in Pa", "storage_modulus", "Pa");
    check("Gp", "storage_modulus", "");
    check("Gpp [Pa]", "loss_modulus", "Pa");
    check("G_double_prime (kPa)", "loss_modulus", "kPa");
    check("ɣ [%]", "strain", "%");
    check("Strain γ %", "strain", "%");
    check("Loss factor tan(δ) [1]", "loss_tangent", "1");
    check("Complex viscosity |η*| [Pa·s]", "complex_viscosity", "Pa.s");
    check("Phasenwinkel δ [°]", "phase", "°");
    check("Frequency [rad/s]", "angular_frequency", "rad/s");
    check("Freq (rad s⁻¹)", "angular_frequency", "rad s-1");
    check("Freq. [Hz]", "frequency", "Hz");
    check("w [rad/s]", "angular_frequency", "rad/s");
    check("Shear modulus (elastic component)(Pa)", "storage_modulus", "Pa");
    check("Shear modulus (viscous component)(Pa)", "loss_modulus", "Pa");
    check("Time (sequence)(s)", "time", "s");
    check("ShearRate_1_s", "shear_rate", "1/s");
    check("StorageModulus_kPa", "storage_modulus", "kPa");
    check("Complex_Viscosity_Pa_s", "complex_viscosity", "Pa.s");
    // Two meanings, a sample and a clock that starts anew are none of these.
    check("Stress strain", "", "");
    check("G' A", "", "");
    check("Time (action)(s)", "", "s");
}

TEST_F(ExportVariants, TablesSideBySideAreTold) {
    const MeasuredFile file = read_measured_file(testing::dataset("ttw_wide_table/ttw_70.csv"));
    ASSERT_EQ(file.tables.size(), 7U);
    for (const PlainTable& table : file.tables) {
        EXPECT_EQ(table.rows(), 16U);
        EXPECT_EQ(table.columns.size(), 3U);
        EXPECT_EQ(table.columns[0].quantity, "angular_frequency");
        EXPECT_EQ(table.columns[0].values[1], 0.2);
    }
    EXPECT_EQ(file.tables[0].title, "20");
    EXPECT_EQ(file.tables[6].title, "50");
    EXPECT_EQ(file.tables[0].columns[1].quantity, "storage_modulus");
    EXPECT_EQ(file.tables[0].columns[1].values[0], 1710);
    EXPECT_EQ(file.tables[6].columns[2].quantity, "loss_modulus");
    EXPECT_EQ(file.tables[6].columns[2].values[0], 93.2);
}

TEST_F(ExportVariants, TablesSideBySideWithAxesOfTheirOwnTemperaturesAndSamples) {
    const MeasuredFile own = read_measured_file(write("own.csv",
                                                      "Gel A,,,,\n20 °C,,,T = 30 °C,\nω [rad/s],G' [Pa],,ω [rad/s],G' [Pa]\n"
                                                      "1,100,,1,110\n2,120,,3,130\n4,140,,,\n"));
    ASSERT_EQ(own.tables.size(), 2U);
    EXPECT_EQ(own.tables[1].title, "Gel A, T = 30 °C");
    EXPECT_EQ(own.tables[0].rows(), 3U);
    EXPECT_EQ(values(own.tables[1], "angular_frequency", "rad/s"), (std::vector<double>{1, 3}));
    EXPECT_NEAR(values(own.tables[1], "temperature", "K")[1], 303.15, 1e-9);
    const MeasuredFile samples =
        read_measured_file(write("samples.csv", ",Gel A,Gel B\nω [rad/s],G' [Pa],G' [Pa]\n1,100,50\n2,120,60\n"));
    ASSERT_EQ(samples.tables.size(), 2U);
    EXPECT_EQ(samples.tables[1].test, "Gel B");
    EXPECT_EQ(values(samples.tables[1], "storage_modulus", "Pa"), (std::vector<double>{50, 60}));
    // Without labels one heading that stands there twice may be a mistake, and is left to the experiment.
    EXPECT_EQ(read_measured_file(write("twice.csv", "ω [rad/s],G' [Pa],G' [Pa]\n1,100,50\n2,120,60\n")).tables.size(), 1U);
}

/// The clock says what came first, not the order of the file: a program may sort rows by frequency.
TEST_F(ExportVariants, AClockGivesRowsTheirTimes) {
    const auto table_with = [&](const std::string& headings, const std::vector<std::string>& times) {
        std::string text = headings + ",G' [Pa],ω [rad/s]\n";
        for (std::size_t row = 0; row < times.size(); ++row) {
            text += times[row] + "," + std::to_string(100 + row) + "," + std::to_string(row + 1) + "\n";
        }
        return read_measured_file(write("clock.csv", text)).tables.front();
    };
    const auto times_of = [](const PlainTable& table) {
        const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                        [](const PlainColumn& column) { return column.quantity == "time"; });
        return found == table.columns.end() ? std::vector<double>{} : found->values;
    };
    const PlainTable against = table_with("Time of Day", {"10:03:00", "10:02:00", "10:01:00"});
    EXPECT_EQ(times_of(against), (std::vector<double>{180, 120, 60}));
    EXPECT_EQ(against.date, 10 * 3600);
    const PlainTable over_midnight = table_with("Absolute time", {"23:58:00", "23:59:00", "00:01:00"});
    EXPECT_EQ(times_of(over_midnight), (std::vector<double>{90, 150, 270}));
    const PlainTable back_over_midnight = table_with("Time of Day", {"00:01:00", "23:59:00", "23:58:00"});
    EXPECT_EQ(times_of(back_over_midnight), (std::vector<double>{270, 150, 90}));
    const PlainTable dated = table_with("Date,Time of Day", {"2019-03-27,23:59:00", "2019-03-28,00:00:00", "2019-03-28,00:02:00"});
    EXPECT_EQ(times_of(dated), (std::vector<double>{90, 150, 270}));
    EXPECT_EQ(dated.date, seconds_of_date(2019, 3, 27, 23, 57, 30));
    EXPECT_TRUE(times_of(table_with("Time of Day", {"10:00", "10:00", "10:00"})).empty());  // when it was exported
    EXPECT_EQ(times_of(table_with("Time of Day,Time [s]", {"10:03:00,1", "10:02:00,2", "10:01:00,3"})),
              (std::vector<double>{1, 2, 3}));
}

TEST_F(ExportVariants, AClockSaysWhenATableBegan) {
    const auto dates = [&](const std::string& column, const std::vector<std::string>& times) {
        std::string text;
        for (const std::string& time : times) {
            text += column + ",G' [Pa],ω [rad/s]\n" + time + ",100,1\n" + time + ",110,2\n\n";
        }
        std::vector<double> found;
        for (const PlainTable& table : read_measured_file(write("clock.csv", text)).tables) {
            found.push_back(table.date);
        }
        return found;
    };
    EXPECT_EQ(dates("Time of Day", {"10:17:48", "10:40:00"}), (std::vector<double>{37068, 38400}));
    EXPECT_EQ(dates("Uhrzeit", {"11:50 PM", "1:10 AM", "12:20 AM"}), (std::vector<double>{85800, 90600, 87600}));  // over midnight
    EXPECT_EQ(dates("Date Time", {"2019-03-27 10:17:48"}).front(), seconds_of_date(2019, 3, 27, 10, 17, 48));
    EXPECT_TRUE(std::isnan(dates("Time of Day", {"noon"}).front()));
    // A row is finished at its time: the first of three that take ten minutes began ten minutes earlier.
    const std::string rows = "09:50:00\t100\t1\n10:00:00\t110\t2\n10:10:00\t120\t3\n";
    const std::string headings = "[step]\nA\nTime of day\tStorage modulus\tAngular frequency\n\tPa\trad/s\n";
    EXPECT_EQ(table_of(headings + rows).date, 9 * 3600 + 40 * 60);
    // The head of the file names the day.
    const PlainTable dated = table_of("Run date\t3/27/2019 9:30:00 AM\n" + headings + rows);
    EXPECT_EQ(dated.date, seconds_of_date(2019, 3, 27, 9, 40, 0));
    const PlainTable night = table_of("Run date\t3/27/2019 11:30:00 PM\n" + headings + "00:10:00\t100\t1\n00:20:00\t110\t2\n");
    EXPECT_EQ(night.date, seconds_of_date(2019, 3, 28, 0, 0, 0));
}

TEST_F(ExportVariants, WorkbooksOfXmlAreReadLikeOldOnes) {
    const MeasuredFile flow = read_measured_file(testing::dataset("blood_steps/SS.xlsx"));
    EXPECT_EQ(flow.format, MeasuredFormat::workbook);
    const auto stress = values(flow.tables.at(0), "stress", "Pa");
    const auto rate = values(flow.tables.at(0), "shear_rate", "1/s");
    ASSERT_EQ(stress.size(), 16U);
    EXPECT_DOUBLE_EQ(stress[0], 0.0453203);
    EXPECT_NEAR(stress[15] / rate[15], values(flow.tables[0], "viscosity", "Pa.s")[15], 1e-3);
    const MeasuredFile steps = read_measured_file(testing::dataset("blood_steps/Steps.xlsx"));
    ASSERT_EQ(steps.tables.size(), 6U);
    EXPECT_EQ(steps.tables[5].title, "Up_0p1_20p0");
    // The same measurements as a text and as a workbook of RheoCompass.
    const std::string folder = "rheodata_toolkit/anton_paar/yulings_data/";
    const PlainTable text = read_measured_file(testing::dataset(folder + "amplitudesweep.csv")).tables.front();
    const PlainTable book = read_measured_file(testing::dataset(folder + "amplitudesweep.xlsx")).tables.front();
    EXPECT_EQ(values(book, "strain", "1"), values(text, "strain", "1"));
    EXPECT_EQ(values(book, "loss_modulus", "Pa"), values(text, "loss_modulus", "Pa"));
}

TEST_F(ExportVariants, DamagedWorkbooksOfXmlAreRefused) {
    const std::string whole = read(testing::dataset("blood_steps/SS.xlsx"));
    for (const std::size_t length : {std::size_t{4}, whole.size() / 2, whole.size() - 30}) {
        const std::string path = write("cut.xlsx", whole.substr(0, length));
        EXPECT_EQ(sentence<InputError>([&] { read_measured_file(path); }).find(path + " is "), 0U) << length;
    }
    for (std::size_t place = 40; place < whole.size(); place += 97) {
        std::string changed = whole;
        changed[place] = static_cast<char>(changed[place] ^ 0x55);
        try {
            EXPECT_FALSE(read_measured_file(write("changed.xlsx", changed)).tables.empty());
        } catch (const InputError&) {  // a sentence is as good as a table
        }
    }
}

}  // namespace
}  // namespace coagula::io
