#pragma once

#include <cstdint>

namespace bdpt {

/// Which light transport algorithm renders.
enum class IntegratorKind : std::uint8_t {
    bdpt,  ///< bidirectional path tracing, all strategies weighted [Veach 1997, ch. 10]
    pt,    ///< BSDF sampling only; delta lights, which no BSDF sample can hit, by light sampling
    mis,   ///< light and BSDF sampling, weighted [Veach 1997, ch. 9]
};

/// How the strategies that can make the same path share it [Veach 1997, sec. 9.2].
enum class Heuristic : std::uint8_t {
    balance,
    power,  ///< beta = 2
};

/// Half-open range of sample indices. Every index is a fixed set of random numbers, so disjoint
/// ranges may be rendered apart and their films merged.
struct SampleRange {
    std::int64_t begin = 0;
    std::int64_t end = 64;
};

/// What to render but for scene and camera. Ranges: width, height and tile_size [1, 65536],
/// max_depth [1, 4096], threads [0, 4096], samples within [0, 2^32 - 1] and not empty.
struct RenderOptions {
    IntegratorKind integrator = IntegratorKind::bdpt;
    Heuristic heuristic = Heuristic::power;
    int width = 1280;
    int height = 720;
    SampleRange samples;  ///< per pixel
    int max_depth = 8;    ///< longest path in edges: 1 sees lights only, 2 adds direct light
    int tile_size = 16;   ///< [pixels]; has no influence on the result
    int threads = 0;      ///< 0: one for each hardware thread; has no influence on the result
    std::uint64_t seed = 0;
};

}  // namespace bdpt
