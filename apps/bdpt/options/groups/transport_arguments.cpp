#include "options/groups/transport_arguments.h"

#include <bdpt/eval/bench/option_names.h>
#include <bdpt/integrators.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

std::string name_of(const Strategy& strategy)
{
    return fmt::format("s{}t{}", strategy.s, strategy.t);
}

constexpr int longest_path = 1000;  // [edges]

std::string integrator_help()
{
    std::vector<std::string> phrases;
    for (const IntegratorInfo& integrator : integrators()) {
        const bool is_default = integrator.kind == RenderOptions{}.integrator;
        phrases.push_back(fmt::format("{}{}: {}", integrator.name, is_default ? " (default)" : "",
                                      integrator.summary));
    }
    return fmt::format("{}", fmt::join(phrases, "; "));
}

template <typename Values>
std::vector<std::string> all_names(const Values& values)
{
    std::vector<std::string> names;
    for (const auto value : values) {
        names.emplace_back(eval::to_string(value));
    }
    return names;
}

/// "s2t1".
std::optional<Strategy> parse_strategy(std::string_view text)
{
    constexpr std::size_t most_vertices = longest_path + 1;
    const std::size_t middle = text.find('t');
    if (!text.starts_with('s') || middle == std::string_view::npos) {
        return std::nullopt;
    }
    const auto s = parse_index(text.substr(1, middle - 1));
    const auto t = parse_index(text.substr(middle + 1));
    if (!s || !t || *s > most_vertices || *t > most_vertices || *s + *t < 2) {
        return std::nullopt;
    }
    return Strategy{static_cast<int>(*s), static_cast<int>(*t)};
}

/// What is said of subpaths and strategies is said to bdpt, unless another integrator is named.
std::string integrator_of(const TransportWords& words)
{
    const bool for_bdpt = words.light_paths || words.connections || words.disabled ||
                          words.max_camera_depth || words.max_light_depth;
    return !words.integrator.empty() ? words.integrator : for_bdpt ? "bdpt" : "auto";
}

/// Options of merging, and what cannot go with it.
void check_merging(const TransportWords& words, const std::string& integrator)
{
    if (integrator == "vcm") {
        if (words.heuristic != "power" && words.heuristic != "balance") {
            reject("--heuristic", words.heuristic, "power or balance with --integrator vcm");
        }
        if (words.merge_alpha == 0.0) {
            reject("--merge-alpha", "0", "a number above 0 and up to 1");
        }
        return;
    }
    const auto check = [&](const char* option, const std::optional<double>& value) {
        if (value) {
            reject(option, fmt::format("{}", *value),
                   fmt::format("--integrator vcm with it, not {}", integrator));
        }
    };
    check("--merge-radius", words.merge_radius);
    check("--merge-alpha", words.merge_alpha);
}

/// Options that only subpaths from both sides can heed.
void check_bidirectional(const TransportWords& words, const std::string& integrator)
{
    const bool without_light_paths = words.light_paths == 0.0;
    if ((integrator == "lt" || integrator == "vcm") && without_light_paths) {
        reject("--light-paths", "0",
               fmt::format("more than 0 light paths with --integrator {}", integrator));
    }
    if (without_light_paths && words.connections.value_or(0.0) > 0.0) {
        reject("--connections", fmt::format("{}", *words.connections),
               "light paths to connect to, but --light-paths is 0");
    }
    if (words.connections && integrator != "bdpt" && integrator != "vcm") {
        reject("--connections", fmt::format("{}", *words.connections),
               fmt::format("--integrator bdpt or vcm with it, not {}", integrator));
    }
    if (integrator == "bdpt" || integrator == "lt" || integrator == "vcm") {
        return;
    }
    const auto check = [&](const char* option, const std::optional<std::string>& value) {
        if (value) {
            reject(option, *value,
                   fmt::format("--integrator bdpt, lt or vcm with it, not {}", integrator));
        }
    };
    const auto text = [](const auto& value) {
        return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
    };
    check("--max-camera-depth", text(words.max_camera_depth));
    check("--max-light-depth", text(words.max_light_depth));
    check("--light-paths", text(words.light_paths));
    check("--disable", words.disabled);
}

/// Paths with one bounce and less are direct light, all others indirect.
void choose_light(const std::string& which, RenderOptions& options)
{
    constexpr int longest_direct = 2;
    if (which == "direct") {
        options.transport.max_depth = std::min(options.transport.max_depth, longest_direct);
        return;
    }
    if (options.transport.max_depth <= longest_direct) {
        reject("--only", which, "--max-depth 3 or more, where indirect light begins");
    }
    options.transport.min_depth = longest_direct + 1;
}

void add_limits(CLI::App& command, TransportWords& words, const char* group)
{
    command
        .add_option(
            "--max-depth", words.max_depth,
            fmt::format(
                "Longest path, in edges: 1 is emitted light only, 2 adds direct light. Default: {}",
                words.max_depth))
        ->check(whole_number(1, longest_path))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--only", words.only,
                    "direct: emission and direct light (paths of 1 or 2 edges); indirect: longer "
                    "paths, up to --max-depth. The two images add up to the whole")
        ->check(one_of({"direct", "indirect"}))
        ->type_name("direct|indirect")
        ->group(group);
    command
        .add_option("--max-camera-depth", words.max_camera_depth,
                    "Longest camera subpath, in edges (bdpt, lt, vcm)")
        ->check(whole_number(0, longest_path))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--max-light-depth", words.max_light_depth,
                    "Longest light subpath, in edges (bdpt, lt, vcm)")
        ->check(whole_number(0, longest_path))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--rr-start", words.rr_start,
                    "Edges before Russian roulette starts. Default: 3")
        ->check(whole_number(1, longest_path))
        ->type_name("N")
        ->group(group);
}

/// Whole numbers without a fraction.
nlohmann::ordered_json number_json(double number)
{
    if (number == std::floor(number)) {
        return static_cast<std::int64_t>(number);
    }
    return number;
}

}  // namespace

std::optional<std::vector<Strategy>> parse_strategies(std::string_view text)
{
    std::vector<Strategy> result;
    for (;;) {
        const std::size_t comma = text.find(',');
        const std::optional<Strategy> strategy = parse_strategy(text.substr(0, comma));
        if (!strategy) {
            return std::nullopt;
        }
        result.push_back(*strategy);
        if (comma == std::string_view::npos) {
            return result;
        }
        text.remove_prefix(comma + 1);
    }
}

void add_light_path_options(CLI::App& command, TransportWords& words, const char* group)
{
    constexpr double most_light_paths = 4096.0;
    command
        .add_option(
            "--light-paths", words.light_paths,
            "Light subpaths per camera subpath (bdpt, lt, vcm); a fraction, like 0.1, shares "
            "them among all pixels. Default: 1; auto chooses it")
        ->check(number(0.0, most_light_paths))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--connections", words.connections,
                    "Light subpaths that each camera subpath is connected to (bdpt, vcm). Default: "
                    "all of its own, or 1 if --light-paths is a fraction; auto chooses it")
        ->check(number(0.0, most_light_paths))
        ->type_name("C")
        ->group(group);
}

void add_merge_radius_option(CLI::App& command, TransportWords& words, const char* group,
                             double standard)
{
    command
        .add_option("--merge-radius", words.merge_radius,
                    fmt::format("How close to a camera vertex light vertices are merged with it "
                                "(vcm), as a fraction of the radius of the scene's bounding "
                                "sphere; 0: not at all. Blurs light by so much. Default: {}",
                                standard))
        ->check(number(0.0, 1.0))
        ->type_name("F")
        ->group(group);
}

void add_transport_options(CLI::App& command, TransportWords& words)
{
    const auto group = "How to render";
    const auto add_choice = [&](const char* name, std::string& value,
                                const std::vector<std::string>& values, const std::string& help) {
        command.add_option(name, value, help)
            ->check(one_of(values))
            ->type_name(fmt::format("{}", fmt::join(values, "|")))
            ->group(group);
    };
    add_choice("--integrator", words.integrator, all_names(eval::all_integrators()),
               integrator_help());
    add_choice("--heuristic", words.heuristic, all_names(eval::all_heuristics),
               "MIS heuristic: power (default), balance, cutoff, maximum, or uniform (for tests)");
    add_light_sampling_options(command, words.light_sampling, group);
    add_limits(command, words, group);
    add_light_path_options(command, words, group);
    const BidirectionalOptions standard;
    add_merge_radius_option(command, words, group, standard.merge_radius);
    command
        .add_option("--merge-alpha", words.merge_alpha,
                    fmt::format("How slowly that radius shrinks (vcm), above 0 and up to 1: sample "
                                "i has the first radius times i^((A - 1) / 2). Default: {}",
                                standard.merge_alpha))
        ->check(number(0.0, 1.0))
        ->type_name("A")
        ->group(group);
    command
        .add_option("--disable", words.disabled,
                    "Disable strategies (bdpt, lt, vcm): s vertices from the light and t from the "
                    "camera, like s2t1,s0t3. Light that only these find is missing")
        ->type_name("LIST")
        ->group(group);
}

RenderOptions with_transport(const TransportWords& words, RenderOptions options)
{
    const std::string integrator = integrator_of(words);
    check_bidirectional(words, integrator);
    check_merging(words, integrator);
    options.integrator = eval::parse_integrator(integrator).value();
    options.transport.heuristic = eval::parse_heuristic(words.heuristic).value();
    options.sampling = with_light_sampling(words.light_sampling, integrator, options.sampling);
    options.transport.max_depth = words.max_depth;
    if (words.only) {
        choose_light(*words.only, options);
    }
    options.bidirectional.max_camera_depth =
        words.max_camera_depth.value_or(options.bidirectional.max_camera_depth);
    options.bidirectional.max_light_depth =
        words.max_light_depth.value_or(options.bidirectional.max_light_depth);
    options.bidirectional.light_paths =
        words.light_paths.value_or(options.bidirectional.light_paths);
    if (words.connections) {
        options.bidirectional.connections = words.connections;
    }
    options.bidirectional.merge_radius =
        words.merge_radius.value_or(options.bidirectional.merge_radius);
    options.bidirectional.merge_alpha =
        words.merge_alpha.value_or(options.bidirectional.merge_alpha);
    options.transport.rr_start = words.rr_start.value_or(options.transport.rr_start);
    if (words.disabled) {
        std::optional<std::vector<Strategy>> strategies = parse_strategies(*words.disabled);
        if (!strategies) {
            reject("--disable", *words.disabled,
                   "strategies sStT of at least two vertices, with commas between, like s2t1,s0t3");
        }
        options.bidirectional.disabled = std::move(*strategies);
    }
    return options;
}

nlohmann::ordered_json transport_json(const RenderOptions& options)
{
    constexpr int unlimited = std::numeric_limits<int>::max();
    nlohmann::ordered_json result{{"integrator", eval::to_string(options.integrator)},
                                  {"heuristic", eval::to_string(options.transport.heuristic)},
                                  {"max_depth", options.transport.max_depth},
                                  {"min_depth", options.transport.min_depth},
                                  {"light_paths", number_json(options.bidirectional.light_paths)},
                                  {"rr_start", options.transport.rr_start}};
    result.update(light_sampling_json(options.sampling));
    if (options.bidirectional.connections) {
        result["connections"] = number_json(*options.bidirectional.connections);
    }
    if (options.integrator == IntegratorKind::vcm) {
        result["merge_radius"] = number_json(options.bidirectional.merge_radius);
        result["merge_alpha"] = number_json(options.bidirectional.merge_alpha);
    }
    const auto add = [&](const char* name, int limit) {
        if (limit != unlimited) {
            result[name] = limit;
        }
    };
    add("max_camera_depth", options.bidirectional.max_camera_depth);
    add("max_light_depth", options.bidirectional.max_light_depth);
    for (const Strategy& strategy : options.bidirectional.disabled) {
        result["disabled"].push_back(name_of(strategy));
    }
    return result;
}

std::string disabled_text(const RenderOptions& options)
{
    std::vector<std::string> names;
    for (const Strategy& strategy : options.bidirectional.disabled) {
        names.push_back(name_of(strategy));
    }
    return fmt::format("{}", fmt::join(names, ","));
}

std::string integrator_words(const RenderOptions& options)
{
    const std::string name(eval::to_string(options.integrator));
    if (!info(options.integrator).traces_light_paths) {
        return name;
    }
    const double light_paths = options.bidirectional.light_paths;
    const std::string words =
        fmt::format("{} --light-paths {:g} --connections {:g}", name, light_paths,
                    options.bidirectional.connections.value_or(light_paths));
    const std::string disabled = disabled_text(options);
    return disabled.empty() ? words : words + " --disable " + disabled;
}

std::string integrator_text(const RenderOptions& options, bool chosen)
{
    return chosen ? "auto: " + integrator_words(options)
                  : std::string(eval::to_string(options.integrator));
}

}  // namespace bdpt::app
