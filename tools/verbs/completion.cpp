// SPDX-License-Identifier: GPL-3.0-or-later
// coagula completion: the script that completes the command line in a shell.
#include "cli/completion.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <iostream>

namespace coagula::tools {

void run_completion(const Arguments& arguments) {
    const bool bash = arguments.input() == "bash";
    const std::string script = bash ? bash_completion(all_verbs()) : zsh_completion(all_verbs());
    if (arguments.flag("json")) {
        report(arguments, {{"shell", arguments.input()}, {"script", script}}, {});
        return;
    }
    std::cout << script;
    flush_output();
}

Verb completion_verb() {
    return {
        .name = "completion",
        .summary = "print the script that completes the command line in bash or zsh",
        .input = "SHELL",
        .options = {},
        .notes =
            {"In bash: source <(coagula completion bash). In zsh: coagula completion zsh > FOLDER/_coagula, FOLDER one of $fpath.",
             "Both are part of an installation of coagula."},
        .input_choices = {"bash", "zsh"}};
}

}  // namespace coagula::tools
