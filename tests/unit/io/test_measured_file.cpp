// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include "support/reference_data.hpp"
#include "temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <ctime>
#include <numbers>

namespace coagula::io {
namespace {

using MeasuredFiles = TemporaryFolder;

/// UTF-16, little endian, with a byte order mark; of texts below U+0800.
std::string utf16(const std::string& utf8, bool big_endian = false) {
    std::string bytes = big_endian ? "\xfe\xff" : "\xff\xfe";
    for (std::size_t i = 0; i < utf8.size(); ++i) {
        unsigned code = static_cast<unsigned char>(utf8[i]);
        if (code >= 0xc0) {
            code = (code & 0x1f) << 6 | (static_cast<unsigned char>(utf8[++i]) & 0x3f);
        }
        const char low = static_cast<char>(code & 0xff);
        const char high = static_cast<char>(code >> 8);
        bytes += big_endian ? std::string{high, low} : std::string{low, high};
    }
    return bytes;
}

const PlainColumn& column(const PlainTable& table, const std::string& quantity) {
    const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                    [&](const PlainColumn& each) { return each.quantity == quantity; });
    if (found == table.columns.end()) {
        throw std::runtime_error("no column " + quantity);
    }
    return *found;
}

const std::string german =
    "Projekt:\tPaste\r\n\r\nVersuch:\tV1\r\n\r\nErgebnis:\tPlatte 1\r\n\r\n"
    "Abschnitt und Datenpunkte:\t1\t3\r\n"
    "Abschnittsdaten:\tPunkt Nr.\tScherdeformation\tSpeichermodul\tMoment\tStatus\tKomplexe Viskosität\r\n"
    "\t\t\t\t\t\tGrundwelle\r\n"
    "\t\t[%]\t[Pa]\t[mN·m]\t\t[mPa·s]\r\n"
    "\t1\t0,01\t1.234,5\t7.67E-01\tok\t2878,2\r\n"
    "\t2\t0,1\t12,5\t0,25\tM-\t1,5E+04\r\n"
    "\t3\t1,0\t\t-0,5\tok\t1.234.567\r\n"
    "\t\t\t\t\t\t\r\n"
    "Abschnitt und Datenpunkte:\t2\t2\r\n"
    "Abschnittsdaten:\tPunkt Nr.\tScherdeformation\tScherdeformation\tSchubspannung\r\n"
    "\t\t\tWellenform\tWellenform\r\n"
    "\t\t[%]\t[%]\t[Pa]\r\n"
    "\t1\t2,5\t0,0\t0,5\r\n"
    "\t\t\t2,5\t1,5\r\n"
    "\t\t\t0,0\t-0,5\r\n"
    "\t2\t5,0\t0,0\t0,6\r\n"
    "\t\t\t5,0\t1,6\r\n";

void check_german(const MeasuredFile& file) {
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    EXPECT_TRUE(file.decimal_comma);
    ASSERT_EQ(file.tables.size(), 4U);  // two intervals, two waveforms
    const PlainTable& first = file.tables[0];
    EXPECT_EQ(first.title, "Platte 1");
    EXPECT_EQ(first.section, 1);
    EXPECT_EQ(first.announced_points, 3);
    EXPECT_EQ(first.rows(), 3U);
    ASSERT_EQ(first.columns.size(), 4U);  // the status is text
    EXPECT_EQ(column(first, "strain").unit, "%");
    EXPECT_EQ(column(first, "strain").values, (std::vector<double>{0.01, 0.1, 1}));
    EXPECT_EQ(column(first, "storage_modulus").values[0], 1234.5);
    EXPECT_TRUE(std::isnan(column(first, "storage_modulus").values[2]));
    EXPECT_EQ(column(first, "torque").unit, "mN.m");
    EXPECT_TRUE(std::isnan(column(first, "torque").values[0]));
    EXPECT_EQ(column(first, "torque").values[2], -0.5);
    EXPECT_EQ(column(first, "complex_viscosity").values, (std::vector<double>{2878.2, 1.5e4, 1234567}));
    ASSERT_EQ(first.unreadable.size(), 1U);
    EXPECT_EQ(first.unreadable[0].text, "7.67E-01");
    EXPECT_EQ(first.unreadable[0].row, 0U);
    EXPECT_EQ(first.columns[first.unreadable[0].column].quantity, "torque");
    EXPECT_EQ(first.unreadable[0].reason, "has a decimal point in a file with decimal commas");

    EXPECT_EQ(file.tables[1].section, 2);
    ASSERT_EQ(file.tables[1].columns.size(), 1U);  // what is a waveform is not in the table of points
    EXPECT_EQ(file.tables[1].columns[0].values, (std::vector<double>{2.5, 5}));
    EXPECT_EQ(file.tables[2].point, 1);
    EXPECT_EQ(column(file.tables[2], "strain").values, (std::vector<double>{0, 2.5, 0}));
    EXPECT_EQ(column(file.tables[2], "stress").values, (std::vector<double>{0.5, 1.5, -0.5}));
    EXPECT_EQ(file.tables[3].point, 2);
    EXPECT_EQ(column(file.tables[3], "stress").values, (std::vector<double>{0.6, 1.6}));
    EXPECT_EQ(first.test, "V1");
}

TEST_F(MeasuredFiles, ReadsGermanRheoCompassInEveryEncoding) {
    check_german(read_measured_file(write("a.csv", utf16(german))));
    check_german(read_measured_file(write("b.csv", utf16(german, true))));
    check_german(read_measured_file(write("c.csv", german)));
    check_german(read_measured_file(write("d.csv", "\xef\xbb\xbf" + german)));
}

TEST_F(MeasuredFiles, ReadsEnglishRheoCompassWithCommasAndNoLineOfQualifiers) {
    const MeasuredFile file =
        read_measured_file(write("e.csv",
                                 "Project:,Gel\nTest:,T\nResult:,Frequency sweep\n"
                                 "Interval and data points:,1,2\n"
                                 "Interval data:,Point No.,Angular Frequency,Storage Modulus,Loss Modulus,Loss Factor\n"
                                 ",,[rad/s],[Pa],[Pa],[1]\n"
                                 ",1,0.1,\"1,234.5\",100,0.081\n"
                                 ",2,1,2000,,0.09\n"));
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    EXPECT_FALSE(file.decimal_comma);
    ASSERT_EQ(file.tables.size(), 1U);
    EXPECT_EQ(file.tables[0].title, "Frequency sweep");
    EXPECT_EQ(column(file.tables[0], "storage_modulus").values, (std::vector<double>{1234.5, 2000}));
    EXPECT_EQ(column(file.tables[0], "loss_tangent").unit, "1");
    EXPECT_TRUE(std::isnan(column(file.tables[0], "loss_modulus").values[1]));
    EXPECT_TRUE(file.tables[0].unreadable.empty());  // an empty cell is no fault
}

TEST_F(MeasuredFiles, ReadsTriosExports) {
    // Windows-1252: degree sign and micro sign as single bytes.
    const MeasuredFile plain = read_measured_file(
        write("plain.txt",
              "Filename\tgel.tri\r\nInstrument name\tDHR-3\r\n\r\n[step]\r\nFrequency sweep - 1\r\n"
              "Angular frequency\tStorage modulus\tLoss modulus\tTan(delta)\tTemperature\tOscillation torque\r\n"
              "rad/s\tkPa\tkPa\t\t\xb0"
              "C\t\xb5N.m\r\n"
              "0.1\t1.5\t0.2\t0.133\t25.0\t3\r\n1\t1.6\t0.2\t0.125\t25.0\t3.2\r\n\r\n"
              "[step]\r\nAmplitude sweep - 2\r\nOscillation strain\tStorage modulus\r\n%\tMPa\r\n0.01\t0.0015\r\n"));
    EXPECT_EQ(plain.format, MeasuredFormat::trios);
    ASSERT_EQ(plain.tables.size(), 2U);
    EXPECT_EQ(plain.tables[0].title, "Frequency sweep - 1");
    EXPECT_EQ(column(plain.tables[0], "storage_modulus").unit, "kPa");
    EXPECT_EQ(column(plain.tables[0], "storage_modulus").values, (std::vector<double>{1.5, 1.6}));
    EXPECT_EQ(convert(column(plain.tables[0], "torque").values, column(plain.tables[0], "torque").unit, "N.m")[0], 3e-6);
    EXPECT_DOUBLE_EQ(convert(column(plain.tables[0], "temperature").values, column(plain.tables[0], "temperature").unit, "K")[0],
                     298.15);
    EXPECT_EQ(plain.tables[1].section, 2);
    EXPECT_EQ(column(plain.tables[1], "strain").unit, "%");

    const MeasuredFile lims =
        read_measured_file(write("lims.txt",
                                 "Filename\tgel.tri\nSample name\tgel\n[Geometry Parameters]\nDiameter\t25 mm\n"
                                 "[step]\nStep name\tAmplitude sweep\nNumber of points\t3\n"
                                 "Variables\tOscillation strain\tOscillation stress\tStatus\tPhase angle\n"
                                 "\t%\tPa\t\t°\n"
                                 "Data point\t0,01\t1,5\t0x0\t5,1\n"
                                 "Data point\t0,02\t3,0\t0x0\t5,2\n"));
    EXPECT_TRUE(lims.decimal_comma);
    ASSERT_EQ(lims.tables.size(), 1U);
    EXPECT_EQ(lims.tables[0].title, "Amplitude sweep");
    EXPECT_EQ(lims.tables[0].announced_points, 3);
    EXPECT_EQ(lims.tables[0].rows(), 2U);
    EXPECT_EQ(column(lims.tables[0], "stress").values, (std::vector<double>{1.5, 3}));
    EXPECT_EQ(column(lims.tables[0], "phase").unit, "°");
    EXPECT_EQ(lims.metadata[2].group, "Geometry Parameters");
    EXPECT_EQ(lims.metadata[2].key, "Diameter");
}

TEST_F(MeasuredFiles, ReadsCsvWithUnitsInTheHeader) {
    const MeasuredFile file = read_measured_file(write("t.csv",
                                                       "# a comment\n\nstrain [%];G' [kPa];G'' (Pa);remark\n"
                                                       "0,1;1,5;20;first\n1;1.234,5;oops;\n2;1 234,5;1,2,3;x\n"));
    EXPECT_EQ(file.format, MeasuredFormat::csv);
    EXPECT_TRUE(file.decimal_comma);
    const PlainTable& table = file.tables.front();
    ASSERT_EQ(table.columns.size(), 3U);
    EXPECT_EQ(column(table, "storage_modulus").unit, "kPa");
    EXPECT_EQ(column(table, "storage_modulus").values, (std::vector<double>{1.5, 1234.5, 1234.5}));
    EXPECT_EQ(column(table, "loss_modulus").unit, "Pa");
    ASSERT_EQ(table.unreadable.size(), 2U);
    EXPECT_EQ(table.unreadable[0].text, "oops");
    EXPECT_EQ(table.unreadable[1].text, "1,2,3");
}

TEST_F(MeasuredFiles, KeepsAColumnWithoutNumbersWhereItsMeaningIsKnown) {
    const PlainTable table = read_measured_file(write("n.csv", "strain [1],G' [Pa],note\n0.1,nan,a\n0.2,nan,b\n")).tables.front();
    ASSERT_EQ(table.columns.size(), 2U);
    EXPECT_EQ(table.unreadable.size(), 2U);
    EXPECT_TRUE(std::isnan(column(table, "storage_modulus").values[0]));
}

TEST_F(MeasuredFiles, NeverGuessesAnAmbiguousNumber) {
    const auto values = [&](const std::string& cells) {
        return read_measured_file(write("g.csv", "time [s];stress [Pa]\n" + cells)).tables.front();
    };
    // 1,234 alone can be either; the other cells of the file decide.
    EXPECT_EQ(column(values("1;1,234\n2;0,5\n"), "stress").values[0], 1.234);
    EXPECT_EQ(column(values("1;1,234\n2;0.5\n"), "stress").values[0], 1234);
    const PlainTable mixed = values("1;0,5\n2;0,25\n3;0.75\n");
    EXPECT_TRUE(std::isnan(column(mixed, "stress").values[2]));
    EXPECT_EQ(mixed.unreadable.size(), 1U);
    for (const std::string bad : {"1.23.4", "1e", "0x10", "inf", "1e999", "--1", "1-2", "12.34,5", "."}) {
        const PlainTable table = values("1;0,5\n2;0,25\n3;" + bad + "\n");
        EXPECT_TRUE(std::isnan(column(table, "stress").values[2])) << bad;
        EXPECT_EQ(table.unreadable.size(), 1U) << bad;
    }
}

TEST_F(MeasuredFiles, CountsOfPointsThatCannotBeAreNoCounts) {
    for (const std::string points : {"-1e300", "-3", "1e300", "many"}) {
        const std::string text = "[step]\nStep name\tA\nNumber of points\t" + points + "\nVariables\ttime\n\ts\nData point\t1\n";
        EXPECT_EQ(read_measured_file(write("t.txt", text)).tables.front().announced_points, 0) << points;
    }
}

/// A line `cell` repeated `count` times.
std::string repeated(const std::string& cell, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += cell;
    }
    return text;
}

TEST_F(MeasuredFiles, RefusesShortRowsUnderManyHeadings) {
    // A megabyte would become a table of 10^10 empty cells.
    const std::string headings = repeated("\ttime", 100000) + "\n";
    const std::string units = repeated("\t[s]", 100000) + "\n";
    const std::string trios = write("t.txt", "[step]\n" + headings + units + repeated("1\n", 100000));
    EXPECT_EQ(sentence<InputError>([&] { read_measured_file(trios); }),
              trios + ", line 14: the rows up to here lack 1100000 cells that the headings name; write every cell");
    const std::string rheocompass = write("r.csv", "Interval and data points:\t1\t3\nInterval data:\tPoint No." + headings + "\t" +
                                                       units + repeated("\t1\n", 100000));
    EXPECT_NE(sentence<InputError>([&] { read_measured_file(rheocompass); }).find("cells that the headings name"),
              std::string::npos);
}

TEST_F(MeasuredFiles, TakesNoSquareOfTheColumns) {
    // 50 000 columns, each with a cell that is no number.
    const std::string path =
        write("w.csv", repeated("time,", 50000) + "\n" + repeated("1,", 50000) + "\n" + repeated("x,", 50000) + "\n");
    const std::clock_t start = std::clock();
    const PlainTable table = read_measured_file(path).tables.front();
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1);
    ASSERT_EQ(table.unreadable.size(), 50000U);
    EXPECT_EQ(table.unreadable[49999].column, 49999U);
}

TEST_F(MeasuredFiles, RefusesANameOfAResultThatEveryTableWouldCarry) {
    const std::string path = write("r.csv", "Result:\t" + std::string(2000, 'x') + "\n" + german.substr(german.find("Abschnitt")));
    EXPECT_EQ(sentence<InputError>([&] { read_measured_file(path); }),
              path + ", line 1: the name of the result has 2000 characters, but must have at most 1000");
}

TEST_F(MeasuredFiles, TakesForUtf8OnlyWhatIsUtf8) {
    // An overlong form, a surrogate and what lies beyond the last code point are Windows-1252.
    for (const std::string bytes : {"\xe0\x80\x80", "\xf0\x80\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"}) {
        const auto file = read_measured_file(write("u.csv", "time [" + bytes + "]\n1\n"));
        EXPECT_NE(file.tables.front().columns.front().unit, bytes);
    }
    const auto file = read_measured_file(write("u.csv", "time [\xe2\x82\xac]\n1\n"));
    EXPECT_EQ(file.tables.front().columns.front().unit, "\xe2\x82\xac");
}

TEST_F(MeasuredFiles, RefusesWhatHoldsNoTable) {
    const auto refused = [&](const std::string& text, const std::string& part) {
        const std::string said = sentence<InputError>([&] { read_measured_file(write("bad.csv", text)); });
        EXPECT_NE(said.find("bad.csv"), std::string::npos) << said;
        EXPECT_NE(said.find(part), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    };
    refused("", "has no header");
    refused("# only a comment\n", "has no header");
    refused("a,b\n1,2\n1,2,3\n", "line 3: there are 3 fields, but the header names 2");
    refused(std::string("\x89HDF\r\n\x1a\n\0\0\0\0", 12), "not a text file");
    refused("Interval and data points:\t1\t3\n", "a RheoCompass export begins here, but no line of headings with units follows");
    refused("PK\x03\x04", "is an Excel workbook (.xlsx) that cannot be read: the archive is damaged");
    refused("\xd0\xcf\x11\xe0\xa1\xb1", "is an old Excel workbook (.xls) that cannot be read");
    refused("\xef\xbb\xbf<?xml version=\"1.0\"?>", "is XML, which is not read");
    refused("{\"Results\": [", "begins as JSON but is none");
    refused("{\"Results\": {}}", "holds no Results as TRIOS exports them");
    refused("{\"Results\": {\"Raw\": {\"Rows\": []}}}", "no ColumnHeaders and Rows");
    refused("Interval and data points:\t1\t3\nInterval data:\tPoint No.\tTime\n\t1\t2\n", "line 2: no line with units");
    refused("[step]\nname\nfoo\tbar\n1\t2\n", "line 1: this step has no line of headings");
    EXPECT_THROW(read_measured_file(file("absent.csv")), InputError);
    EXPECT_THROW(read_measured_file(folder_.string()), InputError);
}

/// A real export: 60 points of pre-shear, then 51 amplitudes with a waveform of 512 samples and the first again.
class CementPaste : public ::testing::TestWithParam<const char*> {
protected:
    static std::string path() { return testing::dataset(std::string("cement_laos/") + GetParam()); }
};

/// First harmonic of a closed waveform.
std::complex<double> first_harmonic(const std::vector<double>& values) {
    std::complex<double> sum = 0;
    const auto period = static_cast<double>(values.size() - 1);
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        sum += values[i] * std::polar(2 / period, -2 * std::numbers::pi * static_cast<double>(i) / period);
    }
    return sum;
}

TEST_P(CementPaste, WaveformsAndModuliOfTheExportAgree) {
    const MeasuredFile file = read_measured_file(path());
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    ASSERT_EQ(file.tables.size(), 2U + 51U);
    EXPECT_EQ(file.tables[0].rows(), 60U);
    const PlainTable& sweep = file.tables[1];
    ASSERT_EQ(sweep.rows(), 51U);
    for (std::size_t point = 20; point < 51; ++point) {  // below 0.1 % strain the noise of the waveform is larger than its signal
        const PlainTable& wave = file.tables[2 + point];
        ASSERT_EQ(wave.point, static_cast<int>(point) + 1);
        ASSERT_EQ(wave.rows(), 513U);
        const std::complex<double> strain = first_harmonic(column(wave, "strain").values) / 100.0;
        const std::complex<double> modulus = first_harmonic(column(wave, "stress").values) / strain;
        const double storage = column(sweep, "storage_modulus").values[point];
        const double loss = column(sweep, "loss_modulus").values[point];
        EXPECT_NEAR(100 * std::abs(strain), column(sweep, "strain").values[point], 0.01 * column(sweep, "strain").values[point]);
        EXPECT_LT(std::abs(modulus - std::complex<double>(storage, loss)), 0.03 * std::hypot(storage, loss)) << point + 1;
    }
}

INSTANTIATE_TEST_SUITE_P(Replicates, CementPaste,
                         ::testing::Values("LAOS_0.55_250_1.csv", "LAOS__0.55_250_2.csv", "LAOS_0.55_250_3.csv"));

TEST(CementPasteBuildUp, KeepsEveryCellAsItStands) {
    const MeasuredFile file = read_measured_file(testing::dataset("cement_laos/SAOS_0.55_250.csv"));
    ASSERT_EQ(file.tables.size(), 2U);
    const PlainTable& table = file.tables[1];
    ASSERT_EQ(table.rows(), 200U);
    const std::vector<double>& stress = column(table, "stress").values;
    EXPECT_EQ(stress[0], 0.0014445);
    EXPECT_EQ(stress[199], 14.685);  // a slipped decimal separator is not the reader's business
    EXPECT_EQ(column(table, "storage_modulus").values[199], 28629);
    EXPECT_EQ(column(table, "storage_modulus").values[198], 28834);
    const auto unreadable = [&](const std::string& quantity) {
        return std::count_if(table.unreadable.begin(), table.unreadable.end(),
                             [&](const UnreadableCell& cell) { return table.columns[cell.column].quantity == quantity; });
    };
    EXPECT_EQ(unreadable("stress"), 0);
    EXPECT_EQ(unreadable("torque"), 1);  // 7.67E-01
    EXPECT_EQ(unreadable("complex_viscosity"), 184);
}

}  // namespace
}  // namespace coagula::io
