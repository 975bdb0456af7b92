#pragma once

#include <string>

#include "commands/info_command.h"
#include "options/bench_arguments.h"
#include "options/command_parser.h"
#include "options/compare_arguments.h"
#include "options/develop_arguments.h"
#include "options/inspect_arguments.h"
#include "options/part_arguments.h"
#include "options/plan_arguments.h"
#include "options/render_arguments.h"
#include "options/verify_arguments.h"
#include "options/view_arguments.h"

namespace bdpt::app {

/// The commands with their options, and the structs that a command line fills in.
struct CommandLine {
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Runs the command that `line` names; `words` are the whole command line. Returns the exit
    /// code.
    [[nodiscard]] int run(const ParsedLine& line, const std::vector<std::string>& words);

    RenderRequest render;
    PlanRequest plan;
    MergeRequest merge;
    InfoArguments info;
    DevelopArguments develop;
    CompareRequest compare;
    BenchRequest bench;
    VerifyRequest verify;
    InspectRequest inspect;
    ViewRequest view;
    std::string topic;  ///< topic of `bdpt help`
    Program program;    ///< its options store into the members above
};

}  // namespace bdpt::app
