// SPDX-License-Identifier: GPL-3.0-or-later
// What somebody meant who wrote a name that does not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace coagula {

/// Number of letters to insert, delete or replace, or of neighbours to swap, that turn one text into the other (the optimal string
/// alignment of Damerau and Levenshtein), of bytes.
std::size_t edit_distance(std::string_view first, std::string_view second);

/// The name that `word` most likely is a misspelling of: the nearest in edit distance, if that is at most a third of the letters of
/// the word; otherwise the shortest that begins with the word, of three letters or more. Upper case counts as lower case, '_' as
/// '-'. Empty when there is none. Of equally near names the first.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean 'NAME'?", or nothing when no name is near.
/// @param prefix stands in front of the name in the sentence, such as "--".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names, std::string_view prefix = "");

}  // namespace coagula
