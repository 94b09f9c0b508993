// Exports of real instruments as their programs wrote them (datasets/), and the dialects that no public file shows.
#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include "support/reference_data.hpp"
#include "temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace coagula::io {
namespace {

using InstrumentExports = TemporaryFolder;

/// The column with the lowest rank of a quantity, or of a heading, in SI units.
std::vector<double> values(const PlainTable& table, const std::string& name, const std::string& unit) {
    const PlainColumn* best = nullptr;
    for (const PlainColumn& column : table.columns) {
        if ((column.quantity == name || column.heading == name) && (best == nullptr || column.rank < best->rank)) {
            best = &column;
        }
    }
    if (best == nullptr) {
        throw std::runtime_error("no column " + name);
    }
    return convert(best->values, best->unit.empty() ? "1" : best->unit, unit);
}

std::size_t numbers_in(const std::vector<double>& column) {
    return static_cast<std::size_t>(std::count_if(column.begin(), column.end(), [](double value) { return !std::isnan(value); }));
}

double value_of(const MeasuredFile& file, const std::string& name) {
    for (const InstrumentValue& value : instrument_values(file)) {
        if (value.name == name) {
            return value.value;
        }
    }
    return unset;
}

std::string geometry_of(const MeasuredFile& file) {
    for (const InstrumentValue& value : instrument_values(file)) {
        if (value.name == "geometry") {
            return value.text;
        }
    }
    return "";
}

TEST_F(InstrumentExports, TriosTextHasTheInertiaOfTheRheometerInItsTorquesAndPhases) {
    const MeasuredFile file = read_measured_file(testing::dataset("trios_lims_json/multi_technique.txt"));
    EXPECT_EQ(file.format, MeasuredFormat::trios);
    ASSERT_EQ(file.tables.size(), 3u);
    EXPECT_EQ(file.tables[2].title, "Flow ramp - 3");
    EXPECT_EQ(file.tables[2].rows(), 223u);
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
    ASSERT_EQ(file.tables.size(), 20u);
    EXPECT_EQ(file.tables[19].title, "Frequency sweep (-40.0 °C)");
    for (const PlainTable& table : file.tables) {
        EXPECT_EQ(table.rows(), 17u);
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
    ASSERT_EQ(file.tables.size(), 1u);
    EXPECT_EQ(file.tables[0].title, "Amplitude - 1");
    ASSERT_EQ(file.tables[0].rows(), 2u);
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
            const MeasuredFile file = read_measured_file(testing::dataset("deforest_hydrogels/" + gel + "_N" + sample + ".csv"));
            EXPECT_EQ(file.format, MeasuredFormat::rheoplus);
            ASSERT_EQ(file.tables.size(), 15u);
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
    const MeasuredFile escapes = read_measured_file(testing::dataset("rheoplus_japanese/datafile2.csv"));
    EXPECT_EQ(utf8.format, MeasuredFormat::rheoplus);
    ASSERT_EQ(utf8.tables.size(), 25u);
    ASSERT_EQ(escapes.tables.size(), 26u);
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
        ASSERT_EQ(table.rows(), 11u);
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
    ASSERT_EQ(file.tables.size(), 12u);
    std::set<std::string> tests;
    for (const PlainTable& table : file.tables) {
        EXPECT_EQ(table.title, "Viscosity curve 1");
        EXPECT_EQ(table.section, 1);
        EXPECT_EQ(table.rows(), 25u);
        EXPECT_EQ(table.announced_points, 25);
        tests.insert(table.test);
        const auto stress = values(table, "stress", "Pa");
        const auto torque = values(table, "torque", "N.m");
        EXPECT_NEAR(torque[24] / stress[24], 32.77e-6, 0.01e-6);  // the constant of the measuring system
    }
    EXPECT_EQ(file.tables[11].number, 12);
    EXPECT_GE(tests.size(), 11u);
    // What a spreadsheet made of the same file: Latin-1, tabs at the end of lines, fewer digits.
    const MeasuredFile text = read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/gwens_data/txt_test_unedited.txt"));
    EXPECT_EQ(values(text.tables[0], "torque", "N.m")[24], values(file.tables[0], "torque", "N.m")[24]);
    EXPECT_EQ(text.tables[0].test, file.tables[0].test);
}

TEST_F(InstrumentExports, ALossTangentOf20000AndTheModulusBesideItAreNoValues) {
    const PlainTable sweep =
        read_measured_file(testing::dataset("rheodata_toolkit/anton_paar/yulings_data/freqsweep.csv")).tables.front();
    EXPECT_EQ(sweep.rows(), 11u);
    EXPECT_EQ(numbers_in(values(sweep, "loss_tangent", "1")), 3u);
    EXPECT_EQ(numbers_in(values(sweep, "storage_modulus", "Pa")), 3u);
    EXPECT_EQ(numbers_in(values(sweep, "loss_modulus", "Pa")), 11u);
    EXPECT_EQ(sweep.unreadable.size(), 16u);
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
        ASSERT_EQ(file.tables.size(), 3u);
        EXPECT_EQ(file.tables[0].rows(), 20u);
        EXPECT_EQ(file.tables[2].section, 3);
        EXPECT_EQ(file.tables[2].rows(), 40u);
        const auto stress = values(file.tables[2], "stress", "Pa");
        const auto rate = values(file.tables[2], "shear_rate", "1/s");  // "GP"
        const auto viscosity = values(file.tables[2], "viscosity", "Pa.s");
        EXPECT_NEAR(stress[39] / rate[39], viscosity[39], 0.01 * viscosity[39]);
        EXPECT_NEAR(values(file.tables[0], "temperature", "K")[0], 298.15, 0.2);  // "T", not the time
    }
    EXPECT_EQ(with_slashes.tables[1].rows(), 37u);
    EXPECT_EQ(values(with_slashes.tables[1], "stress", "Pa")[1], 1.0);  // "1,0000"
    EXPECT_EQ(values(with_slashes.tables[1], "storage_modulus", "Pa")[1], 0.001904);
}

TEST_F(InstrumentExports, BlocksWithoutHeadingsAreTablesOfNamelessColumns) {
    const MeasuredFile file = read_measured_file(testing::dataset("drilling_suspensions/RheogramSet.txt"));
    ASSERT_EQ(file.tables.size(), 385u);
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
    ASSERT_EQ(figure.columns.size(), 6u);
    EXPECT_EQ(figure.columns[2].values[0], 0.75);  // the volume fraction above the pair
    name_columns(figure, {"", "", "shear rate [1/s]", "stress [Pa]", "", ""});
    EXPECT_EQ(figure.columns.size(), 2u);
}

/// G* from torque, raw phase and deflection under a cone, K G* = (T/theta) e^(i phi) + I w^2, and the moduli that the instrument
/// says.
TEST_F(InstrumentExports, OldWorkbooksOfTriosHoldRawPhases) {
    const MeasuredFile file =
        read_measured_file(testing::dataset("rheodata_toolkit/ta_trios_xls/mixed_test_types/Copy of "
                                            "JeT_5k100-5k100_100mgml_amp_frq_swp_672017 copy.xls"));
    EXPECT_EQ(file.format, MeasuredFormat::workbook);
    ASSERT_EQ(file.tables.size(), 5u);
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
    ASSERT_EQ(file.tables.size(), 2u);
    EXPECT_EQ(file.tables[1].title, "Flow sweep - 2");
    EXPECT_EQ(file.tables[1].rows(), 71u);
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

TEST_F(InstrumentExports, WorkbooksAndXmlSayWhatToExportInstead) {
    for (const std::string name :
         {"blood_steps/SS.xlsx", "blood_steps/Steps.xlsx", "rheodata_toolkit/anton_paar/yulings_data/amplitudesweep.xlsx",
          "rheodata_toolkit/anton_paar/gwens_data/Steady State Viscosity Curve-LO80C_xml.xml"}) {
        const std::string path = testing::dataset(name);
        const std::string said = sentence<InputError>([&] { read_measured_file(path); });
        EXPECT_EQ(said.find(path), 0u);
        EXPECT_NE(said.find("which is not read: export the measurement as text or CSV"), std::string::npos) << said;
    }
}

const std::string french =
    "Projet:\tPâte\r\n\r\nEssai:\tE1\r\n\r\nRésultat:\tBalayage 1\r\n\r\n"
    "Intervalle et points de données:\t2\t2\r\n"
    "Interval données:\tPoint No.\tTemps\tFréquence angulaire\tModule de Stockage\tModule de Perte\tDéformation de Cisaillement\t"
    "Couple\tEtat\r\n\t\t\t\t\t\t\t\r\n\t\t[s]\t[rad/s]\t[Pa]\t[Pa]\t[%]\t[µN·m]\t\r\n"
    "\t1\t10,5\t100\t1 234,5\t12,5\t0,1\t3,25\tME-\r\n\t2 (invalide)\t20,5\t10\t1.034,5\t11,5\t0,1\t3,15\t\r\n";

TEST_F(InstrumentExports, RheoCompassInFrench) {
    const MeasuredFile file = read_measured_file(write("f.csv", french));
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    ASSERT_EQ(file.tables.size(), 1u);
    const PlainTable& table = file.tables.front();
    EXPECT_EQ(table.test, "E1");
    EXPECT_EQ(table.title, "Balayage 1");
    EXPECT_EQ(table.section, 2);
    EXPECT_EQ(table.first_line, 11u);
    EXPECT_EQ(values(table, "storage_modulus", "Pa"), (std::vector<double>{1234.5, 1034.5}));
    EXPECT_EQ(values(table, "strain", "1")[0], 0.001);
    EXPECT_EQ(values(table, "torque", "N.m")[0], 3.25e-6);
    EXPECT_EQ(values(table, "time", "s")[1], 20.5);
    EXPECT_EQ(table.flags, (std::vector<std::pair<std::string, std::size_t>>{{"ME-", 1}}));
}

TEST_F(InstrumentExports, ALanguageThatNobodyForesawIsFoundByItsUnits) {
    const MeasuredFile file = read_measured_file(write("s.csv",
                                                       "Proyecto:\tGel\n\nIntervalo y puntos:\t1\t2\n"
                                                       "Datos:\tPunto\tMódulo de almacenamiento\tMódulo de pérdida\n\t\t\t\n"
                                                       "\t\t[Pa]\t[Pa]\n\t1\t100\t10\n\t2\t90\t11\n\n"
                                                       "Intervalo y puntos:\t2\t1\nDatos:\tPunto\tG'\n\t\t[kPa]\n\t1\t2\n"));
    ASSERT_EQ(file.tables.size(), 1u);  // the second has but one unit and is not recognised without its word
    EXPECT_EQ(file.tables[0].columns[0].heading, "Módulo de almacenamiento");
    EXPECT_EQ(file.tables[0].columns[0].unit, "Pa");
    EXPECT_EQ(file.tables[0].columns[0].quantity, "");
    EXPECT_EQ(file.tables[0].columns[0].values, (std::vector<double>{100, 90}));
}

TEST_F(InstrumentExports, ShiftJisIsNotTakenForWindows1252NorTheOtherWayRound) {
    // "貯蔵弾性率 [Pa],ひずみ [%]" in Shift-JIS.
    const std::string shift_jis = "\x92\x99\x91\xa0\x92\x65\x90\xab\x97\xa6 [Pa],\x82\xd0\x82\xb8\x82\xdd [%]\n100,1\n90,2\n";
    const PlainTable japanese = read_measured_file(write("j.csv", shift_jis)).tables.front();
    EXPECT_EQ(japanese.columns[0].quantity, "storage_modulus");
    EXPECT_EQ(japanese.columns[1].quantity, "strain");
    const PlainTable western = read_measured_file(write("w.csv",
                                                        "Temperatur [\xb0"
                                                        "C],Drehmoment [\xb5N\xb7m]\n20,3\n21,4\n"))
                                   .tables.front();
    EXPECT_EQ(western.columns[0].unit, "°C");
    EXPECT_EQ(western.columns[1].unit, "µN.m");
}

TEST_F(InstrumentExports, HeadingsAsPeopleWriteThem) {
    const auto check = [&](const std::string& heading, const std::string& quantity, const std::string& unit) {
        const PlainTable table = read_measured_file(write("h.csv", heading + "\n1\n2\n")).tables.front();
        EXPECT_EQ(table.columns.front().quantity, quantity) << heading;
        EXPECT_EQ(table.columns.front().unit, unit) << heading;
    };
    check("ω [rad/s]", "angular_frequency", "rad/s");
    check("f [Hz]", "frequency", "Hz");
    check("G' (Pa)", "storage_modulus", "Pa");
    check("G′ (Pa)", "storage_modulus", "Pa");
    check("G″ [kPa]", "loss_modulus", "kPa");
    check("G\" [kPa]", "loss_modulus", "kPa");
    check("Storage modulus [Pa]", "storage_modulus", "Pa");
    check("storage_modulus (Pa)", "storage_modulus", "Pa");
    check("tan(delta)", "loss_tangent", "");
    check("tan δ [-]", "loss_tangent", "1");
    check("|η*| [mPas]", "complex_viscosity", "mPa.s");
    check("T [°C]", "temperature", "°C");
    check("t [s]", "time", "s");
    check("M [mNm]", "torque", "mN.m");
    check("γ / %", "strain", "%");
    check("omega in rad/s", "angular_frequency", "rad/s");
    check("Stress_Pa", "stress", "Pa");
    check("Oscillation torque (sample)", "", "");
    check("my column (foo)", "", "");
}

TEST_F(InstrumentExports, CsvMayHaveATitleAndALineOfUnits) {
    // A sheet of a workbook saved as CSV, and one with units in brackets.
    const MeasuredFile sheets = read_measured_file(write("sheet.csv",
                                                         "Frequency sweep - 1,,\nAngular frequency,Storage modulus,Tan(delta)\n"
                                                         "rad/s,kPa,\n1,1.5,0.1\n2,1.6,******\n,,\nFlow - 2,,\n"
                                                         "Shear rate,Stress,Remark\n1/s,Pa,\n0.1,2,fine\n"));
    ASSERT_EQ(sheets.tables.size(), 2u);
    EXPECT_EQ(sheets.tables[0].title, "Frequency sweep - 1");
    EXPECT_EQ(values(sheets.tables[0], "storage_modulus", "Pa"), (std::vector<double>{1500, 1600}));
    ASSERT_EQ(sheets.tables[0].unreadable.size(), 1u);
    EXPECT_EQ(sheets.tables[0].unreadable[0].reason, "stands for no value");
    EXPECT_EQ(sheets.tables[1].title, "Flow - 2");
    EXPECT_EQ(values(sheets.tables[1], "stress", "Pa"), (std::vector<double>{2}));
    const PlainTable brackets = read_measured_file(write("b.csv", "time;G'\n[min];[Pa]\n1;2,5\n")).tables.front();
    EXPECT_EQ(values(brackets, "time", "s"), (std::vector<double>{60}));
}

TEST_F(InstrumentExports, WhatStandsForNoValueIsNoNumber) {
    for (const std::string cell : {"******", "#NAME?", "#DIV/0!", "---", "n/a", "NaN", "∞", "invalid point", "3.40282347E+38"}) {
        const PlainTable table = read_measured_file(write("p.csv", "time [s],G' [Pa]\n1,2\n2," + cell + "\n")).tables.front();
        ASSERT_EQ(table.unreadable.size(), 1u) << cell;
        EXPECT_EQ(table.unreadable[0].reason, "stands for no value") << cell;
        EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
    }
}

TEST_F(InstrumentExports, MetadataOfTheToolAreUnderstood) {
    const auto trios = [&](const std::string& lines) {
        return read_measured_file(write("m.txt", "[Geometry Parameters]\n" + lines + "[step]\nA\ntime\tStress\ns\tPa\n1\t2\n"));
    };
    const MeasuredFile cone = trios(
        "Name\t40mm 2.014° cone plate, Peltier\nDiameter\t40.0 mm\nCone angle\t2.014 °\n"
        "Gap\t56.0 µm\nCompliance\t1.05 mrad/N.m\nGeometry Inertia\t8.2 µN.m.s²\n"
        "Instrument inertia\t18,4 µN.m.s²\n");
    EXPECT_EQ(geometry_of(cone), "cone-plate");
    EXPECT_DOUBLE_EQ(value_of(cone, "plate_radius"), 20e-3);
    EXPECT_NEAR(value_of(cone, "cone_angle"), 2.014 * std::numbers::pi / 180, 1e-12);
    EXPECT_TRUE(std::isnan(value_of(cone, "gap")));  // that of the truncation
    EXPECT_DOUBLE_EQ(value_of(cone, "tool_compliance"), 1.05e-3);
    EXPECT_DOUBLE_EQ(value_of(cone, "tool_inertia"), 8.2e-6);
    EXPECT_DOUBLE_EQ(value_of(cone, "instrument_inertia"), 18.4e-6);
    const MeasuredFile plates = trios("Name\t8mm parallel plate,  Stainless steel\nGap\t1,000 [mm]\n");
    EXPECT_DOUBLE_EQ(value_of(plates, "plate_radius"), 4e-3);
    EXPECT_DOUBLE_EQ(value_of(plates, "gap"), 1e-3);
    // Zeros are what nobody entered; a unit of another dimension is not what the key promises.
    const MeasuredFile zeros = trios("Name\tDIN concentric cylinders\nDiameter\t0.0 mm\nGap\t1.0 N\n");
    EXPECT_EQ(geometry_of(zeros), "concentric-cylinders");
    EXPECT_TRUE(std::isnan(value_of(zeros, "plate_radius")));
    EXPECT_TRUE(std::isnan(value_of(zeros, "gap")));
    const MeasuredFile anton_paar = read_measured_file(write("a.csv", "Measuring system:\tCP50-1\n" + french));
    EXPECT_EQ(geometry_of(anton_paar), "cone-plate");
    EXPECT_DOUBLE_EQ(value_of(anton_paar, "plate_radius"), 25e-3);
    EXPECT_NEAR(value_of(anton_paar, "cone_angle"), std::numbers::pi / 180, 1e-12);
}

}  // namespace
}  // namespace coagula::io
