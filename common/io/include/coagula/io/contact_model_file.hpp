// SPDX-License-Identifier: GPL-3.0-or-later
// The contact model as a TOML file; docs/reference/contact-model.md describes the keys.
#pragma once

#include <coagula/common/contact_model.hpp>

#include <string>

namespace coagula::io {

/// Reads a file of lines `name = "value with unit"` (a bare number is in SI units), names as in contact_parameters(). What the file
/// does not say keeps its value in `base`. Throws InputError naming the file and the key or line when it is missing, no TOML, has a
/// key that is no parameter or a value that is no such quantity, or when the model as a whole is impossible.
ContactModel read_contact_model(const std::string& path, const ContactModel& base = {});

/// The model as such a file: the parameters that are set, each with its unit; reads back as the same numbers.
std::string contact_model_text(const ContactModel& model);

}  // namespace coagula::io
