// SPDX-License-Identifier: GPL-3.0-or-later
// Dialects of exports that no public file shows, as texts.
#include "instrument_exports.hpp"

#include <numbers>

namespace coagula::io {
namespace {

class ExportDialects : public TemporaryFolder {};

const std::string french =
    "Projet:\tPâte\r\n\r\nEssai:\tE1\r\n\r\nRésultat:\tBalayage 1\r\n\r\n"
    "Intervalle et points de données:\t2\t2\r\n"
    "Interval données:\tPoint No.\tTemps\tFréquence angulaire\tModule de Stockage\tModule de Perte\tDéformation de Cisaillement\t"
    "Couple\tEtat\r\n\t\t\t\t\t\t\t\r\n\t\t[s]\t[rad/s]\t[Pa]\t[Pa]\t[%]\t[µN·m]\t\r\n"
    "\t1\t10,5\t100\t1 234,5\t12,5\t0,1\t3,25\tME-\r\n\t2 (invalide)\t20,5\t10\t1.034,5\t11,5\t0,1\t3,15\t\r\n";

TEST_F(ExportDialects, RheoCompassInFrench) {
    const MeasuredFile file = read_measured_file(write("f.csv", french));
    EXPECT_EQ(file.format, MeasuredFormat::rheocompass);
    ASSERT_EQ(file.tables.size(), 1U);
    const PlainTable& table = file.tables.front();
    EXPECT_EQ(table.test, "E1");
    EXPECT_EQ(table.title, "Balayage 1");
    EXPECT_EQ(table.section, 2);
    EXPECT_EQ(table.first_line, 11U);
    EXPECT_EQ(values(table, "storage_modulus", "Pa"), (std::vector<double>{1234.5, 1034.5}));
    EXPECT_EQ(values(table, "strain", "1")[0], 0.001);
    EXPECT_EQ(values(table, "torque", "N.m")[0], 3.25e-6);
    EXPECT_EQ(values(table, "time", "s")[1], 20.5);
    EXPECT_EQ(table.flags, (std::vector<std::pair<std::string, std::size_t>>{{"ME-", 1}}));
}

TEST_F(ExportDialects, ALanguageThatNobodyForesawIsFoundByItsUnits) {
    const MeasuredFile file = read_measured_file(write("s.csv",
                                                       "Proyecto:\tGel\n\nIntervalo y puntos:\t1\t2\n"
                                                       "Datos:\tPunto\tMódulo de almacenamiento\tMódulo de pérdida\n\t\t\t\n"
                                                       "\t\t[Pa]\t[Pa]\n\t1\t100\t10\n\t2\t90\t11\n\n"
                                                       "Intervalo y puntos:\t2\t1\nDatos:\tPunto\tG'\n\t\t[kPa]\n\t1\t2\n"));
    ASSERT_EQ(file.tables.size(), 1U);  // the second has but one unit and is not recognised without its word
    EXPECT_EQ(file.tables[0].columns[0].heading, "Módulo de almacenamiento");
    EXPECT_EQ(file.tables[0].columns[0].unit, "Pa");
    EXPECT_EQ(file.tables[0].columns[0].quantity, "");
    EXPECT_EQ(file.tables[0].columns[0].values, (std::vector<double>{100, 90}));
}

TEST_F(ExportDialects, ShiftJisIsNotTakenForWindows1252NorTheOtherWayRound) {
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

TEST_F(ExportDialects, HeadingsAsPeopleWriteThem) {
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

TEST_F(ExportDialects, CsvMayHaveATitleAndALineOfUnits) {
    // A sheet of a workbook saved as CSV, and one with units in brackets.
    const MeasuredFile sheets = read_measured_file(write("sheet.csv",
                                                         "Frequency sweep - 1,,\nAngular frequency,Storage modulus,Tan(delta)\n"
                                                         "rad/s,kPa,\n1,1.5,0.1\n2,1.6,******\n,,\nFlow - 2,,\n"
                                                         "Shear rate,Stress,Remark\n1/s,Pa,\n0.1,2,fine\n"));
    ASSERT_EQ(sheets.tables.size(), 2U);
    EXPECT_EQ(sheets.tables[0].title, "Frequency sweep - 1");
    EXPECT_EQ(values(sheets.tables[0], "storage_modulus", "Pa"), (std::vector<double>{1500, 1600}));
    ASSERT_EQ(sheets.tables[0].unreadable.size(), 1U);
    EXPECT_EQ(sheets.tables[0].unreadable[0].reason, "stands for no value");
    EXPECT_EQ(sheets.tables[1].title, "Flow - 2");
    EXPECT_EQ(values(sheets.tables[1], "stress", "Pa"), (std::vector<double>{2}));
    const PlainTable brackets = read_measured_file(write("b.csv", "time;G'\n[min];[Pa]\n1;2,5\n")).tables.front();
    EXPECT_EQ(values(brackets, "time", "s"), (std::vector<double>{60}));
}

TEST_F(ExportDialects, WhatStandsForNoValueIsNoNumber) {
    for (const std::string cell : {"******", "#NAME?", "#DIV/0!", "---", "n/a", "NaN", "∞", "invalid point", "3.40282347E+38"}) {
        const PlainTable table = read_measured_file(write("p.csv", "time [s],G' [Pa]\n1,2\n2," + cell + "\n")).tables.front();
        ASSERT_EQ(table.unreadable.size(), 1U) << cell;
        EXPECT_EQ(table.unreadable[0].reason, "stands for no value") << cell;
        EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
    }
}

TEST_F(ExportDialects, MetadataOfTheToolAreUnderstood) {
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
