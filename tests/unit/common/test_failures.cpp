// SPDX-License-Identifier: GPL-3.0-or-later
// The sentence about an exception that nobody expected.
#include <coagula/common/failures.hpp>
#include <coagula/common/progress.hpp>

#include <gtest/gtest.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <thread>

namespace coagula {
namespace {

TEST(Failures, OwnSentencesStayAsTheyAre) {
    EXPECT_EQ(failure_sentence(std::runtime_error("the disk is full")), "the disk is full");
    EXPECT_EQ(failure_sentence(InputError("a.h5 is no file")), "a.h5 is no file");
    EXPECT_EQ(failure_sentence(Cancelled()), Cancelled().what());
}

TEST(Failures, MemoryIsCalledSo) {
    EXPECT_EQ(failure_sentence(std::bad_alloc()), "there is not enough memory for this");
    EXPECT_EQ(failure_sentence(std::bad_array_new_length()), "there is not enough memory for this");
    EXPECT_EQ(failure_sentence(std::length_error("vector::_M_default_append")), "there is not enough memory for this");
}

TEST(Failures, WhatALibraryThrowsIsQuotedOnOneLine) {
    for (const std::string& sentence :
         {failure_sentence(std::logic_error("CGAL ERROR: precondition violation!\nFile: a.h\n")),
          failure_sentence(std::overflow_error("Error in function f:\tOverflow")), failure_sentence(std::exception())}) {
        EXPECT_TRUE(sentence.starts_with("the calculation failed where that was not foreseen (")) << sentence;
        EXPECT_EQ(sentence.find_first_of("\n\t"), std::string::npos) << sentence;
    }
}

TEST(FailuresDeathTest, AnExceptionThatNobodyCanCatchHasASentence) {
    const auto escape = [](auto&& error) {
        std::set_terminate(end_with_sentence);
        std::thread([&] { throw error; }).join();
    };
    EXPECT_EXIT(escape(std::bad_alloc()), ::testing::ExitedWithCode(1), "^coagula: there is not enough memory for this\n$");
    EXPECT_EXIT(escape(7), ::testing::ExitedWithCode(1), "^coagula: the calculation failed where that was not foreseen\n$");
}

}  // namespace
}  // namespace coagula
