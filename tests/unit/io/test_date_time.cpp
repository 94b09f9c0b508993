// SPDX-License-Identifier: GPL-3.0-or-later
// Dates as instruments write them.
#include <coagula/io/date_time.hpp>

#include <gtest/gtest.h>

namespace coagula::io {
namespace {

TEST(DateTime, IsReadAsInstrumentsWriteIt) {
    const auto afternoon = seconds_of_date(2022, 11, 14, 16, 32, 0);
    EXPECT_EQ(afternoon, 1668443520.0);  // date -u -d "2022-11-14 16:32" +%s
    for (const char* text : {"2022-11-14 16:32", "2022/11/14; 16:32 午後", "2022/11/14; 4:32 午後", "14.11.2022 / 16:32:00 / HAAKE",
                             "11/14/2022 4:32:00 PM", "14/11/2022 16:32", "2022-11-14T16:32:00"}) {
        EXPECT_EQ(seconds_of_date(text), afternoon) << text;
    }
    EXPECT_EQ(seconds_of_date("6/7/2023 12:05:09 AM"), seconds_of_date(2023, 6, 7, 0, 5, 9));
    EXPECT_EQ(seconds_of_date("6/7/2023 12:05:09 PM"), seconds_of_date(2023, 6, 7, 12, 5, 9));
}

TEST(DateTime, IsNothingWithoutADayAndATimeOfDay) {
    for (const char* text : {"", "MM/DD/YYYY", "2022-11-14", "16:32", "10 min", "31.02.2022 10:00", "2022-11-14 25:00", "1/2/3/4",
                             "99999/99/99999 99:99"}) {
        EXPECT_FALSE(seconds_of_date(text)) << text;
    }
}

}  // namespace
}  // namespace coagula::io
