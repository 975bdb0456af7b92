#pragma once

/// @file
/// Lists all render options with their names, ranges and help texts.
///
/// @code{.cpp}
/// const bdpt::RenderOptions options;
/// bdpt::for_each_option(options, [](const auto& option, const auto& /*value*/) {
///     std::cout << option.name << ": " << option.info.help << '\n';
/// });
/// @endcode

#include <bdpt/aov.h>
#include <bdpt/fields.h>
#include <bdpt/options/enumerators.h>
#include <bdpt/options/filter_options.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <array>
#include <limits>

namespace bdpt {

// The single list of render options: names, ranges, help texts, and roles. Range checks, the
// identity of renders, the command line, Python keywords and jobs loop over it.

/// Maximum path length [edges].
inline constexpr int max_path_edges = 4096;
/// Maximum image width and height [pixels].
inline constexpr int max_image_side = 1 << 16;

/// Names of integrators, from the simplest to the one with all strategies, and the automatic
/// choice.
template <>
inline constexpr std::array enumerators<IntegratorKind>{
    Enumerator{IntegratorKind::pt, "pt"},          Enumerator{IntegratorKind::nee, "nee"},
    Enumerator{IntegratorKind::mis, "mis"},        Enumerator{IntegratorKind::lt, "lt"},
    Enumerator{IntegratorKind::bdpt, "bdpt"},      Enumerator{IntegratorKind::vcm, "vcm"},
    Enumerator{IntegratorKind::automatic, "auto"},
};
/// Names of MIS heuristics.
template <>
inline constexpr std::array enumerators<Heuristic>{
    Enumerator{Heuristic::balance, "balance"}, Enumerator{Heuristic::power, "power"},
    Enumerator{Heuristic::cutoff, "cutoff"},   Enumerator{Heuristic::maximum, "maximum"},
    Enumerator{Heuristic::uniform, "uniform"},
};
/// Names of samplers.
template <>
inline constexpr std::array enumerators<SamplerKind>{
    Enumerator{SamplerKind::sobol, "sobol"},
    Enumerator{SamplerKind::independent, "independent"},
};
/// Names of backgrounds.
template <>
inline constexpr std::array enumerators<Background>{
    Enumerator{Background::environment, "environment"},
    Enumerator{Background::none, "none"},
};
/// Names of the ways to sample an environment.
template <>
inline constexpr std::array enumerators<EnvironmentSampling>{
    Enumerator{EnvironmentSampling::plain, "plain"},
    Enumerator{EnvironmentSampling::compensated, "compensated"},
    Enumerator{EnvironmentSampling::learned, "learned"},
};
/// Names of the ways to choose a light.
template <>
inline constexpr std::array enumerators<LightSampling>{
    Enumerator{LightSampling::automatic, "auto"},
    Enumerator{LightSampling::power, "power"},
    Enumerator{LightSampling::tree, "tree"},
};
/// Names of pixel filters.
template <>
inline constexpr std::array enumerators<FilterKind>{
    Enumerator{FilterKind::box, "box"},
    Enumerator{FilterKind::tent, "tent"},
    Enumerator{FilterKind::gaussian, "gaussian"},
    Enumerator{FilterKind::blackman_harris, "blackman-harris"},
};
/// Names of AOVs in options; `shadow` is requested with --ground.
template <>
inline constexpr auto enumerators<Aov> = [] {
    std::array<Enumerator<Aov>, aov_layers.size()> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = {aov_layers[i].aov, aov_layers[i].name};
    }
    return result;
}();

/// Fields of `Strategy`, with names.
template <>
inline constexpr auto fields<Strategy> = all_fields(Field{"s", &Strategy::s},
                                                    Field{"t", &Strategy::t});
/// Fields of `PixelRect`, with names.
template <>
inline constexpr auto fields<PixelRect> = all_fields(Field{"x0", &PixelRect::x0},
                                                     Field{"y0", &PixelRect::y0},
                                                     Field{"x1", &PixelRect::x1},
                                                     Field{"y1", &PixelRect::y1});
/// Fields of `FilterOptions`, with names.
template <>
inline constexpr auto fields<FilterOptions> = all_fields(Field{"kind", &FilterOptions::kind},
                                                         Field{"radius", &FilterOptions::radius});

/// Fields of `FilmOptions`, with their documentation and ranges.
template <>
inline constexpr auto fields<FilmOptions> = all_fields(
    OptionField{"width", &FilmOptions::width, {.range = {1, max_image_side}}},
    OptionField{"height", &FilmOptions::height, {.range = {1, max_image_side}}},
    OptionField{"crop",
                &FilmOptions::crop,
                {.value = "X0,Y0,X1,Y1",
                 .help = "Render only columns x0..x1-1 and rows y0..y1-1; pixels equal those of "
                         "the whole image",
                 .otherwise = "the whole image"}},
    OptionField{"filter",
                &FilmOptions::filter,
                {.range = {0.01, 16},  // range of the radius
                 .value = "NAME[:RADIUS]",
                 .help = "Pixel filter: box (radius 0.5), tent (1), gaussian (1.5, sigma is a "
                         "third of it) or blackman-harris (1.5)",
                 .otherwise = "box"}},
    OptionField{
        "aov",
        &FilmOptions::aovs,
        {.value = "LIST",
         .help = "Extra .exr layers (AOVs), comma-separated: albedo, normal, camera-normal, "
                 "depth, distance, position, uv, samples, variance, alpha, opacity; "
                 "object, instance, material: Cryptomatte",
         .otherwise = "none"}},
    OptionField{"ground_height",
                &FilmOptions::ground_height,
                {.range = {-1e15, 1e15},  // as far as rays reach
                 .value = "Y",
                 .help = "Height of the ground of --ground, along y [m]",
                 .otherwise = "the lowest point of the scene, per frame"}},
    OptionField{"clamp",
                &FilmOptions::clamp,
                {.range = {.low = 0.0, .low_is_excluded = true},
                 .value = "NIT",
                 .help = "Clamp each contribution to a pixel to this radiance [nit]: fewer "
                         "fireflies, but biased; the light lost is reported",
                 .otherwise = "no clamping"}});

/// Fields of `SamplingOptions`, with their documentation and ranges.
template <>
inline constexpr auto fields<SamplingOptions> = all_fields(
    OptionField{"samples", &SamplingOptions::samples, {.role = OptionRole::samples}},
    OptionField{"planned_samples",
                &SamplingOptions::planned_samples,
                {.range = {0, 0x1p31}, .role = OptionRole::samples}},
    OptionField{"seed", &SamplingOptions::seed, {.value = "N", .help = "Random seed"}},
    OptionField{"sampler",
                &SamplingOptions::sampler,
                {.help = "Sampler: sobol (Owen-scrambled, less noise, best with a power of two as "
                         "--spp) or independent"}},
    OptionField{"env_sampling",
                &SamplingOptions::environment,
                {.help = "Environment sampling: plain (by luminance), compensated (MIS "
                         "compensation: leaves uniform light to BSDF sampling) or learned "
                         "(experimental: compensated, and a pilot render learns how much "
                         "light of the environment, suns and lamps reaches each place)"}},
    OptionField{"light_sampling",
                &SamplingOptions::lights,
                {.help = "Choice of one light: power (by emitted power), tree (light tree: by "
                         "estimated contribution to the point), auto (tree for many lights, or "
                         "lamps together with a sun or environment)"}},
    OptionField{"light_samples",
                &SamplingOptions::light_samples,
                {.range = {1, 1024},
                 .value = "N",
                 .help = "Light samples per camera path vertex (all integrators but lt), averaged: "
                         "less noise in direct light, more time"}},
    OptionField{"rates", &SamplingOptions::rates, {}});

/// Fields of `TransportOptions`, with their documentation and ranges.
template <>
inline constexpr auto fields<TransportOptions> = all_fields(
    OptionField{"max_depth",
                &TransportOptions::max_depth,
                {.range = {1, max_path_edges},
                 .value = "N",
                 .help = "Maximum path length, in edges: 1 is emitted light only, 2 adds direct "
                         "light"}},
    OptionField{"min_depth", &TransportOptions::min_depth, {.range = {1, max_path_edges}}},
    OptionField{"rr_start",
                &TransportOptions::rr_start,
                {.range = {1, std::numeric_limits<int>::max()},
                 .value = "N",
                 .help = "Edges before Russian roulette starts"}},
    OptionField{"rr_survival", &TransportOptions::rr_survival, {.range = {0, 1}}},
    OptionField{
        "heuristic", &TransportOptions::heuristic, {.help = "MIS heuristic; uniform is for tests"}},
    OptionField{"background", &TransportOptions::background, {}});

/// Fields of `BidirectionalOptions`, with their documentation and ranges.
template <>
inline constexpr auto fields<BidirectionalOptions> = all_fields(
    OptionField{"light_paths",
                &BidirectionalOptions::light_paths,
                {.range = {0, 4096},
                 .value = "N",
                 .help = "Light subpaths per camera subpath (bdpt, lt, vcm); a fraction, like 0.1: "
                         "all pixels share them",
                 .otherwise = "1; auto chooses it"}},
    OptionField{"connections",
                &BidirectionalOptions::connections,
                {.range = {0, 4096},
                 .value = "C",
                 .help = "Light subpaths that each camera subpath is connected to (bdpt, vcm)",
                 .otherwise = "--light-paths, or 1 if that is a fraction; auto chooses it"}},
    OptionField{"connection_rays",
                &BidirectionalOptions::connection_rays,
                {.range = {0, 4096},
                 .value = "K",
                 .help = "Experimental: connect each camera subpath to about K vertices of its "
                         "light subpaths, chosen by estimated contribution (bdpt, vcm). Needs a "
                         "whole number of --connections; 8 of each is often good",
                 .otherwise = "all vertices; auto chooses it"}},
    OptionField{"visible_light_samples",
                &BidirectionalOptions::visible_light_samples,
                {.range = {.low = 0, .high = 1, .low_is_excluded = true}}},
    OptionField{"merge_radius",
                &BidirectionalOptions::merge_radius,
                {.range = {0, 1},
                 .value = "F",
                 .help = "Initial merging radius (vcm), as a fraction of the radius of the scene's "
                         "bounding sphere; 0: no merging. Blurs light by up to this radius"}},
    OptionField{"merge_alpha",
                &BidirectionalOptions::merge_alpha,
                {.range = {.low = 0, .high = 1, .low_is_excluded = true},
                 .value = "A",
                 .help = "Alpha of the merging radius (vcm), above 0 and up to 1: sample i uses "
                         "the initial radius times i^((A - 1) / 2)"}},
    OptionField{"max_merges",
                &BidirectionalOptions::max_merges,
                {.range = {0, std::numeric_limits<int>::max()}}},
    OptionField{
        "light_path_memory",
        &BidirectionalOptions::light_path_memory,
        {.value = "SIZE",
         .help = "Maximum memory of light paths that all pixels share (bdpt, vcm), like 1G; "
                 "auto chooses among those that fit, on any machine alike",
         .otherwise = "4000000000 (4 GB)",
         .role = OptionRole::limit}},
    OptionField{"max_camera_depth",
                &BidirectionalOptions::max_camera_depth,
                {.range = {0, std::numeric_limits<int>::max()},
                 .value = "N",
                 .help = "Maximum camera subpath length, in edges (bdpt, lt, vcm)",
                 .otherwise = "no limit"}},
    OptionField{"max_light_depth",
                &BidirectionalOptions::max_light_depth,
                {.range = {0, std::numeric_limits<int>::max()},
                 .value = "N",
                 .help = "Maximum light subpath length, in edges (bdpt, lt, vcm)",
                 .otherwise = "no limit"}},
    OptionField{"disable",
                &BidirectionalOptions::disabled,
                {.range = {0, max_path_edges + 1},  // range of s and t
                 .value = "LIST",
                 .help = "Disable strategies (bdpt, lt, vcm): s vertices from the light and t from "
                         "the camera, like s2t1,s0t3. Light that only these can sample is lost",
                 .otherwise = "none"}},
    OptionField{
        "strategy_depth", &BidirectionalOptions::strategy_depth, {.range = {0, max_path_edges}}},
    OptionField{
        "strategy_memory", &BidirectionalOptions::strategy_memory, {.role = OptionRole::limit}});

/// Fields of `SystemOptions`, with their documentation and ranges.
template <>
inline constexpr auto fields<SystemOptions> = all_fields(
    OptionField{"tile_size",
                &SystemOptions::tile_size,
                {.range = {1, max_image_side}, .role = OptionRole::machine}},
    OptionField{"threads",
                &SystemOptions::threads,
                {.range = {0, 4096},
                 .value = "N",
                 .help = "Number of threads. Does not change the image",
                 .otherwise = "one per processor available to the process, within the container's "
                              "quota",
                 .role = OptionRole::machine}});

/// Fields of `RenderOptions`: the integrator, and the groups of all other options.
template <>
inline constexpr auto fields<RenderOptions> = all_fields(
    OptionField{"integrator", &RenderOptions::integrator, {.help = "Light transport algorithm"}},
    OptionField{"film", &RenderOptions::film, {}},
    OptionField{"sampling", &RenderOptions::sampling, {}},
    OptionField{"transport", &RenderOptions::transport, {}},
    OptionField{"bidirectional", &RenderOptions::bidirectional, {}},
    OptionField{"system", &RenderOptions::system, {}});

/// Tests whether `T` is a group of options rather than the value of one option.
template <typename T>
inline constexpr bool is_option_group = false;
/// `FilmOptions` is a group.
template <>
inline constexpr bool is_option_group<FilmOptions> = true;
/// `SamplingOptions` is a group.
template <>
inline constexpr bool is_option_group<SamplingOptions> = true;
/// `TransportOptions` is a group.
template <>
inline constexpr bool is_option_group<TransportOptions> = true;
/// `BidirectionalOptions` is a group.
template <>
inline constexpr bool is_option_group<BidirectionalOptions> = true;
/// `SystemOptions` is a group.
template <>
inline constexpr bool is_option_group<SystemOptions> = true;

/// Calls `visit(field, value)` for each option of `options`, descending into groups.
template <typename Options, typename Visitor>
constexpr void for_each_option(Options& options, Visitor&& visit)
{
    for_each_field(options, [&visit](const auto& field, auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (is_option_group<T>) {
            for_each_option(value, visit);
        } else {
            visit(field, value);
        }
    });
}

}  // namespace bdpt
