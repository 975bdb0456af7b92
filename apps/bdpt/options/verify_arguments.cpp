#include "options/verify_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr const char* verify_examples = R"(Examples:
  bdpt verify scene.gltf
  bdpt verify room.glb --from 0,1.6,2 --look-at 0,1,0 --time 10m
  bdpt verify scene.gltf --size 64x64 --max-depth 8 --json
  bdpt verify scene.gltf --light-paths 0.25 --connections 2
  bdpt verify scene.gltf --light-samples 4
  bdpt verify scene.gltf --integrator vcm --merge-radius 0.01

Renders the scene by pt, nee, mis, lt, bdpt and every strategy of bdpt, at low resolution with many
independent samples, and tests whether they agree: for each path length, in the whole image and in
tiles. docs/verify.md explains the method and the numbers.

Exit codes: 0 pass, 10 fail: something disagrees, 11 inconclusive: nothing disagrees, but the noise
could hide it (give it more --time); 1 internal error, 2 wrong usage, 3 input not found, 4 invalid
input, 5 unsupported feature, 6 output cannot be written, 7 out of memory or threads, 129 stopped by
SIGHUP, 130 by SIGINT, 143 by SIGTERM.)";

/// Percent to a fraction.
double to_fraction(const char* option, double percent, double most)
{
    if (!(percent > 0.0 && percent <= most)) {
        reject(option, fmt::format("{}", percent),
               fmt::format("more than 0 and at most {:g} percent", most));
    }
    return percent / 100.0;
}

void add_how(CLI::App& command, VerifyWords& words)
{
    const auto group = "How to verify";
    command
        .add_option("--time", words.render.time,
                    "Longest time to render, like 90s, 2m or 1.5h; verify stops earlier if that "
                    "suffices. Default: 2m")
        ->type_name("TIME")
        ->group(group);
    command.add_option("--size", words.render.size, "Image size. Default: 32x32")
        ->type_name("WxH")
        ->group(group);
    command
        .add_option("--max-depth", words.max_depth,
                    "Longest paths that are tested, in edges. Default: 5")
        ->check(whole_number(1, 64))
        ->type_name("N")
        ->group(group);
    command.add_option("--grid", words.grid, "Tiles along each side of the image. Default: 4")
        ->check(whole_number(1, 64))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--bias", words.bias,
                    "Smallest error of a strategy that must be detected, as a change of the image "
                    "mean [%]. Default: 1")
        ->type_name("PERCENT")
        ->group(group);
    command
        .add_option("--false-alarm", words.false_alarm,
                    "Probability that a correct renderer fails [%]. Default: 0.1")
        ->type_name("PERCENT")
        ->group(group);
    add_seed_and_threads(command, words.render, group);
    command
        .add_option("--integrator", words.render.transport.integrator,
                    "What is verified: bdpt (default), or auto: bdpt with the light paths and "
                    "connections that auto chooses for the scene, or vcm: beside bdpt its image, "
                    "which is right if --merge-radius is small enough")
        ->check(one_of({"bdpt", "auto", "vcm"}))
        ->type_name("bdpt|auto|vcm")
        ->group(group);
    add_light_path_options(command, words.render.transport, group);
    add_merge_radius_option(command, words.render.transport, group,
                            eval::VerifyOptions::small_merge_radius);
    add_light_samples_option(command, words.render.transport.light_sampling, group);
}

/// The choice of light paths is bdpt's, unless it is left to auto.
RenderWords named_integrator(RenderWords words)
{
    if (words.transport.integrator.empty()) {
        words.transport.integrator = "bdpt";
    }
    if (words.transport.light_paths == 0.0) {
        reject("--light-paths", "0", "more than 0 light paths: without them there is only mis");
    }
    return words;
}

}  // namespace

void add_verify_options(CLI::App& command, VerifyWords& words)
{
    command.add_option("file", words.render.file, "The scene: .gltf or .glb")
        ->required()
        ->type_name("FILE");
    add_how(command, words);
    add_view_options(command, words.render);
    const auto group = "Output";
    command
        .add_flag("--json", words.render.json, "Print one JSON object on stdout instead of text")
        ->group(group);
    command
        .add_flag("-q,--quiet", words.render.quiet, "Print only errors and the object of --json")
        ->group(group);
    command.footer(verify_examples);
}

VerifyArguments understand(const VerifyWords& words)
{
    constexpr int widest = 4096;
    VerifyArguments result{.stage = understand(named_integrator(words.render)), .options = {}};
    eval::VerifyOptions& options = result.options;
    if (const std::optional<Size>& size = result.stage.size) {
        if (std::max(size->width, size->height) > widest) {
            reject("--size", *words.render.size, "WIDTHxHEIGHT from 1x1 to 4096x4096");
        }
        options.width = size->width;
        options.height = size->height;
    }
    result.stage.size = Size{.width = options.width, .height = options.height};
    options.grid = std::min({words.grid, options.width, options.height});
    options.max_depth = words.max_depth;
    options.detectable_bias = to_fraction("--bias", words.bias, 100.0);
    options.false_alarm = to_fraction("--false-alarm", words.false_alarm, 50.0);
    if (words.render.time) {
        options.seconds = result.stage.goal.seconds;
    }
    options.light_paths = result.stage.options.bidirectional.light_paths;
    options.connections = result.stage.options.bidirectional.connections;
    if (result.stage.options.integrator == IntegratorKind::vcm) {
        options.merge_radius =
            words.render.transport.merge_radius.value_or(eval::VerifyOptions::small_merge_radius);
    }
    options.light_samples = result.stage.options.sampling.light_samples;
    options.seed = result.stage.options.sampling.seed;
    options.threads = result.stage.options.system.threads;
    return result;
}

}  // namespace bdpt::app
