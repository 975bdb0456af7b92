#pragma once

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

/// Which light transport algorithm renders.
enum class IntegratorKind : std::uint8_t {
    automatic,  ///< mis, or bdpt with numbers of light paths and connections that suit the image
    bdpt,       ///< bidirectional path tracing, all strategies weighted [Veach 1997, ch. 10]
    pt,   ///< BSDF sampling only; delta lights, which no BSDF sample can hit, by light sampling
    mis,  ///< light and BSDF sampling, weighted [Veach 1997, ch. 9]
    nee,  ///< light sampling; BSDF hits count only where no light sample can reach
    lt,   ///< light tracing: light paths seen through the lens (t <= 1)
    vcm,  ///< bdpt whose light and camera vertices also merge where they are close: biased, but
          ///< less so with each sample [Georgiev et al. 2012]
};

/// How the strategies that can make the same path share it [Veach 1997, sec. 9.2].
enum class Heuristic : std::uint8_t {
    balance,
    power,    ///< beta = 2
    cutoff,   ///< balance among those with at least a tenth of the greatest density
    maximum,  ///< the one with the greatest density takes all
    uniform,  ///< equal shares for all that can make the path; for tests
};

/// The strategy that samples s vertices of a path from the light and t from the camera.
struct Strategy {
    int s = 0;
    int t = 0;
    [[nodiscard]] bool operator==(const Strategy&) const = default;
};

/// Where random numbers come from.
enum class SamplerKind : std::uint8_t {
    /// Owen-scrambled Sobol points: the samples of a pixel spread evenly, with less noise. Best
    /// with twice a power of two of them, one power for each half of the film.
    sobol,
    independent,  ///< every number by itself
};

/// The light that a camera ray finds if it leaves the scene without meeting a surface.
enum class Background : std::uint8_t {
    environment,
    /// Nothing: paths of one edge from the lens to an environment are left out, whatever finds
    /// them. It lights all the same, and is seen in mirrors and through glass. With `Aov::alpha`
    /// the image is premultiplied by alpha, for composing over something else.
    none,
};

/// How next-event estimation samples the light of an environment.
enum class EnvironmentSampling : std::uint8_t {
    plain,  ///< by luminance
    /// By how much luminance is above half of its mean, after Karlik et al. (2019, "MIS
    /// Compensation"): what is not, BSDF sampling finds well enough. Integrators that cannot rely
    /// on that for the rest take `plain`: nee, and bdpt when such strategies are left out.
    compensated,
    /// As `compensated`, and by how much of the environment is visible from a place, which a short
    /// pilot learns from a fixed number of paths (docs/decisions/0068-learned-visibility.md).
    learned,
};

/// How next-event estimation chooses one of many lights.
enum class LightSampling : std::uint8_t {
    automatic,  ///< tree for many lights, and for lights at infinity beside others; else power
    power,      ///< in proportion to power, wherever they are
    /// By what they may bring to the point [Conty Estevez and Kulla 2018, "Importance Sampling of
    /// Many Lights with Adaptive Tree Splitting", without splitting].
    tree,
};

/// Half-open range of sample indices. Every index is a fixed set of random numbers, so disjoint
/// ranges may be rendered apart and their films merged.
struct SampleRange {
    std::int64_t begin = 0;
    std::int64_t end = 64;
    [[nodiscard]] bool operator==(const SampleRange&) const = default;
};

/// The image and its pixels. Ranges: width and height [1, 65536].
struct FilmOptions {
    int width = 1280;  ///< [pixels]
    int height = 720;  ///< [pixels]
    /// The part of the image that is rendered; its pixels are those of the whole image, to the bit.
    std::optional<PixelRect> crop{};
    FilterOptions filter{};
    AovSet aovs{};
    /// World y [m] of the ground of `Aov::shadow`; none: the lowest point of the scene's bounds,
    /// at any time while the shutter is open.
    std::optional<float> ground_height{};
    /// The greatest component [nit] that a contribution to a pixel may have, be it a camera sample
    /// or a splat; greater ones are scaled down. Takes fireflies away, and energy: biased. In (0,
    /// inf]; infinite: off.
    float clamp = std::numeric_limits<float>::infinity();
};

/// Which random numbers, how many, and how next-event estimation spends them. Ranges: samples
/// within [0, 2^32 - 1] and not empty; with rates within [0, 2^30] and from a multiple of
/// SampleRates::group to another; light_samples [1, 1024].
struct SamplingOptions {
    SampleRange samples{};  ///< per pixel; in the mean, if there are rates
    std::uint64_t seed = 0;
    SamplerKind sampler = SamplerKind::sobol;
    EnvironmentSampling environment = EnvironmentSampling::learned;
    LightSampling lights = LightSampling::automatic;
    /// Light samples of next-event estimation at each camera vertex, which all share its weight.
    int light_samples = 1;
    /// How many samples each pixel takes in a round, which a sample index then is; of the size of
    /// the whole image. Null: one. Not for lt and vcm.
    std::shared_ptr<const SampleRates> rates{};
};

/// Which paths are measured, and how strategies share them. Ranges: max_depth [1, 4096], min_depth
/// [1, max_depth], rr_start from 1, rr_survival [0, 1].
struct TransportOptions {
    /// Longest path in edges: 1 sees lights only, 2 adds direct light. Russian roulette ends nearly
    /// all paths before the default does (docs/decisions/0058-length-of-paths.md).
    int max_depth = 64;
    int min_depth = 1;  ///< shortest path in edges that is measured
    /// Edges of a subpath after which Russian roulette may end it; `max_depth` or more: never. A
    /// light subpath goes on with the probability that its throughput has kept since the start, a
    /// camera subpath with what it has kept since the first surface.
    int rr_start = 3;
    /// Least probability with which roulette lets a walk go on, at each edge. 0: what the
    /// throughput asks for, however small; 1: no roulette.
    float rr_survival = 0.0f;
    Heuristic heuristic = Heuristic::power;
    Background background = Background::environment;
};

/// Subpaths and strategies of bdpt, lt and vcm; `automatic` chooses light_paths and connections
/// itself. Ranges: light_paths [0, 4096] (lt, vcm: above 0), connections [0, 4096] (0 without light
/// paths), max_camera_depth and max_light_depth from 0, strategy_depth [0, 4096], merge_radius [0,
/// 1], merge_alpha (0, 1].
struct BidirectionalOptions {
    /// Light paths that are traced for each camera path; need not be whole.
    double light_paths = 1.0;
    /// Light paths that each camera path is joined to, in the mean. Unset: as many as light_paths
    /// if that is whole, else one. If the two differ, or are not whole, all pixels of a sample
    /// index share its light paths, which are kept in memory; else each camera path is joined to
    /// light paths of its own.
    std::optional<double> connections{};
    /// vcm: how far apart a camera vertex and a light vertex may be to merge in the first sample,
    /// as a fraction of the radius of the scene's bounding sphere. 0: nothing merges, and vcm is
    /// bdpt. Else all pixels of a sample index share its light paths, and have one time and
    /// wavelength.
    double merge_radius = 0.003;
    /// vcm: sample index i merges within merge_radius * (i + 1)^((merge_alpha - 1) / 2). Below 1
    /// the bias vanishes in the limit, the sooner the smaller it is, and noise the later.
    double merge_alpha = 0.75;
    /// Bytes that shared light paths of one sample index may take, by their usual length.
    std::uint64_t light_path_memory = 4'000'000'000;
    /// Longest subpaths in edges; strategies with longer ones are left out.
    int max_camera_depth = std::numeric_limits<int>::max();
    int max_light_depth = std::numeric_limits<int>::max();
    /// Strategies that are left out; the others share what they can make.
    std::vector<Strategy> disabled{};
    /// Longest paths [edges], from 0 (none), whose strategies get images of their own. They are not
    /// clamped.
    int strategy_depth = 0;
    /// Bytes that these images may take at most; what they take grows with the square of the depth.
    std::uint64_t strategy_memory = 4'000'000'000;
};

/// How the machine does the work; nothing here has an influence on the result. Ranges: tile_size
/// [1, 65536], threads [0, 4096].
struct SystemOptions {
    int tile_size = 16;  ///< [pixels]
    /// Most threads that work at once, the caller's among them; 0: those that oneTBB gives to the
    /// calling thread, one for each processor if nobody has chosen.
    int threads = 0;
};

/// All options of a render beside scene and camera. The groups document their ranges.
struct RenderOptions {
    IntegratorKind integrator = IntegratorKind::automatic;
    FilmOptions film{};
    SamplingOptions sampling{};
    TransportOptions transport{};
    BidirectionalOptions bidirectional{};
    SystemOptions system{};
};

/// The seed of a frame of an animation whose seed is `seed`: other noise in each frame, and in
/// frame 7 the same, whatever frames are rendered before it.
[[nodiscard]] BDPT_EXPORT std::uint64_t seed_of_frame(std::uint64_t seed,
                                                      std::int64_t frame) noexcept;

}  // namespace bdpt
