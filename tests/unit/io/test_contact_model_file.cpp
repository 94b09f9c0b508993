// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/contact_model_file.hpp>

#include "temporary_folder.hpp"

#include <cmath>

namespace coagula::io {
namespace {

using ContactModelFile = TemporaryFolder;

TEST_F(ContactModelFile, ReadsQuantitiesAndKeepsTheRest) {
    const auto path = write("model.toml",
                            "# losses\nnormal_stiffness = \"200 N/m\"\nnormal_viscosity = \"3 mN.s/m\"\n"
                            "shear_maxwell_stiffness = 4\nshear_maxwell_time = \"5ms\"\nsolvent_viscosity = \"1 mPa.s\"\n");
    const ContactModel model = read_contact_model(path, {.shear_stiffness = 20});
    EXPECT_EQ(model.normal_stiffness, 200);
    EXPECT_EQ(model.shear_stiffness, 20);
    EXPECT_DOUBLE_EQ(model.normal_viscosity, 0.003);
    EXPECT_EQ(model.shear_maxwell_stiffness, 4);
    EXPECT_EQ(model.shear_maxwell_time, 0.005);
    EXPECT_DOUBLE_EQ(model.solvent_viscosity, 0.001);
    EXPECT_TRUE(std::isnan(model.normal_maxwell_stiffness));
}

TEST_F(ContactModelFile, WhatIsWrittenReadsBackAsTheSameModel) {
    ContactModel model;
    double value = 0.1;  // later ones are larger: cutoff above gap
    for (const ContactParameter& parameter : contact_parameters()) {
        model.*parameter.value = value / 7;
        value += 0.1;
    }
    const ContactModel again = read_contact_model(write("model.toml", contact_model_text(model)));
    for (const ContactParameter& parameter : contact_parameters()) {
        EXPECT_EQ(again.*parameter.value, model.*parameter.value) << parameter.name;
    }
    EXPECT_EQ(contact_model_text({}), "normal_stiffness = \"100 N/m\"\nshear_stiffness = \"10 N/m\"\n");
}

TEST_F(ContactModelFile, RefusesWithFileAndKey) {
    const auto refused = [&](const std::string& text, const std::string& part) {
        const auto path = write("model.toml", text);
        const std::string said = sentence<InputError>([&] { read_contact_model(path); });
        EXPECT_NE(said.find("model.toml"), std::string::npos) << said;
        EXPECT_NE(said.find(part), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    };
    refused("stickiness = 3\n", "key 'stickiness'");
    refused("normal_viscosity = \"3 N/m\"\n", "key 'normal_viscosity'");
    refused("normal_viscosity = \"much\"\n", "key 'normal_viscosity'");
    refused("normal_viscosity = [1, 2]\n", "key 'normal_viscosity'");
    refused("normal_viscosity = true\n", "key 'normal_viscosity'");
    refused("normal_viscosity = nan\n", "key 'normal_viscosity'");
    refused("[normal]\nviscosity = 1\n", "key 'normal'");
    refused("normal_viscosity = -1\n", "normal_viscosity");
    refused("normal_stiffness = 0\n", "normal_stiffness");
    refused("normal_maxwell_time = \"1s\"\n", "normal_maxwell_stiffness");
    refused("bending_stiffness = \"3 N/m\"\n", "key 'bending_stiffness'");
    refused("work_of_adhesion = \"0.5 J/m2\"\n", "young_modulus");
    refused("lubrication_gap = \"1 nm\"\nlubrication_cutoff = \"20 nm\"\n", "solvent_viscosity");
    refused("shear_stiffness = 3\nnormal_viscosity = \n", "line 2");
    refused(std::string("\0\1\2\xff", 4), "model.toml");
    EXPECT_THROW(read_contact_model(file("absent.toml")), InputError);
    EXPECT_THROW(read_contact_model(folder_.string()), InputError);
}

}  // namespace
}  // namespace coagula::io
