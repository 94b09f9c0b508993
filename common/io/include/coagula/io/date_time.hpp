// SPDX-License-Identifier: GPL-3.0-or-later
// Dates as instruments and people write them.
#pragma once

#include <optional>
#include <string_view>

namespace coagula::io {

/// Seconds between 1970-01-01 00:00 and a time of day, on one clock, of a date and a time in a text: "2022-11-14 16:32",
/// "01.03.2018 / 15:36:49", "6/26/2023 1:34:19 PM", "2022/11/14; 16:32". Between slashes the month comes first, unless that is more
/// than 12. Nothing where there is no such date or no time of day.
std::optional<double> seconds_of_date(std::string_view text);

/// The same of numbers; nothing where there is no such day or time.
std::optional<double> seconds_of_date(int year, int month, int day, int hour, int minute, double second);

/// Seconds since midnight at the time of day in a text without a date: "16:32:05", "4:32 PM". Nothing where there is none.
std::optional<double> seconds_of_day(std::string_view text);

}  // namespace coagula::io
