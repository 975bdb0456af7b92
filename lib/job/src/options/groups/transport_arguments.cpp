#include "options/groups/transport_arguments.h"

#include <bdpt/error.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/options/option_text.h>
#include <bdpt/render.h>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "options/groups/image_arguments.h"
#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

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

/// Parses "s2t1".
std::optional<Strategy> parse_strategy(std::string_view text)
{
    constexpr std::size_t max_vertices = max_path_edges + 1;
    const std::size_t middle = text.find('t');
    if (!text.starts_with('s') || middle == std::string_view::npos) {
        return std::nullopt;
    }
    const auto s = parse_index(text.substr(1, middle - 1));
    const auto t = parse_index(text.substr(middle + 1));
    if (!s || !t || *s > max_vertices || *t > max_vertices || *s + *t < 2) {
        return std::nullopt;
    }
    return Strategy{static_cast<int>(*s), static_cast<int>(*t)};
}

/// Returns the integrator: options of subpaths and strategies imply bdpt, unless another integrator
/// is named.
IntegratorKind find_integrator(const RenderOptions& render, const OptionList& options)
{
    constexpr std::array for_bdpt{"--light-paths", "--connections",      "--connection-rays",
                                  "--disable",     "--max-camera-depth", "--max-light-depth"};
    const bool bdpt = std::any_of(for_bdpt.begin(), for_bdpt.end(),
                                  [&](const char* option) { return options.given(option); });
    return bdpt && !options.given("--integrator") && render.integrator == IntegratorKind::automatic
               ? IntegratorKind::bdpt
               : render.integrator;
}

/// Throws if an option is given that the integrator does not have.
void check_takers(const RenderOptions& render, const OptionList& options)
{
    struct Row {
        const char* option;
        std::vector<IntegratorKind> takers;
    };
    using enum IntegratorKind;
    static const std::vector<Row> rows{
        {"--merge-radius", {vcm}},
        {"--merge-alpha", {vcm}},
        {"--connections", {IntegratorKind::bdpt, vcm}},
        {"--connection-rays", {IntegratorKind::bdpt, vcm}},
        {"--max-camera-depth", {IntegratorKind::bdpt, lt, vcm}},
        {"--max-light-depth", {IntegratorKind::bdpt, lt, vcm}},
        {"--light-paths", {IntegratorKind::bdpt, lt, vcm}},
        {"--disable", {IntegratorKind::bdpt, lt, vcm}},
        {"--light-path-memory", {IntegratorKind::bdpt, vcm, automatic}},
        {"--light-samples", {pt, nee, mis, IntegratorKind::bdpt, vcm, automatic}},
    };
    for (const Row& row : rows) {
        if (options.given(row.option) && !is_among(row.takers, render.integrator)) {
            std::vector<std::string> names;
            for (const IntegratorKind taker : row.takers) {
                names.emplace_back(to_name(taker));
            }
            const std::string_view its = to_name(render.integrator);
            const bool all_others = names.size() + 1 == integrators().size();
            throw OptionError(all_others ? fmt::format("{} cannot be combined with --integrator {}",
                                                       row.option, its)
                                         : fmt::format("{} needs --integrator {}, not {}",
                                                       row.option, words_text(names), its));
        }
    }
}

/// Throws for values that the integrator does not support.
void check_values(const RenderOptions& render, const OptionList& options)
{
    const bool no_light_paths = render.bidirectional.light_paths == 0.0;
    const IntegratorKind integrator = render.integrator;
    if (no_light_paths && (integrator == IntegratorKind::lt || integrator == IntegratorKind::vcm)) {
        throw OptionError(
            fmt::format("--integrator {} needs --light-paths above 0", to_name(integrator)));
    }
    if (no_light_paths && options.given("--connections") &&
        render.bidirectional.connections.value_or(0.0) > 0.0) {
        throw OptionError("--connections needs --light-paths above 0");
    }
    const double connections = render.bidirectional.connections.value_or(1.0);
    if (no_light_paths && render.bidirectional.connection_rays > 0.0) {
        throw OptionError("--connection-rays needs --light-paths above 0");
    }
    if (render.bidirectional.connection_rays > 0.0 &&
        (connections < 1.0 || connections != std::floor(connections))) {
        throw OptionError("--connection-rays needs --connections that are a whole number above 0");
    }
    const Heuristic heuristic = render.transport.heuristic;
    if (integrator == IntegratorKind::vcm && heuristic != Heuristic::power &&
        heuristic != Heuristic::balance) {
        throw OptionError(fmt::format("--integrator vcm needs --heuristic power or balance, not {}",
                                      to_name(heuristic)));
    }
}

/// Limits the depth: paths with one bounce and less are direct light, all others indirect.
TransportOptions with_only(PathsOnly only, TransportOptions transport)
{
    constexpr int max_direct_depth = 2;
    if (only == PathsOnly::direct) {
        transport.max_depth = std::min(transport.max_depth, max_direct_depth);
    } else if (only == PathsOnly::indirect) {
        if (transport.max_depth <= max_direct_depth) {
            throw OptionError(
                "--only indirect needs --max-depth 3 or more, where indirect light begins");
        }
        transport.min_depth = max_direct_depth + 1;
    }
    return transport;
}

/// Returns whole numbers as JSON without a fraction.
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
    for (const std::string_view part : split(text, ',')) {
        const std::optional<Strategy> strategy = parse_strategy(part);
        if (!strategy) {
            return std::nullopt;
        }
        result.push_back(*strategy);
    }
    return result;
}

ValueType<std::vector<Strategy>> strategies_type()
{
    return parsed_by(parse_strategies,
                     "a comma-separated list of strategies sStT with at least two vertices, like "
                     "s2t1,s0t3");
}

void add_transport_options(OptionList& options, RenderOptions& render, PathsOnly& only)
{
    const auto integrators = choices_of_enumeration<IntegratorKind>();
    add_choice(options, "--integrator", integrator_help(), render.integrator, integrators);
    add_fields(options, render.transport);
    const Choices<PathsOnly> which{
        {{"direct", PathsOnly::direct}, {"indirect", PathsOnly::indirect}}};
    options.add("--only", "direct|indirect",
                "direct: emission and direct light (paths of 1 or 2 edges); indirect: longer "
                "paths, up to --max-depth. The two images sum to the full image",
                only, which.type());
    add_fields(options, render.bidirectional);
}

RenderOptions with_transport(RenderOptions render, PathsOnly only, const OptionList& options)
{
    render.integrator = find_integrator(render, options);
    check_takers(render, options);
    check_values(render, options);
    render.transport = with_only(only, render.transport);
    return render;
}

nlohmann::ordered_json transport_json(const RenderOptions& options)
{
    constexpr int unlimited = std::numeric_limits<int>::max();
    nlohmann::ordered_json result{{"integrator", to_name(options.integrator)},
                                  {"heuristic", to_name(options.transport.heuristic)},
                                  {"max_depth", options.transport.max_depth},
                                  {"min_depth", options.transport.min_depth},
                                  {"light_paths", number_json(options.bidirectional.light_paths)},
                                  {"rr_start", options.transport.rr_start},
                                  {"environment_sampling", to_name(options.sampling.environment)},
                                  {"light_sampling", to_name(options.sampling.lights)},
                                  {"light_samples", options.sampling.light_samples}};
    const BidirectionalOptions& bidirectional = options.bidirectional;
    const bool merges = options.integrator == IntegratorKind::vcm;
    const auto add_if = [&result](bool is_set, const char* name, double value) {
        if (is_set) {
            result[name] = number_json(value);
        }
    };
    add_if(bidirectional.connections.has_value(), "connections",
           bidirectional.connections.value_or(0.0));
    add_if(bidirectional.connection_rays > 0.0, "connection_rays", bidirectional.connection_rays);
    add_if(merges, "merge_radius", bidirectional.merge_radius);
    add_if(merges, "merge_alpha", bidirectional.merge_alpha);
    add_if(bidirectional.max_camera_depth != unlimited, "max_camera_depth",
           bidirectional.max_camera_depth);
    add_if(bidirectional.max_light_depth != unlimited, "max_light_depth",
           bidirectional.max_light_depth);
    for (const Strategy& strategy : bidirectional.disabled) {
        result["disabled"].push_back(option_text(strategy));
    }
    return result;
}

std::string disabled_text(const RenderOptions& options)
{
    return options.bidirectional.disabled.empty() ? ""
                                                  : option_text(options.bidirectional.disabled);
}

std::string integrator_words(const RenderOptions& options)
{
    const std::string name(to_name(options.integrator));
    if (!info(options.integrator).traces_light_paths) {
        return name;
    }
    const double light_paths = options.bidirectional.light_paths;
    std::string words = fmt::format("{} --light-paths {:g} --connections {:g}", name, light_paths,
                                    options.bidirectional.connections.value_or(light_paths));
    if (options.bidirectional.connection_rays > 0.0) {
        words += fmt::format(" --connection-rays {:g}", options.bidirectional.connection_rays);
    }
    const std::string disabled = disabled_text(options);
    return disabled.empty() ? words : words + " --disable " + disabled;
}

std::string integrator_text(const RenderOptions& options, bool chosen)
{
    if (!chosen) {
        return std::string(to_name(options.integrator));
    }
    const std::string text = fmt::format("auto chose {}", info(options.integrator).summary);
    if (!info(options.integrator).traces_light_paths) {
        return text;
    }
    const double light_paths = options.bidirectional.light_paths;
    const double standard = light_paths < 1.0 ? 1.0 : light_paths;
    const double connections = options.bidirectional.connections.value_or(standard);
    const auto number = [](double count, const char* noun) {
        return fmt::format("{:g} {}{}", count, noun, count == 1.0 ? "" : "s");
    };
    const std::string paths =
        light_paths > 0.0 && light_paths < 1.0
            ? fmt::format("1 light path for {:.3g} camera paths", 1.0 / light_paths)
            : fmt::format("{} for each camera path", number(light_paths, "light path"));
    const double rays = options.bidirectional.connection_rays;
    const int light_samples = options.sampling.light_samples;
    return fmt::format("{} ({}{}{}{})", text, paths,
                       connections == standard ? "" : ", " + number(connections, "connection"),
                       rays == 0.0 ? "" : " by " + number(rays, "ray"),
                       light_samples == 1 ? "" : fmt::format(", {} light samples", light_samples));
}

namespace fs = std::filesystem;

void add_strategy_options(OptionList& options, StrategyFiles& strategies)
{
    add_strategy_file_option(
        options, strategies,
        "Write an image of each strategy (bdpt, lt) to this .exr: layers like s02t03 "
        "(MIS-weighted: its part of the image) and s02t03.unweighted, and a .png contact sheet of "
        "all");
    constexpr int most = 100;  // larger sheets are unreadable
    Option& depth =
        options.add("--strategy-depth", "N",
                    fmt::format("Maximum path length, in edges, of --strategies. Default: {}, or "
                                "less to stay below 4 GB. With --part alone: keep these images in "
                                "the part",
                                default_strategy_depth),
                    strategies.depth, whole_number(1, most));
    depth.uses = {};
}

void add_strategy_file_option(OptionList& options, StrategyFiles& strategies, std::string help)
{
    Option& option = options.add("--strategies", "FILE", std::move(help), strategies.layers,
                                 file_named({".exr"}, "a file name that ends in .exr"));
    option.uses = {.stated_in = StatedIn::own_folder};
}

std::optional<StrategyFiles> checked(const StrategyFiles& strategies, const RenderOptions& render,
                                     const OptionList& options)
{
    if (options.find("--strategies") == nullptr) {
        return std::nullopt;  // bench: its --strategy-depth is a different option
    }
    const bool file = options.given("--strategies");
    if (!file && !options.given("--strategy-depth")) {
        return std::nullopt;
    }
    static constexpr std::array needs{Need{"--strategy-depth", "--strategies|--part"}};
    check(needs, options);
    if (!info(render.integrator).has_strategies) {
        throw OptionError(fmt::format("{} needs --integrator bdpt or lt, not {}",
                                      file ? "--strategies" : "--strategy-depth",
                                      info(render.integrator).name));
    }
    return strategies;
}

std::vector<fs::path> StrategyFiles::both() const
{
    return layers.empty() ? std::vector<fs::path>() : std::vector<fs::path>{layers, sheet()};
}

namespace {

/// Returns the option by which strategy images were requested.
std::string format_option(const StrategyFiles& files)
{
    return files.layers.empty() ? "--strategy-depth"
                                : fmt::format("--strategies \"{}\"", files.layers.string());
}

double gigabytes(std::uint64_t bytes)
{
    return static_cast<double>(bytes) * 1e-9;
}

std::uint64_t bytes_up_to(int depth, RenderOptions options, const CameraDesc& camera)
{
    options.bidirectional.strategy_depth = depth;
    return strategy_image_bytes(options, camera);
}

/// Returns the greatest depth up to `wanted` whose images fit into memory; 0 if none does.
int affordable_depth(int wanted, const RenderOptions& options, const CameraDesc& camera)
{
    int depth = wanted;
    while (depth > 0 &&
           bytes_up_to(depth, options, camera) > options.bidirectional.strategy_memory) {
        --depth;
    }
    return depth;
}

}  // namespace

StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                             const CameraDesc& camera)
{
    const int wanted =
        std::min(files.depth.value_or(default_strategy_depth), options.transport.max_depth);
    const std::uint64_t bytes = bytes_up_to(wanted, options, camera);
    if (bytes == 0) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: no enabled strategy samples paths of up to {} edges "
                                "(--strategy-depth)",
                                format_option(files), wanted));
    }
    const int depth = affordable_depth(wanted, options, camera);
    if (depth == wanted) {
        return {.edges = wanted, .warning = {}};
    }
    const std::string figures = fmt::format(
        "{}: images of paths of up to {} edges take {:.1f} GB, more than the limit of {:.1f} GB",
        format_option(files), wanted, gigabytes(bytes),
        gigabytes(options.bidirectional.strategy_memory));
    const bool any = depth > 0 && bytes_up_to(depth, options, camera) > 0;
    if (files.depth || !any) {
        throw Error(ErrorCode::usage,
                    figures + (any ? fmt::format("; --strategy-depth {} takes less", depth)
                                   : "; a smaller --size or --crop takes less"));
    }
    return {.edges = depth,
            .warning = fmt::format("{}: only those of up to {} edges are written "
                                   "(--strategy-depth)",
                                   figures, depth)};
}

}  // namespace bdpt::job
