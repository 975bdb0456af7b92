#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands/info_command.h"
#include "options/bench_arguments.h"
#include "options/compare_arguments.h"
#include "options/inspect_arguments.h"
#include "options/part_arguments.h"
#include "options/plan_arguments.h"
#include "options/render_arguments.h"
#include "options/verify_arguments.h"

namespace bdpt::app {

/// The commands and their options, and what the words of a command line fill in.
struct CommandLine {
    CommandLine();

    CLI::App app{"bdpt renders glTF 2.0 scenes by bidirectional path tracing.", "bdpt"};
    RenderWords render_words;
    PlanWords plan_words;
    MergeWords merge_words;
    InfoArguments info_arguments;
    CompareWords compare_words;
    BenchWords bench_words;
    VerifyWords verify_words;
    InspectWords inspect_words;
    std::string topic;  ///< what to help with
    CLI::App* render = nullptr;
    CLI::App* plan = nullptr;
    CLI::App* merge = nullptr;
    CLI::App* info = nullptr;
    CLI::App* compare = nullptr;
    CLI::App* bench = nullptr;
    CLI::App* verify = nullptr;
    CLI::App* inspect = nullptr;
    CLI::App* help = nullptr;
    CLI::App* version = nullptr;
};

}  // namespace bdpt::app
