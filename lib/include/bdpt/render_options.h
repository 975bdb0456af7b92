#pragma once

/// @file
/// Chooses the integrator, the size, the samples and all other options of a render.
///
/// @code{.cpp}
/// const bdpt::RenderOptions options = {
///     .integrator = bdpt::IntegratorKind::bdpt,
///     .film = {.width = 1920, .height = 1080},
///     .sampling = {.samples = {0, 256}, .seed = 7},
///     .transport = {.max_depth = 16},
/// };
/// @endcode

#include <bdpt/aov.h>
#include <bdpt/export.h>
#include <bdpt/options/filter_options.h>
#include <bdpt/pixel_rect.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace bdpt {

class SampleRates;

/// The light transport algorithm.
enum class IntegratorKind : std::uint8_t {
    automatic,  ///< mis, or bdpt with numbers of light paths and connections that suit the image
    /// Bidirectional path tracing with all strategies, MIS-weighted [Veach 1997, ch. 10].
    bdpt,
    pt,   ///< BSDF sampling only; light sampling for delta lights, which no BSDF sample can hit
    mis,  ///< light and BSDF sampling, MIS-weighted [Veach 1997, ch. 9]
    nee,  ///< light sampling; BSDF samples count only where no light sample can reach
    lt,   ///< light tracing: light paths connected to the lens (t <= 1)
    /// Vertex connection and merging: bdpt that also merges nearby light and camera vertices;
    /// biased, but less so with each sample [Georgiev et al. 2012].
    vcm,
};

/// MIS heuristic: weights of the strategies that can sample the same path [Veach 1997, sec. 9.2].
enum class Heuristic : std::uint8_t {
    balance,
    power,    ///< beta = 2
    cutoff,   ///< balance among strategies with at least a tenth of the largest density
    maximum,  ///< the strategy with the largest density takes all
    uniform,  ///< equal weights for all strategies that can sample the path; for tests
};

/// The strategy that samples s vertices of a path from the light and t from the camera.
struct Strategy {
    int s = 0;
    int t = 0;
    [[nodiscard]] bool operator==(const Strategy&) const = default;
};

/// The source of random numbers.
enum class SamplerKind : std::uint8_t {
    /// Owen-scrambled Sobol points: evenly distributed samples in each pixel, with less noise, and
    /// over neighbouring pixels where `planned_samples` is known. Best with a power of two samples.
    sobol,
    independent,  ///< independent random numbers
};

/// The light seen by a camera ray that leaves the scene without hitting a surface.
enum class Background : std::uint8_t {
    environment,
    /// None: paths of one edge from the lens to an environment are excluded, whichever strategy
    /// finds them. The environment still lights the scene, and is visible in mirrors and through
    /// glass. With `Aov::alpha` the image is premultiplied by alpha, for compositing over a
    /// background.
    none,
};

/// Importance sampling of an environment in next-event estimation.
enum class EnvironmentSampling : std::uint8_t {
    plain,  ///< proportional to luminance
    /// Proportional to the excess of luminance over half of its mean, after Karlik et al. (2019,
    /// "MIS Compensation"): BSDF sampling finds the rest well enough. Integrators that cannot rely
    /// on BSDF sampling for it use `plain`: nee, and bdpt when such strategies are disabled.
    compensated,
    /// Like `compensated`, and by what a short pilot with a fixed number of paths learns for each
    /// place: the visible fraction of the environment (docs/decisions/0068-learned-visibility.md),
    /// and the shares of light from the environment, from suns and from placed lights
    /// (docs/decisions/0071-learned-groups-of-lights.md). Light paths of bdpt and vcm start where
    /// light of the environment and of suns enters (docs/decisions/0073-learned-entries.md), and at
    /// the lights that bring most indirect light (docs/decisions/0075-learned-starts.md).
    BDPT_EXPERIMENTAL learned,
};

/// Selection of one of many lights in next-event estimation.
enum class LightSampling : std::uint8_t {
    /// Tree for many lights, and for lights at infinity combined with others; else power.
    automatic,
    power,  ///< proportional to power, independent of position
    /// By estimated contribution to the shading point [Conty Estevez and Kulla 2018, "Importance
    /// Sampling of Many Lights with Adaptive Tree Splitting", without splitting].
    tree,
};

/// Half-open range of sample indices. Every index is a fixed set of random numbers, so disjoint
/// ranges may be rendered separately and their films merged.
struct SampleRange {
    std::int64_t begin = 0;
    std::int64_t end = 64;
    [[nodiscard]] bool operator==(const SampleRange&) const = default;
};

/// The image and its pixels. Ranges: width and height [1, 65536].
struct FilmOptions {
    int width = 1280;  ///< [pixels]
    int height = 720;  ///< [pixels]
    /// Region of the image to render; its pixels are bit-identical to those of the whole image.
    std::optional<PixelRect> crop{};
    FilterOptions filter{};
    AovSet aovs{};
    /// y of the ground of `Aov::shadow` [m], in coordinates of the file (`SceneDesc::origin`);
    /// nullopt: the lowest point of the scene's bounds at any time while the shutter is open.
    std::optional<float> ground_height{};
    /// Maximum component [nit] of a contribution to a pixel, be it a camera sample or a splat;
    /// larger ones are scaled down. Removes fireflies, but also energy: biased. In (0, inf];
    /// infinite: off.
    float clamp = std::numeric_limits<float>::infinity();
};

/// Random numbers, sample counts, and their use in next-event estimation. Ranges: samples within
/// [0, 2^32 - 1] and not empty; planned_samples [0, 2^31]; with rates within [0, 2^30] and from a multiple of
/// SampleRates::group to another; light_samples [1, 1024].
struct SamplingOptions {
    SampleRange samples{};  ///< per pixel; in the mean, with rates
    /// Number of samples per pixel of the whole render, of which `samples` may be a part: after so
    /// many, errors of neighbouring pixels cancel out (docs/decisions/0086-samples-in-z-order.md).
    /// 0: not known, as for renders that go on until a time or a noise. Parts have the bits of the
    /// whole if they have the same number.
    std::int64_t planned_samples = 64;
    std::uint64_t seed = 0;
    SamplerKind sampler = SamplerKind::sobol;
    EnvironmentSampling environment = EnvironmentSampling::learned;
    LightSampling lights = LightSampling::automatic;
    /// Light samples of next-event estimation at each camera vertex, which share its weight.
    int light_samples = 1;
    /// Samples that each pixel takes per round; a sample index then numbers a round. Has the size
    /// of the whole image. Null: one sample per round. Not for lt and vcm.
    std::shared_ptr<const SampleRates> rates{};
};

/// Selection of paths, and MIS among strategies. Ranges: max_depth [1, 4096], min_depth [1,
/// max_depth], rr_start from 1, rr_survival [0, 1].
struct TransportOptions {
    /// Maximum path length in edges: 1 includes emitted light only, 2 adds direct light. Russian
    /// roulette ends nearly all paths before the default does
    /// (docs/decisions/0058-length-of-paths.md).
    int max_depth = 64;
    int min_depth = 1;  ///< minimum path length in edges
    /// Edges of a subpath after which Russian roulette may end it; `max_depth` or more: never. A
    /// light subpath survives with its throughput relative to the start as probability, a camera
    /// subpath with its throughput relative to the first surface.
    int rr_start = 3;
    /// Minimum survival probability of Russian roulette at each edge. 0: the throughput alone
    /// decides, however small; 1: no roulette.
    float rr_survival = 0.0f;
    Heuristic heuristic = Heuristic::power;
    Background background = Background::environment;
};

/// Subpaths and strategies of bdpt, lt and vcm; `automatic` chooses light_paths and connections
/// itself. Ranges: light_paths [0, 4096] (lt, vcm: above 0), connections [0, 4096] (0 without light
/// paths), max_camera_depth and max_light_depth from 0, strategy_depth [0, 4096], merge_radius [0,
/// 1], merge_alpha (0, 1], max_merges from 0.
struct BidirectionalOptions {
    /// Light paths traced per camera path; may be fractional.
    double light_paths = 1.0;
    /// Mean number of light paths that each camera path is connected to. nullopt: light_paths if
    /// that is whole, else one. If the two differ, or are not whole, all pixels of a sample index
    /// share its light paths, which are kept in memory; else each camera path is connected to light
    /// paths of its own.
    std::optional<double> connections{};
    /// If above 0, each camera path is connected to about this many vertices of these light paths,
    /// chosen by their estimated contribution, in place of all of them: a connection costs a shadow
    /// ray. `connections` must be whole then, and all pixels share light paths.
    BDPT_EXPERIMENTAL double connection_rays = 0.0;
    /// Points on lights that are connected to the lens (s = t = 1), per camera path: above 0, up to
    /// 1. Few are enough: camera paths hit lights that fill a pixel, and a point on any other light
    /// serves the whole image. Where camera paths cannot hit lights (lt), and with uniform
    /// weights, each takes one.
    double visible_light_samples = 1.0 / 64.0;
    /// vcm: merge radius of the first sample, as a fraction of the radius of the scene's bounding
    /// sphere. 0: nothing merges, and vcm is bdpt. Otherwise all pixels of a sample index share its
    /// light paths, and have one time and wavelength.
    double merge_radius = 0.003;
    /// vcm: sample index i merges within merge_radius * (i + 1)^((merge_alpha - 1) / 2). Below 1
    /// the bias vanishes in the limit; smaller values reduce bias sooner, and noise later.
    double merge_alpha = 0.75;
    /// vcm: if above 0, a camera vertex merges with at most this many light vertices: where more
    /// are near, some are chosen at random, and stand for all.
    int max_merges = 0;
    /// Maximum memory of the shared light paths [bytes], estimated from their usual length. Those
    /// of large images are traced in batches, and vcm keeps all of a sample index.
    std::uint64_t light_path_memory = 4'000'000'000;
    /// Maximum subpath lengths in edges; strategies with longer subpaths are excluded.
    int max_camera_depth = std::numeric_limits<int>::max();
    int max_light_depth = std::numeric_limits<int>::max();
    /// Strategies that are excluded; the others share their paths.
    std::vector<Strategy> disabled{};
    /// Maximum length [edges] of paths whose strategies get images of their own; 0: none. These
    /// images are not clamped.
    int strategy_depth = 0;
    /// Maximum memory of these images [bytes]; it grows with the square of the depth.
    std::uint64_t strategy_memory = 4'000'000'000;
};

/// Execution of the work on the machine; nothing here affects the result. Ranges: tile_size [1,
/// 65536], threads [0, 4096].
struct SystemOptions {
    int tile_size = 16;  ///< [pixels]
    /// Maximum number of concurrent threads, including the caller's; 0: those that oneTBB gives to
    /// the calling thread, one per processor by default.
    int threads = 0;
};

/// All options of a render besides scene and camera. The groups document their ranges.
struct RenderOptions {
    IntegratorKind integrator = IntegratorKind::automatic;
    FilmOptions film{};
    SamplingOptions sampling{};
    TransportOptions transport{};
    BidirectionalOptions bidirectional{};
    SystemOptions system{};
};

/// Returns the seed of a frame of an animation whose seed is `seed`: each frame has different
/// noise, and frame 7 has the same noise whatever frames are rendered before it.
[[nodiscard]] BDPT_EXPORT std::uint64_t seed_of_frame(std::uint64_t seed,
                                                      std::int64_t frame) noexcept;

}  // namespace bdpt
