#pragma once

#include <bdpt/fields.h>
#include <bdpt/filter_options.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

namespace bdpt {

// Lists of fields (bdpt/fields.h) of render options. What is in them, and is no `SystemOptions`, no
// range of samples and no limit of memory, belongs to the identity of a render.
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
inline constexpr auto fields<FilterOptions> = all_fields(Field{"filter", &FilterOptions::kind},
                                                         Field{"filter radius",
                                                               &FilterOptions::radius});
/// Fields of `FilmOptions`, with names.
template <>
inline constexpr auto fields<FilmOptions> = all_fields(
    Field{"width", &FilmOptions::width}, Field{"height", &FilmOptions::height},
    Field{"crop", &FilmOptions::crop}, Field{"filter", &FilmOptions::filter},
    Field{"layers", &FilmOptions::aovs}, Field{"ground height", &FilmOptions::ground_height},
    Field{"clamp", &FilmOptions::clamp});
/// Fields of `SamplingOptions`, with names.
template <>
inline constexpr auto fields<SamplingOptions> =
    all_fields(Field{"samples", &SamplingOptions::samples}, Field{"seed", &SamplingOptions::seed},
               Field{"sampler", &SamplingOptions::sampler},
               Field{"environment sampling", &SamplingOptions::environment},
               Field{"light sampling", &SamplingOptions::lights},
               Field{"light samples", &SamplingOptions::light_samples},
               Field{"rates", &SamplingOptions::rates});
/// Fields of `TransportOptions`, with names.
template <>
inline constexpr auto fields<TransportOptions> =
    all_fields(Field{"longest path", &TransportOptions::max_depth},
               Field{"shortest path", &TransportOptions::min_depth},
               Field{"start of Russian roulette", &TransportOptions::rr_start},
               Field{"least survival of Russian roulette", &TransportOptions::rr_survival},
               Field{"heuristic", &TransportOptions::heuristic},
               Field{"background", &TransportOptions::background});
/// Fields of `BidirectionalOptions`, with names.
template <>
inline constexpr auto fields<BidirectionalOptions> = all_fields(
    Field{"light paths", &BidirectionalOptions::light_paths},
    Field{"connections", &BidirectionalOptions::connections},
    Field{"merge radius", &BidirectionalOptions::merge_radius},
    Field{"merge alpha", &BidirectionalOptions::merge_alpha},
    Field{"light path memory", &BidirectionalOptions::light_path_memory},
    Field{"longest camera subpath", &BidirectionalOptions::max_camera_depth},
    Field{"longest light subpath", &BidirectionalOptions::max_light_depth},
    Field{"disabled strategies", &BidirectionalOptions::disabled},
    Field{"longest path with images of strategies", &BidirectionalOptions::strategy_depth},
    Field{"strategy memory", &BidirectionalOptions::strategy_memory});
/// Fields of `RenderOptions`, with names.
template <>
inline constexpr auto fields<RenderOptions> = all_fields(
    Field{"integrator", &RenderOptions::integrator}, Field{"film", &RenderOptions::film},
    Field{"sampling", &RenderOptions::sampling}, Field{"transport", &RenderOptions::transport},
    Field{"bidirectional", &RenderOptions::bidirectional}, Field{"system", &RenderOptions::system});

}  // namespace bdpt
