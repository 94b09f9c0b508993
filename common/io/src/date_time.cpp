// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/date_time.hpp>

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <regex>
#include <string>

namespace coagula::io {

namespace {

constexpr std::size_t longest = 100;  ///< characters of a text that is looked at

bool holds_one_of(const std::string& text, std::initializer_list<const char*> marks) {
    return std::any_of(marks.begin(), marks.end(), [&](const char* mark) { return text.find(mark) != std::string::npos; });
}

/// Hour, minute and second of the first time of day in a text.
struct TimeOfDay {
    int hour;
    int minute;
    int second;
};

std::optional<TimeOfDay> time_of_day(const std::string& text) {
    static const std::regex form(R"((\d{1,2}):(\d{2})(?::(\d{2}))?)");
    std::smatch time;
    if (!std::regex_search(text, time, form)) {
        return std::nullopt;
    }
    const int hour = std::stoi(time[1]);
    const std::string rest = time.suffix();
    const int noon = holds_one_of(rest, {"PM", "pm", "p.m.", "午後"}) && hour < 12    ? 12
                     : holds_one_of(rest, {"AM", "am", "a.m.", "午前"}) && hour == 12 ? -12
                                                                                      : 0;
    return TimeOfDay{hour + noon, std::stoi(time[2]), time[3].matched ? std::stoi(time[3]) : 0};
}

const std::regex& date_form() {
    static const std::regex form(R"((\d{1,4})([-/.])(\d{1,2})\2(\d{1,4}))");
    return form;
}

}  // namespace

std::optional<double> seconds_of_date(int year, int month, int day, int hour, int minute, double second) {
    using namespace std::chrono;
    const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                              std::chrono::day(static_cast<unsigned>(day))};
    const bool in_day = hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0 && second < 61;
    if (!date.ok() || !in_day) {
        return std::nullopt;
    }
    const auto days = static_cast<double>(sys_days(date).time_since_epoch().count());
    return ((days * 24 + hour) * 60 + minute) * 60 + second;
}

std::optional<double> seconds_of_date(std::string_view text) {
    const std::string start(text.substr(0, longest));
    std::smatch date;
    if (!std::regex_search(start, date, date_form())) {
        return std::nullopt;
    }
    const auto time = time_of_day(date.suffix());
    if (!time) {
        return std::nullopt;
    }
    const int first = std::stoi(date[1]);
    const int second = std::stoi(date[3]);
    const int third = std::stoi(date[4]);
    const bool year_first = date[1].length() == 4;
    const bool month_first = !year_first && date[2] == "/" && first <= 12;
    const int year = year_first ? first : third;
    const int month = year_first ? second : (month_first ? first : second);
    const int day = year_first ? third : (month_first ? second : first);
    return seconds_of_date(year, month, day, time->hour, time->minute, time->second);
}

std::optional<double> seconds_of_day(std::string_view text) {
    const std::string start(text.substr(0, longest));
    const auto time = std::regex_search(start, date_form()) ? std::nullopt : time_of_day(start);
    return time ? seconds_of_date(1970, 1, 1, time->hour, time->minute, time->second) : std::nullopt;
}

}  // namespace coagula::io
