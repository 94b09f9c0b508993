// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the library of stages that every source of the program uses.
#pragma once

#include <coagula/stages/arguments.hpp>
#include <coagula/stages/findings.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/provenance.hpp>

namespace coagula::tools {

using report::describe;
using report::Json;
using report::Results;
using report::Table;
using report::to_json;
using report::with_unit;
using stages::Arguments;
using stages::Findings;
using stages::Generated;
using stages::Option;
using stages::Printed;
using stages::split;
using stages::Stopwatch;
using stages::Verb;
using stages::version_text;

}  // namespace coagula::tools
