#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/scene.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <string>

#include "commands/commands.h"
#include "options/value_types.h"
#include "terminal/console.h"

namespace bdpt::app {

namespace {

/// Returns "bdpt 1.0.0", and in further lines its libraries and the ray tracing kernels that it
/// uses on this machine.
std::string version_text()
{
    const eval::MachineFacts facts = eval::machine_facts();
    const Isa isa = Scene(SceneDesc{}).isa();
    return fmt::format("bdpt {}\nLibraries: {}\nCompiler: {}\nInstruction set of Embree here: {}",
                       BDPT_VERSION, facts.libraries, facts.compiler, isa_name(isa));
}

constexpr const char* program_footer = R"(Examples:
  bdpt render model.glb                                        (writes model.png)
  bdpt render scene.glb -o out.exr -o preview.png --spp 256
  bdpt develop out.exr -o bright.png --exposure 2
  bdpt dataset models/*.glb -o views
  bdpt view scene.glb
  bdpt info scene.glb
  bdpt plan scene.glb -o out.exr --spp 4096 --parts 64 --for slurm -d job
  bdpt merge part-*.part.exr -o out.exr
  bdpt compare out.exr reference.exr
  bdpt bench scene.gltf -o bench --quick
  bdpt verify scene.gltf
  bdpt inspect scene.gltf --pixel 640,360

"bdpt help COMMAND", or "bdpt COMMAND --help", has the options of a command.)";

/// Runs `bdpt help` and `bdpt help COMMAND`, like `--help`.
int run_help(Program& program, const std::string& topic)
{
    if (!topic.empty() && program.find(topic) == nullptr) {
        throw Error(ErrorCode::usage, unknown_command(program, topic, "bdpt --help"));
    }
    put_help(help_text(program, topic));
    return 0;
}

}  // namespace

CommandLine::CommandLine()
{
    program.name = "bdpt";
    program.summary = "bdpt renders glTF 2.0 scenes by bidirectional path tracing.";
    program.footer = program_footer;
    program.version = version_text;  // a callback, as it asks Embree, which starts threads
    add_render_command(program);
    add_dataset_command(program);
    add_view_command(program);
    add_plan_command(program);
    add_merge_command(program);
    add_develop_command(program);
    add_info_command(program);
    add_compare_command(program);
    add_bench_command(program);
    add_verify_command(program);
    add_inspect_command(program);
    add_command<std::string>(
        program, "help", "Print the help of a command", "",
        [](OptionList& options, std::string& topic) {
            options.add("command", "COMMAND", "The command. Default: all", topic, any_text());
        },
        [this](const std::string& topic, const OptionList& /*options*/, const Words& /*words*/) {
            return run_help(program, topic);
        });
    add_command<std::string>(
        program, "version", "Print the versions of bdpt and libraries, and the instruction set", "",
        [](OptionList& /*options*/, const std::string& /*none*/) {},
        [](const std::string& /*none*/, const OptionList& /*options*/, const Words& /*words*/) {
            print_text(version_text() + "\n");
            return 0;
        });
}

}  // namespace bdpt::app
