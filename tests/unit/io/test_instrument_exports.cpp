// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of real instruments as their programs wrote them (datasets/).
#include "instrument_exports.hpp"

#include <coagula/io/date_time.hpp>

#include "support/reference_data.hpp"

#include <numbers>
#include <set>

namespace coagula::io {
namespace {

class InstrumentExports : public TemporaryFolder {};

TEST_F(InstrumentExports, TriosTextHasTheInertiaOfTheRheometerInItsTorquesAndPhases) {
    const MeasuredFile file = read_measured_file(testing::dataset("trios_lims_json/multi_technique.txt"));
    EXPECT_EQ(file.format, MeasuredFormat::trios);
    ASSERT_EQ(file.tables.size(), 3U);
    EXPECT_EQ(file.tables[2].title, "Flow ramp - 3");
    EXPECT_EQ(file.tables[2].rows(), 223U);
    const PlainTable& sweep = file.tables[1];
    EXPECT_EQ(sweep.title, "Frequency sweep - 2");
    const auto omega = values(sweep, "angular_frequency", "rad/s");
    const auto total = values(sweep, "torque", "N.m");  // "Oscillation torque", not the steady "Torque" that stands before it
    const auto raw_phase = values(sweep, "raw_phase", "rad");
    const auto sample = values(sweep, "Oscillation torque (sample)", "N.m");
    const auto phase = values(sweep, "phase", "rad");
    const auto deflection = values(sweep, "deflection", "rad");
    for (std::size_t row = 0; omega[row] > 12; ++row) {  // below, the torque of inertia is a small part
        const double inertia = (sample[row] * std::cos(phase[row]) - total[row] * std::cos(raw_phase[row])) /
                               (omega[row] * omega[row] * deflection[row]);
        EXPECT_NEAR(inertia, 24.25e-6, 0.1e-6) << omega[row] << " rad/s";
    }
    // The steady stress stands before that of the oscillation, too.
    const auto stress = values(sweep, "stress", "Pa");
    const auto strain = values(sweep, "strain", "1");
    const auto modulus = values(sweep, "complex_modulus", "Pa");
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
        EXPECT_NEAR(stress[row] / strain[row], modulus[row], 1e-3 * modulus[row]);
    }
}

TEST_F(InstrumentExports, TriosForLimsHasAStepPerTemperature) {
    const MeasuredFile file = read_measured_file(testing::dataset("trios_lims_json/frequency_sweep_tts.txt"));
    ASSERT_EQ(file.tables.size(), 20U);
    EXPECT_EQ(file.tables[19].title, "Frequency sweep (-40.0 °C)");
    for (const PlainTable& table : file.tables) {
        EXPECT_EQ(table.rows(), 17U);
        EXPECT_EQ(table.announced_points, 17);
        EXPECT_TRUE(table.unreadable.empty());
        const auto storage = values(table, "storage_modulus", "Pa");
        const auto loss = values(table, "loss_modulus", "Pa");
        const auto phase = values(table, "phase", "rad");
        EXPECT_NEAR(loss[0] / storage[0], std::tan(phase[0]), 1e-4);
    }
    EXPECT_EQ(values(file.tables[0], "raw_phase", "rad")[0], 10.6539297041928 * std::numbers::pi / 180);
}

TEST_F(InstrumentExports, TriosTextWithCommasIsThatWithTabs) {
    const std::string name = testing::dataset("trios_lims_json/multi_technique.txt");
    std::ifstream stream(name);
    std::string text((std::istreambuf_iterator<char>(stream)), {});
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '\t', ',');
    const MeasuredFile tabs = read_measured_file(name);
    const MeasuredFile commas = read_measured_file(write("commas.csv", text));
    EXPECT_EQ(commas.format, MeasuredFormat::trios);
    ASSERT_EQ(commas.tables.size(), tabs.tables.size());
    for (std::size_t i = 0; i < tabs.tables.size(); ++i) {
        ASSERT_EQ(commas.tables[i].columns.size(), tabs.tables[i].columns.size());
        for (std::size_t column = 0; column < tabs.tables[i].columns.size(); ++column) {
            EXPECT_EQ(commas.tables[i].columns[column].heading, tabs.tables[i].columns[column].heading);
            EXPECT_EQ(commas.tables[i].columns[column].unit, tabs.tables[i].columns[column].unit);
            EXPECT_EQ(convert(commas.tables[i].columns[column].values, "1", "1").size(), tabs.tables[i].rows());
        }
        EXPECT_EQ(values(commas.tables[i], "torque", "N.m"), values(tabs.tables[i], "torque", "N.m"));
    }
}

TEST_F(InstrumentExports, TriosJsonBringsItsGeometry) {
    const MeasuredFile file = read_measured_file(testing::dataset("trios_lims_json/tadatakit/dataset.json"));
    EXPECT_EQ(file.format, MeasuredFormat::trios_json);
    ASSERT_EQ(file.tables.size(), 1U);
    EXPECT_EQ(file.tables[0].title, "Amplitude - 1");
    ASSERT_EQ(file.tables[0].rows(), 2U);
    EXPECT_EQ(values(file.tables[0], "storage_modulus", "Pa")[1], 26741.224609375);
    EXPECT_EQ(values(file.tables[0], "torque", "N.m")[0], 3.4826778119168e-6);
    EXPECT_EQ(geometry_of(file), "plate-plate");
    EXPECT_DOUBLE_EQ(value_of(file, "plate_radius"), 12.5e-3);
    EXPECT_DOUBLE_EQ(value_of(file, "gap"), 1e-3);
    EXPECT_DOUBLE_EQ(value_of(file, "tool_inertia"), 3.87e-6);
    EXPECT_DOUBLE_EQ(value_of(file, "tool_compliance"), 1.41e-3);  // upper and lower tool in series
}

TEST_F(InstrumentExports, RheoPlusKeepsItsFifteenIntervals) {
    for (const std::string gel : {"PXP", "TXT"}) {
        for (const std::string sample : {"1", "2", "3", "4"}) {
            const MeasuredFile file =
                read_measured_file(testing::dataset("deforest_hydrogels/" + std::string(gel).append("_N").append(sample) + ".csv"));
            EXPECT_EQ(file.format, MeasuredFormat::rheoplus);
            ASSERT_EQ(file.tables.size(), 15U);
            const std::vector<std::size_t> rows{80, 31, 80, 113, 80, 600, 20, 600, 20, 600, 20, 600, 20, 600, 28};
            for (std::size_t i = 0; i < rows.size(); ++i) {
                EXPECT_EQ(file.tables[i].rows(), rows[i]);
                EXPECT_EQ(file.tables[i].section, static_cast<int>(i) + 1);
                EXPECT_EQ(file.tables[i].announced_points, i == 0 ? 0 : static_cast<int>(rows[i]));
            }
        }
    }
}

TEST_F(InstrumentExports, AModulusThatCameOutNegativeIsNoValue) {
    const MeasuredFile file = read_measured_file(testing::dataset("deforest_hydrogels/TXT_N3.csv"));
    const PlainTable& sweep = file.tables[3];
    const auto storage = values(sweep, "storage_modulus", "Pa");
    EXPECT_TRUE(std::isnan(storage[3]));  // "4,2150,0,18000,...,"MV-,WMa""
    EXPECT_EQ(values(sweep, "loss_modulus", "Pa")[3], 18000);
    EXPECT_TRUE(std::isnan(storage[112]));  // "113,2685,0,104,...,"ME-,taD""
    EXPECT_EQ(std::count(storage.begin(), storage.end(), 0), 0);
    const auto reason = std::find_if(sweep.unreadable.begin(), sweep.unreadable.end(),
                                     [](const UnreadableCell& cell) { return cell.row == 3 && cell.text == "0"; });
    ASSERT_NE(reason, sweep.unreadable.end());
    EXPECT_EQ(reason->reason, "stands for a negative value, as the flag ME- or MV- says");
    const std::set<std::pair<std::string, std::size_t>> flags(sweep.flags.begin(), sweep.flags.end());
    EXPECT_TRUE(flags.contains({"taD", 13})) << sweep.flags.size();
}

TEST_F(InstrumentExports, RheoPlusInJapaneseIsReadInBothEncodings) {
    const MeasuredFile utf8 = read_measured_file(testing::dataset("rheoplus_japanese/datafile.csv"));
    EXPECT_EQ(utf8.tables[0].date, seconds_of_date("2022-11-14 16:32"));
    EXPECT_EQ(utf8.tables[1].date, seconds_of_date("2022-11-14 16:17"));
    const MeasuredFile escapes = read_measured_file(testing::dataset("rheoplus_japanese/datafile2.csv"));
    EXPECT_EQ(utf8.format, MeasuredFormat::rheoplus);
    ASSERT_EQ(utf8.tables.size(), 25U);
    ASSERT_EQ(escapes.tables.size(), 26U);
    EXPECT_EQ(geometry_of(utf8), "plate-plate");
    EXPECT_DOUBLE_EQ(value_of(utf8, "plate_radius"), 4e-3);
    EXPECT_TRUE(std::isnan(value_of(utf8, "gap")));  // "d=0.1 mm" is no gap
    for (std::size_t i = 0; i < utf8.tables.size(); ++i) {
        const PlainTable& table = utf8.tables[i];
        const auto stress = values(table, "stress", "Pa");
        const auto strain = values(table, "strain", "1");
        const auto modulus = values(table, "complex_modulus", "Pa");
        const auto viscosity = values(table, "complex_viscosity", "Pa.s");
        const auto frequency = values(table, "frequency", "Hz");
        ASSERT_EQ(table.rows(), 11U);
        for (std::size_t row = 0; row < table.rows(); ++row) {
            EXPECT_NEAR(stress[row] / strain[row], modulus[row], 0.01 * modulus[row]);
            EXPECT_NEAR(viscosity[row] * 2 * std::numbers::pi * frequency[row], modulus[row], 0.01 * modulus[row]);
        }
        EXPECT_EQ(modulus, values(escapes.tables[i], "complex_modulus", "Pa"));
        EXPECT_EQ(table.title, escapes.tables[i].title);
    }
}

TEST_F(InstrumentExports, RowsThatDoNotStandBelowTheirHeadingsAreRefused) {
    const std::string path = testing::dataset("rheoplus_japanese/20221114_freq_sweep_cat_1percent_settyaku.csv");
    EXPECT_EQ(sentence<InputError>([&] { read_measured_file(path); }),
              path +
                  ", line 31: there are 21 cells, but the headings name 20: a separator within numbers has split them; export with "
                  "tabs, or without thousands separators");
}

TEST_F(InstrumentExports, RheoCompassTellsTwelveResultsOfOneNameByTheirTests) {
    const MeasuredFile file =
        read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/gwens_data/Steady State Viscosity "
                                            "Curve-35C.csv"));
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    ASSERT_EQ(file.tables.size(), 12U);
    std::set<std::string> tests;
    for (const PlainTable& table : file.tables) {
        EXPECT_EQ(table.title, "Viscosity curve 1");
        EXPECT_EQ(table.section, 1);
        EXPECT_EQ(table.rows(), 25U);
        EXPECT_EQ(table.announced_points, 25);
        tests.insert(table.test);
        const auto stress = values(table, "stress", "Pa");
        const auto torque = values(table, "torque", "N.m");
        EXPECT_NEAR(torque[24] / stress[24], 32.77e-6, 0.01e-6);  // the constant of the measuring system
    }
    EXPECT_EQ(file.tables[11].number, 12);
    EXPECT_GE(tests.size(), 11U);
    // What a spreadsheet made of the same file: Latin-1, tabs at the end of lines, fewer digits.
    const MeasuredFile text = read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/gwens_data/txt_test_unedited.txt"));
    EXPECT_EQ(values(text.tables[0], "torque", "N.m")[24], values(file.tables[0], "torque", "N.m")[24]);
    EXPECT_EQ(text.tables[0].test, file.tables[0].test);
}

TEST_F(InstrumentExports, ALossTangentOf20000AndTheModulusBesideItAreNoValues) {
    const PlainTable sweep =
        read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/yulings_data/freqsweep.csv")).tables.front();
    EXPECT_EQ(sweep.rows(), 11U);
    EXPECT_EQ(numbers_in(values(sweep, "loss_tangent", "1")), 3U);
    EXPECT_EQ(numbers_in(values(sweep, "storage_modulus", "Pa")), 3U);
    EXPECT_EQ(numbers_in(values(sweep, "loss_modulus", "Pa")), 11U);
    EXPECT_EQ(sweep.unreadable.size(), 16U);
    const PlainTable amplitude =
        read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/yulings_data/amplitudesweep.csv")).tables.front();
    EXPECT_EQ(values(amplitude, "strain", "1")[0], 0.000101);  // in [1] here, in [%] there
    EXPECT_TRUE(std::isnan(values(amplitude, "storage_modulus", "Pa")[0]));
}

TEST_F(InstrumentExports, RheoWinHasThreeSeriesAndDecimalCommas) {
    const auto read = [](const std::string& name) { return read_measured_file(testing::dataset("haake_rheowin_pt/" + name)); };
    const MeasuredFile with_slashes = read("Ur5-2 conjunto   20.45.21 2018-02-28.txt");
    const MeasuredFile with_in = read("Sac50-2 conj   09.13.48 2018-03-14.txt");
    for (const MeasuredFile& file : {with_slashes, with_in}) {
        EXPECT_EQ(file.format, MeasuredFormat::rheowin);
        EXPECT_TRUE(file.decimal_comma);
        ASSERT_EQ(file.tables.size(), 3U);
        EXPECT_EQ(file.tables[0].rows(), 20U);
        EXPECT_EQ(file.tables[2].section, 3);
        EXPECT_EQ(file.tables[2].rows(), 40U);
        const auto stress = values(file.tables[2], "stress", "Pa");
        const auto rate = values(file.tables[2], "shear_rate", "1/s");  // "GP"
        const auto viscosity = values(file.tables[2], "viscosity", "Pa.s");
        EXPECT_NEAR(stress[39] / rate[39], viscosity[39], 0.01 * viscosity[39]);
        EXPECT_NEAR(values(file.tables[0], "temperature", "K")[0], 298.15, 0.2);  // "T", not the time
    }
    EXPECT_EQ(with_slashes.tables[1].rows(), 37U);
    EXPECT_EQ(values(with_slashes.tables[1], "stress", "Pa")[1], 1.0);  // "1,0000"
    EXPECT_EQ(values(with_slashes.tables[1], "storage_modulus", "Pa")[1], 0.001904);
}

TEST_F(InstrumentExports, BlocksWithoutHeadingsAreTablesOfNamelessColumns) {
    const MeasuredFile file = read_measured_file(testing::dataset("drilling_suspensions/RheogramSet.txt"));
    ASSERT_EQ(file.tables.size(), 385U);
    EXPECT_EQ(file.tables[0].title, "KCl/Polymer 1.75sg 10degC");
    PlainTable last = file.tables[384];
    EXPECT_EQ(last.title, "Larisa Bentonite recipe 2 BT");
    EXPECT_FALSE(last.has_headings);
    EXPECT_THROW(name_columns(last, {"shear rate [1/s]"}), InputError);
    name_columns(last, {"shear rate [1/s]", "stress [Pa]"});
    EXPECT_EQ(values(last, "stress", "Pa")[10], 13.1);
    EXPECT_EQ(values(last, "shear_rate", "1/s")[0], 1021.38);

    PlainTable figure = read_measured_file(testing::dataset("rheofit_flow/digitised/FigS3b_Seth2011.csv")).tables.front();
    EXPECT_FALSE(figure.has_headings);
    ASSERT_EQ(figure.columns.size(), 6U);
    EXPECT_EQ(figure.columns[2].values[0], 0.75);  // the volume fraction above the pair
    name_columns(figure, {"", "", "shear rate [1/s]", "stress [Pa]", "", ""});
    EXPECT_EQ(figure.columns.size(), 2U);
}

/// G* from torque, raw phase and deflection under a cone, K G* = (T/theta) e^(i phi) + I w^2, and the moduli that the instrument
/// says.
TEST_F(InstrumentExports, OldWorkbooksOfTriosHoldRawPhases) {
    const MeasuredFile file =
        read_measured_file(testing::dataset("rheodata_toolkit/ta_trios_xls/mixed_test_types/Copy of "
                                            "JeT_5k100-5k100_100mgml_amp_frq_swp_672017 copy.xls"));
    EXPECT_EQ(file.format, MeasuredFormat::workbook);
    ASSERT_EQ(file.tables.size(), 5U);
    EXPECT_EQ(geometry_of(file), "cone-plate");
    const double radius = value_of(file, "plate_radius");
    const double angle = value_of(file, "cone_angle");
    EXPECT_DOUBLE_EQ(radius, 10e-3);
    EXPECT_NEAR(angle, 2.014 * std::numbers::pi / 180, 1e-12);
    const double stiffness = 2 * std::numbers::pi * std::pow(radius, 3) / (3 * angle);
    const PlainTable& sweep = file.tables[1];
    EXPECT_EQ(sweep.title, "Frequency sweep - 2");
    const auto omega = values(sweep, "angular_frequency", "rad/s");
    const auto torque = values(sweep, "torque", "N.m");
    const auto phase = values(sweep, "raw_phase", "rad");
    const auto deflection = values(sweep, "deflection", "rad");
    const auto storage = values(sweep, "storage_modulus", "Pa");
    const auto loss = values(sweep, "loss_modulus", "Pa");
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
        const double viscous = torque[row] * std::sin(phase[row]) / (deflection[row] * stiffness);
        EXPECT_NEAR(viscous, loss[row], 0.005 * std::hypot(storage[row], loss[row])) << omega[row];
        if (omega[row] >= 3) {
            const double inertia =
                (storage[row] * stiffness - torque[row] * std::cos(phase[row]) / deflection[row]) / std::pow(omega[row], 2);
            EXPECT_NEAR(inertia, 25.7e-6, 0.2e-6) << omega[row];
        }
    }
}

TEST_F(InstrumentExports, EverySheetOfAWorkbookIsATable) {
    const MeasuredFile file = read_measured_file(testing::dataset("rheofit_flow/trios_xls/10sle1s_85castoroil-3.xls"));
    ASSERT_EQ(file.tables.size(), 2U);
    EXPECT_EQ(file.tables[1].title, "Flow sweep - 2");
    EXPECT_EQ(file.tables[1].rows(), 71U);
    EXPECT_DOUBLE_EQ(value_of(file, "inner_radius"), 14e-3);
    EXPECT_DOUBLE_EQ(value_of(file, "outer_radius"), 15.2e-3);
    EXPECT_DOUBLE_EQ(value_of(file, "instrument_inertia"), 20.9207e-6);
    EXPECT_TRUE(std::isnan(value_of(file, "gap")));  // below the bob
    EXPECT_NEAR(values(file.tables[0], "normal_force", "N")[0] / file.tables[0].columns[11].values[0], 9.80665e-3,
                1e-6);  // in grams
    // Three workbooks of one source are beyond FreeXL.
    const std::string path = testing::dataset("rheodata_toolkit/ta_trios_xls/ares_g2_nabr/0M NaBr.xls");
    EXPECT_NE(sentence<InputError>([&] { read_measured_file(path); }).find("save each sheet as CSV"), std::string::npos);
}

TEST_F(InstrumentExports, XmlSaysWhatToExportInstead) {
    const std::string path = testing::dataset("rheodata_toolkit/anton_paar/gwens_data/Steady State Viscosity Curve-LO80C_xml.xml");
    const std::string said = sentence<InputError>([&] { read_measured_file(path); });
    EXPECT_EQ(said.find(path), 0U);
    EXPECT_NE(said.find("which is not read: export the measurement as text or CSV"), std::string::npos) << said;
}

}  // namespace
}  // namespace coagula::io
