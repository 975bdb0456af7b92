#include "commands/command_line.h"

#include <memory>

#include "commands/version_command.h"
#include "options/command_options.h"
#include "terminal/help_formatter.h"

namespace bdpt::app {
namespace {

constexpr const char* first_examples = R"(Examples:
  bdpt render scene.gltf -o out.exr
  bdpt render scene.glb -o out.exr -o preview.png --spp 256
  bdpt info scene.glb
  bdpt plan scene.glb -o out.exr --spp 4096 --parts 64 --for slurm -d job
  bdpt merge part-*.part.exr -o out.exr
  bdpt compare out.exr reference.exr
  bdpt bench scene.gltf -o bench --quick
  bdpt verify scene.gltf
  bdpt inspect scene.gltf --pixel 640,360

"bdpt help render", or "bdpt render --help", has all options and the exit codes.)";

}  // namespace

CommandLine::CommandLine()
{
    app.set_version_flag("--version", version_text,
                         "Print the version, that of libraries, and the instruction set");
    app.require_subcommand(1);
    app.footer(first_examples);
    app.formatter(std::make_shared<HelpFormatter>());
    render = app.add_subcommand("render", "Render a scene to .exr and .png files");
    add_render_options(*render, render_words);
    plan = app.add_subcommand("plan", "Share a render among many processes or machines");
    add_plan_options(*plan, plan_words);
    merge = app.add_subcommand("merge", "Add parts of a render that were rendered apart");
    add_merge_options(*merge, merge_words);
    info = app.add_subcommand("info", "Print what a scene contains");
    add_info_options(*info, info_arguments);
    compare = app.add_subcommand("compare", "Measure the error of images against a reference");
    add_compare_options(*compare, compare_words);
    bench = app.add_subcommand("bench", "Compare integrators at equal time and equal samples");
    add_bench_options(*bench, bench_words);
    verify =
        app.add_subcommand("verify", "Test that all integrators and strategies agree on a scene");
    add_verify_options(*verify, verify_words);
    inspect = app.add_subcommand("inspect", "Tell what one sample of a pixel does");
    add_inspect_options(*inspect, inspect_words);
    help = app.add_subcommand("help", "Print the help of a command");
    help->add_option("command", topic, "The command. Default: all")->type_name("COMMAND");
    version = app.add_subcommand("version",
                                 "Print the version, that of libraries, and the instruction set");
    for (CLI::App* command : {render, plan, merge, info, compare, bench, verify, inspect}) {
        let_the_last_count(*command);
    }
}

}  // namespace bdpt::app
